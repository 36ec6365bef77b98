// The progress of planning, on standard error: on a terminal one line that is rewritten, elsewhere a line for
// each tenth.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace unicursal::host {

class ProgressLine {
 public:
  /// `what` names the activity, for example "planning". `layers` is the number of layers.
  ProgressLine(std::string what, std::size_t layers);
  /// Erases the progress line.
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// `begun`: number of layers before the current one. `fraction`: the finished part of the current layer, 0
  /// to 1.
  void update(std::size_t begun, double fraction);

 private:
  using Clock = std::chrono::steady_clock;

  void clear();
  std::string line(std::size_t begun, double share) const;

  std::string what_;
  std::size_t layers_;
  bool terminal_;
  bool shown_ = false;
  int last_tenth_ = 0;
  Clock::time_point started_ = Clock::now();
  Clock::time_point drawn_{};
};

}  // namespace unicursal::host
