// An idle printer that is lost while it is hot. The simulated printer runs in real time, a hundred times as
// fast: on a virtual clock no cable is plugged in again.
#include <fcntl.h>
#include <poll.h>

#include <asio/io_context.hpp>
#include <asio/steady_timer.hpp>
#include <asio/thread_pool.hpp>
#include <asio/use_awaitable.hpp>
#include <catch2/catch.hpp>
#include <functional>

#include "host/files/descriptor.hpp"
#include "tests/host/support/child_process.hpp"
#include "tests/host/support/idle_session.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal {
namespace {

using namespace std::chrono_literals;
using Catch::Matchers::Contains;
using host::IdlePrinter;
using Connection = host::IdleStatus::Connection;

class LostPrinterBench {
 public:
  /// Its cable is pulled when the fan is switched on, and plugged in again after a second, or never.
  explicit LostPrinterBench(const std::string& fault = "disconnect:100@command=M106")
      : profile_(host::load_profile(folder_.write("bench.toml", test::sample_profile))),
        printer_({"simulate", "--profile", (folder_ / "bench.toml").string(), "--link", port(), "--speed",
                  "100", "--transcript", (folder_ / "lines").string(), "--fault", fault}) {
    look([&] { return plugged(); });
  }

  /// `named`: under which it is connected; empty: its own.
  void run(const test::IdleScript& script, const std::string& named = {}) {
    asio::io_context loop{1};
    asio::thread_pool opener(1);
    IdlePrinter idle(loop.get_executor(), opener.get_executor());
    const test::IdlePort place{profile_, named.empty() ? port() : named};
    test::with_idle_printer(loop, idle, place, *this, script, [&] { loop.run(); });
    opener.join();
  }

  asio::awaitable<void> until(std::function<bool()> so) {
    asio::steady_timer timer(co_await asio::this_coro::executor);
    const auto end = std::chrono::steady_clock::now() + 1min;
    while (!so()) {
      if (std::chrono::steady_clock::now() > end) throw std::runtime_error("waited in vain");
      timer.expires_after(5ms);
      co_await timer.async_wait(asio::use_awaitable);
    }
  }
  asio::awaitable<void> lose_hot(IdlePrinter& idle) {
    idle.heat(200, 60);
    co_await until([&] { return idle.status().temperatures.bed_target == 60; });
    idle.fan(50);
    co_await until([&] { return idle.status().connection == Connection::closed; });
    CHECK_THAT(idle.status().problem, Contains("its heaters were on"));
    CHECK(idle.may_be_hot());
  }

  const host::Profile& profile() const { return profile_; }
  std::string port() const { return (folder_ / "port").string(); }
  bool plugged() const { return std::filesystem::exists(port()); }
  bool was_asked() {
    kill(printer_.id(), SIGTERM);
    printer_.wait();
    return test::read_text(folder_ / "lines").find("M115") != std::string::npos;
  }
  /// Whether both heaters were switched off after they had been switched on.
  bool cooled() {
    kill(printer_.id(), SIGTERM);
    printer_.wait();
    const std::string lines = test::read_text(folder_ / "lines");
    return lines.rfind("M104 S0") != std::string::npos && lines.rfind("M104 S0") > lines.rfind("M104 S200") &&
           lines.rfind("M140 S0") != std::string::npos && lines.rfind("M140 S0") > lines.rfind("M140 S60");
  }

 private:
  void look(const std::function<bool()>& so) const {
    while (!so()) {
      if (!printer_.running()) throw std::runtime_error("no simulator: " + printer_.err());
      poll(nullptr, 0, 2);
    }
  }

  test::TempFolder folder_;
  host::Profile profile_;
  test::Child printer_;
};

}  // namespace

TEST_CASE("a print gets no hot printer that is lost, and a cold one when it is back", "[optimised]") {
  LostPrinterBench bench;
  bench.run([&](IdlePrinter& idle) -> asio::awaitable<void> {
    co_await bench.lose_hot(idle);
    CHECK(co_await idle.hand_over() == -1);
    CHECK_FALSE(idle.wanted());
    CHECK(idle.may_be_hot());
    CHECK_THAT(idle.status().problem, Contains("switch it off by its own switch"));
    co_await bench.until([&] { return bench.plugged(); });
    const int port = co_await idle.hand_over();
    CHECK(port >= 0);
    CHECK_FALSE(idle.may_be_hot());
    ::close(port);
  });
  CHECK(bench.cooled());
}

TEST_CASE("a hot printer that was found by a search is looked for by its own adapter, not by another search",
          "[optimised]") {
  LostPrinterBench bench("disconnect@command=M106"), other;
  const test::TempFolder folder;
  // What a search finds: a name that is not a path from the root, as "auto" is not.
  const std::filesystem::path found = folder / "found";
  std::filesystem::create_symlink(bench.port(), found);
  const std::string searched = found.lexically_relative(std::filesystem::current_path()).string();
  // As long as this is open, no other terminal gets the name of the lost printer's.
  const host::Descriptor kept(::open(bench.port().c_str(), O_RDONLY | O_NOCTTY | O_CLOEXEC));
  const auto script = [&](IdlePrinter& idle) -> asio::awaitable<void> {
    co_await bench.lose_hot(idle);
    std::filesystem::remove(found);
    std::filesystem::create_symlink(other.port(), found);
    CHECK(co_await idle.hand_over() == -1);
    idle.connect(bench.profile(), searched);  // as after a print that did not get it
    CHECK(idle.wanted());
    CHECK(co_await idle.hand_over() == -1);
    CHECK(idle.may_be_hot());
  };
  bench.run(script, searched);
  CHECK_FALSE(other.was_asked());
}

TEST_CASE("an order to move filament has failed when the printer is lost before it began", "[optimised]") {
  LostPrinterBench bench;
  bench.run([&](IdlePrinter& idle) -> asio::awaitable<void> {
    idle.fan(50);
    idle.feed({host::FeedingKind::load, 0, 20.0});
    co_await bench.until([&] { return idle.status().connection == Connection::closed; });
    CHECK(idle.status().fed == host::Ending::failed);
  });
}

}  // namespace unicursal
