// A few threads that share out the pieces of one job. The pieces are cut by the caller and do not depend on
// how many threads there are, so sums made piece by piece are the same bytes with any number of them.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace unicursal::core {

class Workers {
 public:
  /// `threads` ≥ 1, the calling one included: 1 starts none.
  explicit Workers(int threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// Calls job(0) … job(count − 1), each once, in any order and on any thread; returns when all are done.
  /// Not to be called from within a job, nor by two threads at once. An exception of a job ends the job and
  /// is thrown here.
  void each(std::size_t count, const std::function<void(std::size_t)>& job);

  /// The same for ranges of `size` numbers: job(first, last).
  void ranges(std::size_t count, std::size_t size, const std::function<void(std::size_t, std::size_t)>& job);

 private:
  class Helpers;
  std::unique_ptr<Helpers> helpers_;
};

}  // namespace unicursal::core
