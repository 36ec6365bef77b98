// The time that a link lives in: this computer's, or that of a simulated printer. Whatever the link waits
// for, however long it is patient, is measured by one of these, so a dry run has the timeouts of a real
// print.
#pragma once

#include <asio/io_context.hpp>
#include <asio/steady_timer.hpp>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>

namespace unicursal::host {

using TimePoint = std::chrono::steady_clock::time_point;
using Duration = std::chrono::steady_clock::duration;

class Clock {
 public:
  virtual ~Clock() = default;

  virtual TimePoint now() const = 0;
  /// Lets a timer on which nobody waits yet expire when this clock shows `deadline`, by cancelling it if need
  /// be.
  virtual void set(asio::steady_timer& timer, TimePoint deadline) = 0;
  /// The timer is about to go.
  virtual void forget(asio::steady_timer&) noexcept {}
  /// Runs the loop until it is stopped.
  virtual void run(asio::io_context& loop) { loop.run(); }
  /// The link hangs on this descriptor and has written so many bytes to it; −1 when it has closed it.
  virtual void attach(int /*port*/, std::function<std::uint64_t()> /*written*/) {}

  /// Whether bytes that were written may be thrown away before they arrive.
  virtual bool may_discard() const { return true; }

  /// While one of these lives, a clock that is not this computer's stands still: the host works, it does not
  /// wait.
  class Hold {
   public:
    explicit Hold(Clock& clock) : clock_(clock) { ++clock_.held_; }
    ~Hold() { --clock_.held_; }
    Hold(const Hold&) = delete;
    Hold& operator=(const Hold&) = delete;

   private:
    Clock& clock_;
  };

 protected:
  bool held() const { return held_ > 0; }

 private:
  int held_ = 0;
};

/// This computer's clock, or one that goes `speed` times as fast.
std::shared_ptr<Clock> real_clock(double speed = 1);

}  // namespace unicursal::host
