// Coroutines of one event loop waiting for each other: until something is so, or a deadline has passed.
#pragma once

#include <asio/any_io_executor.hpp>
#include <asio/awaitable.hpp>
#include <asio/steady_timer.hpp>
#include <functional>
#include <list>
#include <memory>

#include "host/loop/clock.hpp"

namespace unicursal::host {

class Signal {
 public:
  Signal(asio::any_io_executor executor, std::shared_ptr<Clock> clock)
      : executor_(std::move(executor)), clock_(std::move(clock)) {}

  /// Returns whether `ready` holds, at the latest at `deadline`. `ready` and the signal must live until then.
  asio::awaitable<bool> wait(TimePoint deadline, const std::function<bool()>& ready);
  /// Wakes those whose condition has come true. To be called after anything they may wait for.
  void notify();

 private:
  struct Waiter {
    asio::steady_timer timer;
    const std::function<bool()>& ready;
  };

  asio::any_io_executor executor_;
  std::shared_ptr<Clock> clock_;
  std::list<Waiter> waiters_;
};

}  // namespace unicursal::host
