#include "host/engine/step_wait.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <future>

namespace unicursal::host {
namespace {

/// Becomes ready on another thread while it is asked for the first time, and answers only when its listener
/// has returned, as a source does that calls its listener under the lock that ready() takes.
class BecomesReady final : public FinishedSource {
 public:
  using FinishedSource::FinishedSource;

  bool ready() const override {
    if (++asked_ > 1) return true;
    call_ = std::async(std::launch::async, listener_);
    listener_returned_ = call_.wait_for(std::chrono::seconds(10)) == std::future_status::ready;
    return false;
  }
  void on_ready(std::function<void()> listener) override { listener_ = std::move(listener); }
  bool listener_returned() const { return listener_returned_; }
  int asked() const { return asked_; }
  bool heard() const { return static_cast<bool>(listener_); }

 private:
  std::function<void()> listener_;
  mutable std::future<void> call_;
  mutable bool listener_returned_ = false;
  mutable int asked_ = 0;
};

}  // namespace

TEST_CASE("Waiting for a source neither blocks its listener nor misses a call during the question") {
  const FinishedPrint print;
  const gcode::Printer printer;
  BecomesReady source(print, printer);
  {
    StepWait next(source);
    next.wait();
    CHECK(source.listener_returned());
    CHECK(source.asked() == 2);
  }
  CHECK(!source.heard());
}

}  // namespace unicursal::host
