// Lets coroutines of one event loop wait for a condition, or until a deadline has passed.
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

  /// Waits until `ready` holds, at the latest until `deadline`; returns whether it holds. `ready` and the
  /// signal must live until then, or until the coroutine that waits is destroyed.
  asio::awaitable<bool> wait(TimePoint deadline, const std::function<bool()>& ready);
  /// Wakes the waiters whose condition has come true. To be called after every change that they may wait for.
  void notify();

 private:
  struct Waiter {
    asio::steady_timer timer;
    const std::function<bool()>& ready;
  };
  using Waiters = std::list<Waiter>;
  class Place;

  asio::any_io_executor executor_;
  std::shared_ptr<Clock> clock_;
  std::shared_ptr<Waiters> waiters_ = std::make_shared<Waiters>();
};

}  // namespace unicursal::host
