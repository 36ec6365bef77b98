// An idle printer against the simulated one, which is a process of its own, on one virtual clock: nothing
// here waits for real minutes.
#include <poll.h>

#include <asio/io_context.hpp>
#include <asio/thread_pool.hpp>
#include <catch2/catch.hpp>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

#include "host/dry_run/lockstep_clock.hpp"
#include "host/loop/signal.hpp"
#include "tests/host/support/child_process.hpp"
#include "tests/host/support/idle_session.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal {
namespace {

using namespace std::chrono_literals;
using Catch::Matchers::Contains;
using host::IdlePrinter;
using host::IdleRefused;
using host::IdleStatus;
using Connection = host::IdleStatus::Connection;

constexpr double steps_per_mm = 400;  // of the simulated feeders

class IdleBench {
 public:
  explicit IdleBench(const std::string& firmware = "marlin", const std::vector<std::string>& more = {})
      : profile_(host::load_profile(folder_.write(
            "bench.toml", test::replaced(test::sample_profile, "\"marlin\"", "\"" + firmware + "\"") +
                              "[temperature]\nhottest_nozzle = 260\nhottest_bed = 90\n"))),
        printer_(arguments(more)) {
    while (printer_.out().find('\n') == std::string::npos) {
      if (!printer_.running()) throw std::runtime_error("no simulator: " + printer_.err());
      poll(nullptr, 0, 2);
    }
  }

  /// Connects, runs the script, and closes the connection.
  void run(const test::IdleScript& script) {
    clock_ = std::make_shared<host::LockstepClock>(folder_ / "clock");
    {
      asio::io_context loop{1};
      asio::thread_pool opener(1);
      IdlePrinter idle(loop.get_executor(), opener.get_executor(), clock_);
      signal_ = std::make_unique<host::Signal>(loop.get_executor(), clock_);
      idle.on_change([this] { signal_->notify(); });
      test::with_idle_printer(loop, idle, {profile_, port()}, *this, script, [&] { clock_->run(loop); });
      opener.join();
      idle.on_change(nullptr);
      signal_.reset();
    }
    clock_.reset();  // hangs up, which the simulator waits for
    const test::Outcome ended = printer_.wait();
    INFO(ended.err);
    CHECK(ended.code == 0);
    seen_ = nlohmann::json::parse(test::read_text(folder_ / "seen.json"));
  }

  /// Printer time passes meanwhile; ten minutes end the wait.
  asio::awaitable<void> until(std::function<bool()> so) {
    const bool came = co_await signal_->wait(clock_->now() + 10min, so);
    CHECK(came);
  }
  asio::awaitable<void> pass(std::chrono::seconds time) {
    const std::function<bool()> never = [] { return false; };
    co_await signal_->wait(clock_->now() + time, never);
  }

  const host::Profile& profile() const { return profile_; }
  std::string port() const { return (folder_ / "port").string(); }
  const nlohmann::json& seen() const { return seen_; }
  std::string lines() const { return test::read_text(folder_ / "lines"); }
  double turned(std::size_t feeder) const {
    return seen_["not_printed"]["feeder_steps"][feeder].get<double>() / steps_per_mm;
  }
  double target(const char* heater) const { return seen_["temperatures"][heater]["target"]; }

