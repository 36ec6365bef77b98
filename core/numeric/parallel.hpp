// Worker threads that share the pieces of one job. The caller cuts the pieces, independently of the number of
// threads, so sums made piece by piece have the same bytes for any number of threads.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace unicursal::core {

class Workers {
 public:
  /// `threads` ≥ 1 includes the calling thread; 1 starts no other.
  explicit Workers(int threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// Calls job(0) … job(count − 1), each once, in any order and on any thread; returns when all are done.
  /// Must not be called from within a job, nor by two threads at once. If a job throws, no further piece is
  /// begun; the exception is rethrown here. The caller's stop token counts in jobs (core/stopping.hpp).
  void each(std::size_t count, const std::function<void(std::size_t)>& job);

  /// Like each(), for ranges of `size` numbers: job(first, last), `last` excluded.
  void ranges(std::size_t count, std::size_t size, const std::function<void(std::size_t, std::size_t)>& job);

 private:
  class Helpers;
  std::unique_ptr<Helpers> helpers_;
};

}  // namespace unicursal::core
