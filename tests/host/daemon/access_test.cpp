// How commands reach their daemon, and who else does: the socket in the state folder, and the token.
#include <catch2/catch.hpp>

#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include "host/daemon/access.hpp"
#include "tests/host/support/daemon_process.hpp"

using namespace unicursal;
using test::DaemonBench;
using test::Outcome;
using test::RawConnection;

namespace {

std::string printed(const Outcome& outcome) {
  return outcome.out.substr(0, outcome.out.find('\n'));
}

/// A program that has taken the port of a daemon that is gone.
class Impostor {
 public:
  explicit Impostor(int port) : fd_(socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int on = 1;
    setsockopt(fd_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    REQUIRE(bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
    REQUIRE(listen(fd_, 8) == 0);
  }
  ~Impostor() { close(fd_); }
  bool was_called() const {
    const int caller = accept(fd_, nullptr, nullptr);
    if (caller >= 0) close(caller);
    return caller >= 0;
  }

 private:
  int fd_;
};

}  // namespace

TEST_CASE("commands of the daemon's user need neither a place on the network nor the token") {
  DaemonBench bench;
  bench.serve();
  struct stat found {};
  REQUIRE(stat(bench.path("state/socket").c_str(), &found) == 0);
  CHECK((found.st_mode & 0777) == 0600);
  std::filesystem::rename(bench.path("state/token"), bench.path("elsewhere"));
  std::vector<std::unique_ptr<RawConnection>> strangers;
  for (int i = 0; i < 200; ++i) strangers.push_back(std::make_unique<RawConnection>(bench.port()));
  const Outcome stopped = bench.command({"stop"});
  CHECK(stopped.err.find("nothing is being printed") != std::string::npos);  // it was heard
  CHECK(bench.command({"status"}).code == 0);
}

TEST_CASE("the address that a dead daemon has left behind is not called") {
  DaemonBench bench;
  bench.serve();
  kill(bench.daemon().id(), SIGKILL);
  bench.daemon().wait();
  REQUIRE(std::filesystem::exists(bench.path("state/address")));
  const Impostor impostor(bench.port());
  const Outcome outcome = bench.command({"status"});
  CHECK(outcome.code == 2);
  CHECK(outcome.err.find("no daemon runs") != std::string::npos);
  CHECK_FALSE(impostor.was_called());
}

TEST_CASE("a state folder with a long name has its socket, too") {
  const test::TempFolder folder;
  const std::string state = (folder / std::string(100, 'a') / std::string(100, 'b')).string();
  test::Child daemon({"serve", "--listen", "127.0.0.1:0", "--state", state});
  test::await([&] { return daemon.out().find('\n') != std::string::npos; }, daemon);
  CHECK(test::run({"status", "--state", state}).code == 0);
}

TEST_CASE("a renewed token shuts out who knew the old one, and its followers") {
  DaemonBench bench;
  bench.serve();
  const std::string old = bench.token(), metrics = test::read_text(bench.path("state/metrics-token"));
  CHECK(printed(bench.command({"token"})) == old);
  RawConnection follower(bench.port());
  follower.send(test::replaced(bench.request("GET", "/api/events"), "Connection: close",
                               "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
                               "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ=="));
  follower.read_until("\"hello\"");
  CHECK(bench.status(bench.request("POST", "/api/token/renew")) == 403);
  const std::string renewed = printed(bench.command({"token", "--renew"}));
  CHECK(renewed.size() == old.size());
  CHECK(renewed != old);
  CHECK(test::read_text(bench.path("state/metrics-token")) != metrics);
  const std::string close_frame = "\x88\x02\x03\xe9";  // 1001: going away
  CHECK(follower.read_until(close_frame).ends_with(close_frame));
  const std::string request = bench.request("GET", "/api/status");
  CHECK(bench.status(request) == 401);
  CHECK(bench.status(test::replaced(request, old, renewed)) == 200);
  kill(bench.daemon().id(), SIGTERM);
  bench.daemon().wait();
  const std::string third = printed(bench.command({"token", "--renew"}));  // without a daemon
  CHECK(third != renewed);
  bench.serve();
  CHECK(bench.token() == third);
  CHECK(bench.status(bench.request("GET", "/api/status")) == 200);
}

TEST_CASE("a name with a port is taken as it is, and one without also stands for a proxy's ports") {
  const std::vector<std::string> hosts =
      host::hosts_for("127.0.0.1", 8377, {"Printer.lan", "a.example:8443"});
  const auto allowed = [&](const std::string& name) {
    return std::find(hosts.begin(), hosts.end(), name) != hosts.end();
  };
  for (const char* name : {"printer.lan", "printer.lan:80", "printer.lan:443", "printer.lan:8377",
                           "a.example:8443", "127.0.0.1:8377", "localhost:8377", "[::1]:8377"}) {
    INFO(name);
    CHECK(allowed(name));
  }
  for (const char* name : {"a.example", "a.example:443", "a.example:8443:8377", "printer.lan:8443",
                           "localhost", "127.0.0.1", "localhost:80"}) {
    INFO(name);
    CHECK_FALSE(allowed(name));
  }
}
