// Hosts and cables that come and go, and time in lockstep, over real pseudo-terminals and sockets.
#include <catch2/catch.hpp>

#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <termios.h>

#include <cstring>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "child.hpp"
#include "folder.hpp"

using namespace unicursal::sim;

namespace {

nlohmann::json report_of(const SimulatorOptions& options) {
  return nlohmann::json::parse(std::ifstream(*options.report));
}

SimulatorOptions in(const Folder& folder) {
  SimulatorOptions options;
  options.link = folder.path() / "printer";
  options.report = folder.path() / "report.json";
  options.once = true;
  return options;
}

/// The host's end of the control socket.
class Clock {
 public:
  explicit Clock(const std::filesystem::path& path) : socket_(::socket(AF_UNIX, SOCK_STREAM, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, path.c_str(), path.string().size());
    REQUIRE(::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
  }
  ~Clock() { ::close(socket_); }

  void say(const std::string& words) {
    const std::string line = words + "\n";
    REQUIRE(::send(socket_, line.data(), line.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(line.size()));
  }
  std::string ask(const std::string& question) {
    say(question);
    std::string answer;
    for (char byte = 0; ::read(socket_, &byte, 1) == 1 && byte != '\n';) answer += byte;
    return answer;
  }

 private:
  int socket_;
};

}  // namespace

TEST_CASE("a pulled cable ends the host's line, and returns behind the same link") {
  const Folder folder;
  SimulatorOptions options = in(folder);
  options.faults = {"disconnect:2@line=2"};
  Child child(options);
  {
    Host host(options.link->string());
    host.expect("start");
    host.write(Bench::numbered(1, "G90") + "\n" + Bench::numbered(2, "M83") + "\n");
    CHECK(host.lost());
  }
  while (!std::filesystem::exists(*options.link)) ::usleep(1000);
  Host host(options.link->string());
  host.write("M114\n");
  host.expect("ok");
  host.hang_up();
  REQUIRE(child.wait() == 0);
  CHECK(report_of(options)["lines"]["accepted"] == 2);
}

TEST_CASE("a cable that never returns ends the simulation, with a report") {
  const Folder folder;
  SimulatorOptions options = in(folder);
  options.faults = {"disconnect@line=1"};
  Child child(options);
  Host host(options.link->string());
  host.expect("start");
  host.write(Bench::numbered(1, "G90") + "\n");
  CHECK(host.lost());
  REQUIRE(child.wait() == 0);
  CHECK(report_of(options)["faults"]["disconnect"] == 1);
}

TEST_CASE(
    "a printer that falls silent in mid-command, or loses its cable while it boots, ends with its "
    "host") {
  const Folder folder;
  SimulatorOptions options = in(folder);
  SECTION("silence while it heats") {
    options.faults = {"silence@line=2"};
    Child child(options);
    Host host(options.link->string());
    host.expect("start");
    host.write(Bench::numbered(1, "M104 S200") + "\n" + Bench::numbered(2, "M109 S200") + "\n");
    host.hang_up();
    CHECK(child.wait() == 0);
    CHECK(report_of(options)["faults"]["silence"] == 1);
  }
  SECTION("a pulled cable") {
    options.faults = {"disconnect@t=0.1"};
    Child child(options);
    Host host(options.link->string());
    CHECK(host.lost());
    CHECK(child.wait() == 0);
  }
}

TEST_CASE(
    "opening the port resets a board with its reset on DTR, unless the previous host has cleared HUPCL") {
  const Folder folder;
  SimulatorOptions options = in(folder);
  options.once = false;
  options.personality = "marlin-8bit";
  options.control = folder.path() / "clock";
  Child child(options);
  const auto visit = [&](std::int64_t second, bool clear_hupcl) {
    Clock clock(*options.control);
    clock.ask(fmt::format("wait {} 0", second * 1'000'000'000));  // a boot, if any, is over
    Host host(options.link->string());
    termios settings{};
    ::tcgetattr(host.port(), &settings);
    settings.c_cflag &= ~static_cast<tcflag_t>(HUPCL);
    if (clear_hupcl) ::tcsetattr(host.port(), TCSANOW, &settings);
    host.hang_up();
  };
  visit(10, false);
  visit(20, true);  // DTR had dropped, so the board resets
  visit(30, true);  // DTR had not dropped
  REQUIRE(child.stop() == 0);
  CHECK(report_of(options)["resets"] == 1);
}

TEST_CASE("in lockstep, time advances only as far as the host says, or to the next bytes for it") {
  const Folder folder;
  SimulatorOptions options = in(folder);
  options.control = folder.path() / "clock";
  options.usb = "none";
  Child child(options);
  {
    Host host(child.path());
    Clock clock(*options.control);
    CHECK(clock.ask("wait 100000000 0") == "at 100000000 0");
    CHECK(clock.ask("wait -1 0") == "at 500240000 6");  // half a second of boot, six bytes of 40 µs
    CHECK(host.read_line() == "start");
    std::string answer;
    do {
      answer = clock.ask("wait 2000000000 0");
    } while (!answer.starts_with("at 2000000000 "));
    const std::string told = answer.substr(13, answer.find(' ', 14) - 13);
    CHECK(clock.ask("wait -1 0") == "at 2000000000" + told + " idle");
    host.write("G4 P1500\n");
    CHECK(clock.ask("wait 3000000000 9") == "at 3000000000" + told);
    CHECK(clock.ask("wait 9000000000 9")
              .starts_with("at 3500480000 "));  // nine bytes to the printer, three back
    host.expect("ok");
  }
  CHECK(child.wait() == 0);
  CHECK_FALSE(std::filesystem::exists(*options.control));
}

TEST_CASE("neither a host that waits for ever and leaves, nor a signal, blocks the simulator") {
  const Folder folder;
  SimulatorOptions options = in(folder);
  options.control = folder.path() / "clock";
  const bool hot = GENERATE(true, false), leaves = GENERATE(true, false);
  options.once = hot;  // a host that has written nothing has not used the line
  Child child(options);
  Host host(child.path());
  auto clock = std::make_unique<Clock>(*options.control);
  while (!clock->ask("wait 2000000000 0").starts_with("at 2000000000 ")) {
  }
  if (hot) host.write("M104 S200\n");
  const std::string written = hot ? "10" : "0";
  while (!clock->ask("wait 30000000000 " + written).starts_with("at 30000000000 ")) {
  }
  clock->say("wait -1 " + written);  // the heater keeps working, and nothing will ever be said again
  if (leaves) clock.reset();
  CHECK((leaves && hot ? child.wait() : child.stop()) == 0);
  CHECK(report_of(options)["printer_seconds"] > 30);
}

TEST_CASE("an invalid message on the control socket ends the simulation") {
  const Folder folder;
  SimulatorOptions options = in(folder);
  options.control = folder.path() / "clock";
  const std::string words = GENERATE("hello", "wait", "wait 1", "wait x y", "wait 5 -1", "wait 5 0 0",
                                     "wait 5  0", " wait 5 0", "wait 99999999999999999999 0");
  Child child(options);
  Clock clock(*options.control);
  CHECK(clock.ask(words).empty());
  CHECK(child.wait() != 0);
}