 private:
  std::vector<std::string> arguments(const std::vector<std::string>& more) const {
    std::vector<std::string> all{"simulate",     "--once",
                                 "--profile",    (folder_ / "bench.toml").string(),
                                 "--link",       (folder_ / "port").string(),
                                 "--control",    (folder_ / "clock").string(),
                                 "--report",     (folder_ / "seen.json").string(),
                                 "--transcript", (folder_ / "lines").string()};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  test::TempFolder folder_;
  host::Profile profile_;
  test::Child printer_;
  std::shared_ptr<host::LockstepClock> clock_;
  std::unique_ptr<host::Signal> signal_;
  nlohmann::json seen_;
};

std::size_t times(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

}  // namespace

TEST_CASE("an idle printer heats, homes and moves, and is cold when its connection is closed") {
  const std::string firmware = GENERATE("marlin", "repetier", "reprapfirmware");
  CAPTURE(firmware);
  IdleBench bench(firmware);
  bench.run([&](IdlePrinter& idle) -> asio::awaitable<void> {
    CHECK_FALSE(idle.status().homed);
    CHECK_FALSE(idle.status().at);
    CHECK_FALSE(idle.status().cools_in);
    CHECK_THROWS_WITH(idle.move({10, 0, 0}), Contains("home all axes first"));
    idle.heat(120, 40);
    co_await bench.until([&] { return idle.status().temperatures.nozzle.value_or(0) > 110; });
    CHECK(idle.status().temperatures.nozzle_target == 120);
    CHECK(idle.status().cools_in.value_or(0) > 600);
    idle.home({true, true, true});
    co_await bench.until([&] { return idle.status().homed && idle.status().at; });
    const auto before = *idle.status().at;
    idle.move({30, 20, 10});
    idle.move({-10, 0, 0});
    co_await bench.pass(30s);
    REQUIRE(idle.status().at);
    CHECK((*idle.status().at)[0] == Approx(before[0] + 20));
    CHECK((*idle.status().at)[1] == Approx(before[1] + 20));
    CHECK((*idle.status().at)[2] == Approx(before[2] + 10));
    idle.fan(50);
    co_await bench.pass(2s);
  });
  CHECK(bench.target("nozzle") == 0);
  CHECK(bench.target("bed") == 0);
  CHECK_THAT(bench.lines(), Contains("M106 S128") && Contains("M140 S40"));
}

TEST_CASE("moves and heat stay within the limits of the profile") {
  IdleBench bench;
  bench.run([&](IdlePrinter& idle) -> asio::awaitable<void> {
    CHECK_THROWS_WITH(idle.heat(261, std::nullopt), Contains("0 to 260 °C"));
    CHECK_THROWS_WITH(idle.heat(200, 91), Contains("0 to 90 °C"));
    CHECK_THROWS_AS(idle.heat(std::nan(""), std::nullopt), IdleRefused);
    CHECK_THROWS_AS(idle.heat(-1, std::nullopt), IdleRefused);
    CHECK_THROWS_AS(idle.fan(101), IdleRefused);
    CHECK_THROWS_WITH(idle.home({false, false, true}), Contains("home x and y"));
    CHECK_THROWS_WITH(idle.extrude(5), Contains("too cold"));
    idle.home({true, true, true});
    CHECK_THROWS_WITH(idle.move({1, 0, 0}), Contains("home"));
    co_await bench.until([&] { return idle.status().at.has_value(); });
    CHECK_THROWS_WITH(idle.move({-1, 0, 0}), Contains("x would be -1 mm"));
    CHECK_THROWS_WITH(idle.move({0, 0, -0.1}), Contains("z would be"));
    CHECK_THROWS_WITH(idle.move({0, 1e308, 0}), Contains("y would be"));
    CHECK_THROWS_AS(idle.move({std::nan(""), 0, 0}), IdleRefused);
    for (int i = 0; i < 16; ++i) idle.move({0, 0, 0.5});
    CHECK_THROWS_WITH(idle.move({0, 0, 0.5}), Contains("too many commands"));
    co_await bench.pass(20s);
    CHECK((*idle.status().at)[2] == Approx(8));
  });
  CHECK(bench.lines().find("M104 S2") == std::string::npos);
}

TEST_CASE("what is hot is switched off a quarter of an hour after the last command, and not before") {
  IdleBench bench;
  bench.run([&](IdlePrinter& idle) -> asio::awaitable<void> {
    idle.heat(200, 60);
    co_await bench.pass(840s);
    CHECK(idle.status().temperatures.nozzle_target == 200);
    CHECK(idle.status().cools_in.value_or(0) == Approx(60).margin(3));
    idle.fan(0);  // a command: the time begins again
    co_await bench.pass(890s);
    CHECK(idle.status().temperatures.nozzle_target == 200);
    CHECK(idle.status().problem.empty());
    co_await bench.pass(20s);
    CHECK(idle.status().temperatures.nozzle_target == 0);
    CHECK(idle.status().temperatures.bed_target == 0);
    CHECK_FALSE(idle.status().cools_in);
    CHECK(idle.status().connection == Connection::open);
    CHECK_THAT(idle.status().problem, Contains("quarter of an hour"));
  });
  // The firmware looks after it as well while it is hot.
  CHECK_THAT(bench.lines(), Contains("M85 S1800") && Contains("M85 S0"));
}

TEST_CASE("filament is loaded as the command does, and the connection goes on behind it") {
  IdleBench bench;
  bench.run([&](IdlePrinter& idle) -> asio::awaitable<void> {
    CHECK_THROWS_AS(idle.feed({host::FeedingKind::load, 3, {}}), core::DataError);
    CHECK_THROWS_AS(idle.feed({host::FeedingKind::load, {}, {}}), core::DataError);
    CHECK_THROWS_AS(idle.feed({host::FeedingKind::load, 1, 2001.0}), core::DataError);
    idle.heat(std::nullopt, 50);
    idle.feed({host::FeedingKind::load, 1, 30.0});
    CHECK(idle.feeding());
    CHECK_THROWS_WITH(idle.heat(100, std::nullopt), Contains("filament is being moved"));
    co_await bench.until([&] { return idle.status().action == IdleStatus::Action::feeding; });
    CHECK_THAT(idle.status().doing, Contains("feeder 2 loads 30 mm"));
    co_await bench.until([&] { return !idle.feeding(); });
    CHECK(idle.status().connection == Connection::open);
    CHECK_FALSE(idle.status().homed);
    co_await bench.pass(5s);
    CHECK(idle.status().temperatures.nozzle_target == 0);
    CHECK(idle.status().temperatures.bed_target == 50);
    CHECK(idle.status().problem.empty());
  });
  CHECK(bench.turned(1) == Approx(30).epsilon(0.01));
  CHECK(bench.turned(0) == Approx(30 * 0.02 / 0.96).margin(0.05));
  CHECK(bench.target("bed") == 0);
}

TEST_CASE("feeding that is cancelled stops and leaves a cold printer") {
  IdleBench bench;
  bench.run([&](IdlePrinter& idle) -> asio::awaitable<void> {
    idle.feed({host::FeedingKind::load, 0, 2000.0});
    co_await bench.until([&] { return idle.status().temperatures.nozzle.value_or(0) > 205; });
    co_await bench.pass(20s);
    idle.cancel();
    co_await bench.until([&] { return !idle.feeding(); });
    co_await bench.pass(5s);
    CHECK(idle.status().temperatures.nozzle_target == 0);
    CHECK(idle.status().connection == Connection::open);
  });
  CHECK(bench.turned(0) < 1000);
}

TEST_CASE("a connection that is closed while filament moves leaves nozzle and bed cold") {
  IdleBench bench;
  bench.run([&](IdlePrinter& idle) -> asio::awaitable<void> {
    idle.heat(std::nullopt, 50);
    idle.feed({host::FeedingKind::load, 0, 2000.0});
    co_await bench.until([&] { return idle.status().temperatures.nozzle.value_or(0) > 205; });
    co_await bench.pass(20s);
    idle.disconnect();
    co_await bench.until([&] { return idle.status().connection == Connection::closed; });
  });
  CHECK(bench.target("nozzle") == 0);
  CHECK(bench.target("bed") == 0);
  CHECK(bench.turned(0) < 1000);
}

TEST_CASE("an order to move filament that is dropped before it began has ended, also when connected again") {
  IdleBench bench;
  bench.run([&](IdlePrinter& idle) -> asio::awaitable<void> {
    idle.home({true, true, true});
    idle.feed({host::FeedingKind::load, 0, 20.0});
    CHECK_FALSE(idle.status().fed);
    idle.disconnect();
    CHECK(idle.status().fed == host::Ending::stopped);
    co_await bench.until([&] { return idle.status().connection == Connection::closed; });
    idle.connect(bench.profile(), bench.port());
    co_await bench.until([&] { return idle.status().connection == Connection::open; });
    CHECK(idle.status().fed == host::Ending::stopped);
    idle.home({true, true, true});
    idle.feed({host::FeedingKind::load, 0, 20.0});
    CHECK_FALSE(idle.status().fed);
    idle.stop_at_once();
    CHECK(idle.status().fed == host::Ending::stopped);
    co_await bench.until([&] { return idle.status().connection == Connection::closed; });
  });
  CHECK(bench.turned(0) == 0);
}

TEST_CASE("feeding that the printer pauses ends, and leaves a cold nozzle") {
  IdleBench bench("marlin", {"--fault", "say://action:pause@t=200"});
  bench.run([&](IdlePrinter& idle) -> asio::awaitable<void> {
    idle.feed({host::FeedingKind::load, 0, 2000.0});
    co_await bench.until([&] { return idle.status().action == IdleStatus::Action::feeding; });
    co_await bench.until([&] { return !idle.feeding(); });
    CHECK_FALSE(idle.status().problem.empty());
    co_await bench.pass(5s);
    CHECK(idle.status().connection == Connection::open);
    CHECK(idle.status().temperatures.nozzle_target == 0);
  });
  CHECK(bench.turned(0) > 10);
  CHECK(bench.turned(0) < 1500);
}

TEST_CASE("a printer that was switched off by hand rests, and does not halt for want of commands") {
  IdleBench bench;
  bench.run([&](IdlePrinter& idle) -> asio::awaitable<void> {
    idle.heat(100, 50);
    co_await bench.pass(60s);
    idle.heat(0, std::nullopt);
    co_await bench.pass(60s);
    CHECK(idle.status().cools_in);  // the bed is still on
    idle.heat(std::nullopt, 0);
    co_await bench.pass(40min);
    CHECK(idle.status().connection == Connection::open);
    CHECK(idle.status().problem.empty());
  });
}

TEST_CASE("axes whose motors have let go are homed again before they move") {
  IdleBench bench;
  bench.run([&](IdlePrinter& idle) -> asio::awaitable<void> {
    idle.home({true, true, true});
    co_await bench.until([&] { return idle.status().at.has_value(); });
    co_await bench.pass(20min);
    idle.move({0, 0, 5});
    co_await bench.pass(20min);
    idle.move({0, 0, 5});
    co_await bench.pass(31min);
    CHECK_THROWS_WITH(idle.move({0, 0, 5}), Contains("home all axes first"));
  });
}

TEST_CASE("a printer is stopped at once also while its connection is being closed") {
  IdleBench bench;
  bench.run([&](IdlePrinter& idle) -> asio::awaitable<void> {
    idle.heat(100, std::nullopt);
    idle.home({true, true, true});
    co_await bench.until([&] { return idle.status().action == IdleStatus::Action::homing; });
    idle.disconnect();
    CHECK_THROWS_AS(idle.heat(50, std::nullopt), IdleRefused);
    idle.stop_at_once();
    co_await bench.until([&] { return idle.status().connection == Connection::closed; });
  });
  CHECK(bench.seen()["killed"] == true);
  CHECK(bench.lines().find("M104 S0") == std::string::npos);  // it was not left to the farewell
}

TEST_CASE("filament is pushed by hand through a hot nozzle, in equal shares") {
  const std::string firmware = GENERATE("marlin", "repetier", "reprapfirmware");
  CAPTURE(firmware);
  IdleBench bench(firmware);
  bench.run([&](IdlePrinter& idle) -> asio::awaitable<void> {
    idle.heat(200, std::nullopt);
    co_await bench.until([&] { return idle.status().temperatures.nozzle.value_or(0) > 195; });
    CHECK_THROWS_AS(idle.extrude(201), IdleRefused);
    idle.extrude(30);
    co_await bench.pass(60s);
  });
  for (std::size_t feeder = 0; feeder < 3; ++feeder) CHECK(bench.turned(feeder) == Approx(10).epsilon(0.02));
}

TEST_CASE("a board that resets is found again, and nobody believes it hot or homed") {
  IdleBench bench("marlin", {"--fault", "reset@t=60"});
  bench.run([&](IdlePrinter& idle) -> asio::awaitable<void> {
    idle.heat(200, 60);
    idle.home({true, true, true});
    co_await bench.until([&] { return idle.status().homed; });
    co_await bench.until([&] { return idle.status().connection == Connection::closed; });
    CHECK_THAT(idle.status().problem, Contains("has restarted"));
    CHECK_THROWS_WITH(idle.heat(200, std::nullopt), Contains("not connected"));
    co_await bench.until([&] { return idle.status().connection == Connection::open; });
    CHECK_FALSE(idle.status().homed);
    CHECK_FALSE(idle.status().cools_in);
  });
  CHECK(bench.target("nozzle") == 0);
}

TEST_CASE("a firmware that stops itself, or falls silent, closes the connection with a reason") {
  const auto [fault, reason] = GENERATE(table<std::string, std::string>({
      {"thermistor@t=40", "MINTEMP"},
      {"silence@t=40", "silent"},
  }));
  CAPTURE(fault);
  IdleBench bench("marlin", {"--fault", fault});
  bench.run([&, said = reason](IdlePrinter& idle) -> asio::awaitable<void> {
    idle.heat(100, std::nullopt);
    co_await bench.until([&] { return idle.status().connection == Connection::closed; });
    CHECK_THAT(idle.status().problem, Contains(said));
    co_await bench.pass(60s);
    CHECK(idle.status().connection == Connection::closed);
  });
}

TEST_CASE("a port is handed over hot, and is asked M115 once more only") {
  IdleBench bench;
  bench.run([&](IdlePrinter& idle) -> asio::awaitable<void> {
    idle.heat(150, std::nullopt);
    co_await bench.pass(10s);
    const int port = co_await idle.hand_over();
    CHECK(port >= 0);
    CHECK(idle.status().connection == Connection::closed);
    CHECK_FALSE(idle.wanted());
    CHECK(co_await idle.hand_over() == -1);
    idle.connect(host::Profile{}, "taken over", port);
    co_await bench.until([&] { return idle.status().connection == Connection::open; });
    co_await bench.pass(3s);
    CHECK(idle.status().temperatures.nozzle_target == 150);
  });
  CHECK(times(bench.lines(), "M115") == 2);
}

TEST_CASE("a hot printer that was handed over is cooled when it comes back, unless a print has begun on it") {
  const bool begun = GENERATE(false, true);
  IdleBench bench;
  bench.run([&](IdlePrinter& idle) -> asio::awaitable<void> {
    idle.heat(200, 60);
    co_await bench.until([&] { return idle.status().temperatures.bed_target == 60; });
    const int port = co_await idle.hand_over();
    CHECK(idle.may_be_hot());
    ::close(port);
    if (begun) idle.leave_heat_to_print();
    idle.connect(bench.profile(), bench.port());
    co_await bench.until([&] { return idle.status().connection == Connection::open; });
    co_await bench.pass(5s);
    CHECK(idle.status().temperatures.nozzle_target == (begun ? 200 : 0));
    CHECK(idle.status().temperatures.bed_target == (begun ? 60 : 0));
  });
}

}  // namespace unicursal
