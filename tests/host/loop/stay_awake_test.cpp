// A print keeps its computer awake: the real program, a real message bus, and a stand-in for systemd-logind,
// which cannot run without being the system's own.
#include <systemd/sd-bus.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <cerrno>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "tests/host/support/daemon_process.hpp"

using namespace unicursal;

namespace {

/// A bus of our own, in the place of the system's for this process and its children.
class Bus {
 public:
  Bus() {
    folder_.write(
        "bus.conf", R"(<!DOCTYPE busconfig PUBLIC "-//freedesktop//DTD D-Bus Bus Configuration 1.0//EN"
  "http://www.freedesktop.org/standards/dbus/1.0/busconfig.dtd">
<busconfig>
  <listen>unix:path=)" + socket() +
                        R"(</listen>
  <auth>EXTERNAL</auth>
  <policy context="default">
    <allow own="*"/> <allow send_destination="*"/> <allow receive_sender="*"/> <allow user="*"/>
  </policy>
</busconfig>
)");
    const std::string config = "--config-file=" + (folder_ / "bus.conf").string();
    id_ = fork();
    REQUIRE(id_ >= 0);
    if (id_ == 0) {
      execlp("dbus-daemon", "dbus-daemon", config.c_str(), "--nofork", "--nopidfile", nullptr);
      _exit(127);
    }
    setenv("DBUS_SYSTEM_BUS_ADDRESS", ("unix:path=" + socket()).c_str(), 1);
  }
  ~Bus() {
    unsetenv("DBUS_SYSTEM_BUS_ADDRESS");
    kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
  }
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  std::string socket() const { return (folder_ / "bus").string(); }

 private:
  test::TempFolder folder_;
  pid_t id_ = -1;
};

/// Answers org.freedesktop.login1.Manager.Inhibit, and notices when the lock is given back.
class Logind {
 public:
  Logind() {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (sd_bus_open_system(&bus_) < 0) {
      REQUIRE(std::chrono::steady_clock::now() < end);  // the bus begins to listen soon
      poll(nullptr, 0, 10);
    }
    REQUIRE(sd_bus_add_object_vtable(bus_, nullptr, "/org/freedesktop/login1",
                                     "org.freedesktop.login1.Manager", table.data(), this) >= 0);
    REQUIRE(sd_bus_request_name(bus_, "org.freedesktop.login1", 0) >= 0);
  }
  ~Logind() {
    sd_bus_flush_close_unref(bus_);
    if (lock_ >= 0) close(lock_);
  }
  Logind(const Logind&) = delete;
  Logind& operator=(const Logind&) = delete;

  /// Answers one message, or waits for one for a tenth of a second.
  void serve() {
    if (sd_bus_process(bus_, nullptr) == 0) sd_bus_wait(bus_, 100'000);
  }
  const std::vector<std::string>& asked() const { return asked_; }
  /// The other end of the lock has been closed.
  bool given_back() const {
    pollfd end{lock_, 0, 0};
    return poll(&end, 1, 0) == 1 && (end.revents & (POLLHUP | POLLERR)) != 0;
  }

 private:
  static int inhibit(sd_bus_message* message, void* self, sd_bus_error*) {
    auto& logind = *static_cast<Logind*>(self);
    const char *what = nullptr, *who = nullptr, *why = nullptr, *mode = nullptr;
    if (sd_bus_message_read(message, "ssss", &what, &who, &why, &mode) < 0) return -EINVAL;
    logind.asked_ = {what, who, why, mode};
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) return -errno;
    logind.lock_ = ends[1];
    const int sent = sd_bus_reply_method_return(message, "h", ends[0]);
    close(ends[0]);
    return sent;
  }
  static constexpr std::array<sd_bus_vtable, 3> table{
      sd_bus_vtable(SD_BUS_VTABLE_START(0)),
      sd_bus_vtable(SD_BUS_METHOD("Inhibit", "ssss", "h", inhibit, SD_BUS_VTABLE_UNPRIVILEGED)),
      sd_bus_vtable(SD_BUS_VTABLE_END)};

  sd_bus* bus_ = nullptr;
  std::vector<std::string> asked_;
  int lock_ = -1;
};

}  // namespace

TEST_CASE("a print keeps the computer awake until it has ended") {
  const Bus bus;
  Logind logind;
  const test::TempFolder folder;
  folder.write("bench.toml", test::sample_profile);
  folder.write("plate.svg", test::sample_drawing);
  folder.write("job.toml", test::sample_job);
  const auto path = [&](const char* name) { return (folder / name).string(); };
  test::Child printer({"simulate", "--profile", path("bench.toml"), "--link", path("port"), "--speed", "20",
                       "--transcript", path("lines")});
  test::await([&] { return std::filesystem::exists(folder / "port"); }, printer);
  test::Child print({"print", path("job.toml"), "--port", path("port"), "--spool", path("spool")});

  test::await(
      [&] {
        logind.serve();
        return !logind.asked().empty();
      },
      print);
  CHECK(logind.asked() == std::vector<std::string>{"sleep:idle", "unicursal", "printing job", "block"});
  test::await([&] { return test::read_text(folder / "lines").find("G1 X") != std::string::npos; }, print);
  CHECK_FALSE(logind.given_back());
  kill(print.id(), SIGTERM);
  CHECK(print.wait().code == 3);
  CHECK(logind.given_back());
}
