#include "host/loop/clock.hpp"

namespace unicursal::host {
namespace {

class RealClock final : public Clock {
 public:
  explicit RealClock(double speed) : speed_(speed) {}

  TimePoint now() const override {
    return start_ + scaled(std::chrono::steady_clock::now() - start_, speed_);
  }

  void set(asio::steady_timer& timer, TimePoint deadline) override {
    timer.expires_at(deadline == TimePoint::max() ? deadline
                                                  : start_ + scaled(deadline - start_, 1 / speed_));
  }

 private:
  static Duration scaled(Duration duration, double factor) {
    if (factor == 1) return duration;
    return std::chrono::duration_cast<Duration>(duration * factor);
  }

  const double speed_;
  const TimePoint start_ = std::chrono::steady_clock::now();
};

}  // namespace

std::shared_ptr<Clock> real_clock(double speed) {
  return std::make_shared<RealClock>(speed);
}

}  // namespace unicursal::host
