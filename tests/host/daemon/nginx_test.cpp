// The daemon behind a real nginx, configured by the lines that API.md recommends; and hostile requests, each
// sent to the daemon directly and through nginx. Without nginx the tests of the proxy pass with a warning.
#include <catch2/catch.hpp>

#include <regex>

#include "tests/host/support/daemon_process.hpp"
#include "tests/host/support/hostile_requests.hpp"
#include "tests/paths.hpp"

using namespace unicursal;
using test::DaemonBench;
using test::RawConnection;
using test::status_of;

namespace {

constexpr const char* program = "/usr/sbin/nginx";
const auto api = test::source_folder() / "host/daemon/API.md";

int free_port() {
  const int fd = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  REQUIRE(bind(fd, reinterpret_cast<const sockaddr*>(&address), size) == 0);
  REQUIRE(getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size) == 0);
  close(fd);
  return ntohs(address.sin_port);
}

bool listens(int port) {
  try {
    RawConnection connection(port);
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

/// An nginx of this user's in front of a daemon; ends with this object.
class Proxy {
 public:
  explicit Proxy(int daemon) : port_(free_port()) {
    const std::string text = test::read_text(api);
    std::smatch lines;
    REQUIRE(std::regex_search(text, lines, std::regex("location / \\{[^}]*\\}")));
    const std::string location =
        test::replaced(lines.str(), "127.0.0.1:8377", "127.0.0.1:" + std::to_string(daemon));
    std::string conf =
        "daemon off;\nmaster_process off;\nerror_log stderr;\nevents {}\nhttp {\n  access_log off;\n";
    for (const char* which : {"client_body", "proxy", "fastcgi", "uwsgi", "scgi"})
      conf += "  " + std::string(which) + "_temp_path " + (folder_ / which).string() + ";\n";
    conf += "  server {\n    listen 127.0.0.1:" + std::to_string(port_) + ";\n" + location + "\n  }\n}\n";
    folder_.write("nginx.conf", "pid " + (folder_ / "pid").string() + ";\n" + conf);
    id_ = fork();
    if (id_ == 0) {
      dup2(open((folder_ / "log").c_str(), O_CREAT | O_WRONLY, 0600), STDERR_FILENO);
      execl(program, program, "-p", folder_.path().c_str(), "-c", (folder_ / "nginx.conf").c_str(), nullptr);
      _exit(127);
    }
    for (int i = 0; i < 1000 && !listens(port_); ++i) poll(nullptr, 0, 10);
    INFO(test::read_text(folder_ / "log"));
    REQUIRE(listens(port_));
  }
  ~Proxy() {
    kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
  }
  Proxy(const Proxy&) = delete;
  Proxy& operator=(const Proxy&) = delete;

  int port() const { return port_; }
  std::string ask(const std::string& bytes) const {
    RawConnection connection(port_);
    connection.send(bytes);
    return connection.read_all();
  }

 private:
  test::TempFolder folder_;
  int port_;
  pid_t id_ = -1;
};

bool has_nginx() {
  if (std::filesystem::exists(program)) return true;
  WARN("nginx is not installed (host/install-packages --with-tests)");
  return false;
}

std::string upgrade(const std::string& host, const std::string& token) {
  return "GET /api/events HTTP/1.1\r\nHost: " + host + "\r\nAuthorization: Bearer " + token +
         "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
         "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
}

std::string close_frame(int code) {
  return std::string("\x88\x02", 2) + static_cast<char>(code >> 8) + static_cast<char>(code & 0xff);
}

void check_frames(int port, const std::string& host, const std::string& token) {
  for (const test::BadFrame& bad : test::bad_frames()) {
    INFO(bad.what);
    RawConnection connection(port);
    connection.send(upgrade(host, token));
    CHECK(connection.read_until("\"hello\"").find(" 101 ") != std::string::npos);
    connection.send(bad.bytes);
    const std::string end = close_frame(bad.code);
    CHECK(connection.read_until(end).ends_with(end));
    connection.finish_sending();
    connection.read_all();
  }
}

std::string in_words(int status) {
  return std::to_string(status);
}

}  // namespace

TEST_CASE("hostile requests and frames get the answers that the protocols ask for") {
  DaemonBench bench;
  bench.serve();
  for (const test::HostileRequest& request : test::hostile_requests(bench.host(), bench.token())) {
    const std::string answer = bench.send(request.bytes);
    INFO(request.what << ": " << in_words(status_of(answer)));
    CHECK(request.direct.contains(status_of(answer)));
    CHECK(answer.find("\nHTTP/1.1 ") == std::string::npos);  // one answer only
  }
  check_frames(bench.port(), bench.host(), bench.token());
  CHECK(bench.status(bench.request("GET", "/api/status")) == 200);
}

TEST_CASE("behind nginx a browser gets in, and hostile requests do not") {
  if (!has_nginx()) return;
  DaemonBench bench;
  bench.serve({"--name", "printer.example"});
  const Proxy proxy(bench.port());
  const std::string name = "printer.example";
  const std::string head = " HTTP/1.1\r\nHost: " + name + "\r\nConnection: close\r\nAuthorization: Bearer " +
                           bench.token() + "\r\n";
  for (const char* origin : {"", "Origin: https://printer.example\r\n", "Origin: http://printer.example\r\n"})
    CHECK(status_of(proxy.ask("GET /api/status" + head + origin + "\r\n")) == 200);
  const std::string large(20'000'000, ' ');
  CHECK(status_of(proxy.ask("PUT /api/files/a/b.svg" + head +
                            "Content-Length: " + std::to_string(large.size()) + "\r\n\r\n" + large)) == 201);
  RawConnection follower(proxy.port());
  follower.send(test::replaced(upgrade(name, bench.token()),
                               "\r\nUpgrade:", "\r\nOrigin: https://printer.example\r\nUpgrade:"));
  CHECK(follower.read_until("\"hello\"").find(" 101 ") != std::string::npos);
  for (const test::HostileRequest& request : test::hostile_requests(name, bench.token())) {
    const std::string answer = proxy.ask(request.bytes);
    INFO(request.what << ": " << in_words(status_of(answer)));
    CHECK(request.proxied.contains(status_of(answer)));
  }
  check_frames(proxy.port(), name, bench.token());
  CHECK(bench.daemon().err().find("/api/printer") == std::string::npos);
  CHECK(status_of(proxy.ask("GET /api/status" + head + "\r\n")) == 200);
}
