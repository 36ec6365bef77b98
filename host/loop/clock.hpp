// The clock of a print: this computer's, or that of a simulated printer. All waits and timeouts are measured
// by it, so a dry run has the timeouts of a real print.
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
  /// Arms `timer`, which must have no waiters, to fire at `deadline` of this clock. A virtual clock fires it
  /// by cancelling it.
  virtual void set(asio::steady_timer& timer, TimePoint deadline) = 0;
  /// To be called before the timer is destroyed.
  virtual void forget(asio::steady_timer&) noexcept {}
  /// Runs the loop until it is stopped.
  virtual void run(asio::io_context& loop) { loop.run(); }
  /// To be called when a serial line is opened: `port` is its descriptor, and `written` returns the number of
  /// bytes written to it so far. −1 means that it was closed.
  virtual void attach(int /*port*/, std::function<std::uint64_t()> /*written*/) {}

  /// Whether written bytes may be discarded before they arrive.
  virtual bool may_discard() const { return true; }

  /// While an object of this class exists, a virtual clock stands still: the host works and does not wait.
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

/// This computer's clock, or one that runs `speed` times as fast.
std::shared_ptr<Clock> real_clock(double speed = 1);

}  // namespace unicursal::host
