#include "host/loop/signal.hpp"

#include <asio/redirect_error.hpp>
#include <asio/use_awaitable.hpp>

namespace unicursal::host {

/// One waiter's, given up also when the coroutine that waits is destroyed, such as with its loop: its
/// condition refers to what goes away with it.
class Signal::Place {
 public:
  Place(const Signal& signal, TimePoint deadline, const std::function<bool()>& ready)
      : of_(signal.waiters_),
        clock_(signal.clock_),
        at_(signal.waiters_->insert(signal.waiters_->end(),
                                    Waiter{asio::steady_timer(signal.executor_), ready})) {
    clock_->set(timer(), deadline);
  }
  ~Place() {
    const std::shared_ptr<Waiters> all = of_.lock();
    if (!all) return;  // the signal went first, with its timers
    clock_->forget(timer());
    all->erase(at_);
  }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;

  asio::steady_timer& timer() { return at_->timer; }

 private:
  std::weak_ptr<Waiters> of_;
  std::shared_ptr<Clock> clock_;
  Waiters::iterator at_;
};

asio::awaitable<bool> Signal::wait(TimePoint deadline, const std::function<bool()>& ready) {
  if (ready()) co_return true;
  {
    Place place(*this, deadline, ready);
    asio::error_code ended;
    co_await place.timer().async_wait(asio::redirect_error(asio::use_awaitable, ended));
  }
  co_return ready();
}

void Signal::notify() {
  for (Waiter& waiter : *waiters_) {
    if (waiter.ready()) waiter.timer.cancel();
  }
}

}  // namespace unicursal::host
