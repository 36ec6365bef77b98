// Waits until a source has its next step, on a thread that has nothing else to do.
#pragma once

#include <atomic>

#include "host/engine/source.hpp"

namespace unicursal::host {

class StepWait {
 public:
  /// The source must outlive this object, which is its only listener meanwhile.
  explicit StepWait(Source& source);
  ~StepWait() { source_.on_ready({}); }
  StepWait(const StepWait&) = delete;
  StepWait& operator=(const StepWait&) = delete;

  /// Returns when the source is ready().
  void wait();

 private:
  Source& source_;
  std::atomic<unsigned> calls_ = 0;  ///< of the listener
};

}  // namespace unicursal::host
