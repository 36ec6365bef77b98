#include "core/numeric/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "core/stopping.hpp"

namespace unicursal::core {

/// Threads that wait until the round number changes, take pieces until none is left, and report back.
class Workers::Helpers {
 public:
  explicit Helpers(int count) {
    for (int i = 0; i < count; ++i) threads_.emplace_back([this] { serve(); });
  }

  ~Helpers() {
    stopping_ = true;
    ++round_;
    round_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }

  void run(std::size_t count, const std::function<void(std::size_t)>& job) {
    job_ = &job;
    stop_ = present_stop_token();
    count_ = count;
    next_ = 0;
    busy_ = static_cast<int>(threads_.size());
    ++round_;
    round_.notify_all();
    take_pieces();
    for (int left = busy_; left > 0; left = busy_) busy_.wait(left);
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  }

 private:
  void serve() {
    for (unsigned seen = 0;;) {
      round_.wait(seen);
      seen = round_;
      if (stopping_) return;
      take_pieces();
      if (--busy_ == 0) busy_.notify_one();
    }
  }

  void take_pieces() {
    try {
      const StopScope scope(stop_);
      for (std::size_t piece = next_++; piece < count_; piece = next_++) {
        stop_point();
        (*job_)(piece);
      }
    } catch (...) {
      const std::lock_guard lock(failing_);
      if (!failure_) failure_ = std::current_exception();
      next_ = count_;
    }
  }

  const std::function<void(std::size_t)>* job_ = nullptr;
  std::stop_token stop_;  ///< of the thread that has called run()
  std::size_t count_ = 0;
  std::atomic<std::size_t> next_{0};
  std::atomic<int> busy_{0};
  std::atomic<unsigned> round_{0};
  std::atomic<bool> stopping_{false};
  std::mutex failing_;
  std::exception_ptr failure_;
  std::vector<std::thread> threads_;
};

Workers::Workers(int threads) {
  assert(threads >= 1);
  if (threads > 1) helpers_ = std::make_unique<Helpers>(threads - 1);
}

Workers::~Workers() = default;

void Workers::each(std::size_t count, const std::function<void(std::size_t)>& job) {
  if (helpers_ && count > 1) return helpers_->run(count, job);
  for (std::size_t piece = 0; piece < count; ++piece) {
    stop_point();
    job(piece);
  }
}

void Workers::ranges(std::size_t count, std::size_t size,
                     const std::function<void(std::size_t, std::size_t)>& job) {
  each((count + size - 1) / size,
       [&](std::size_t piece) { job(piece * size, std::min((piece + 1) * size, count)); });
}

}  // namespace unicursal::core
