#include "host/loop/signal.hpp"

#include <asio/redirect_error.hpp>
#include <asio/use_awaitable.hpp>

namespace unicursal::host {

asio::awaitable<bool> Signal::wait(TimePoint deadline, const std::function<bool()>& ready) {
  if (ready()) co_return true;
  const auto place = waiters_.insert(waiters_.end(), Waiter{asio::steady_timer(executor_), ready});
  clock_->set(place->timer, deadline);
  asio::error_code ended;
  co_await place->timer.async_wait(asio::redirect_error(asio::use_awaitable, ended));
  clock_->forget(place->timer);
  waiters_.erase(place);
  co_return ready();
}

void Signal::notify() {
  for (Waiter& waiter : waiters_) {
    if (waiter.ready()) waiter.timer.cancel();
  }
}

}  // namespace unicursal::host
