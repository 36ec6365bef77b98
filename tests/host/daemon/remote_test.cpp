// Commands that steer a daemon on another computer, and a daemon that lets a network in.
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <cstdlib>

#include "host/daemon/access.hpp"
#include "host/daemon/own_addresses.hpp"
#include "tests/host/support/daemon_process.hpp"

using namespace unicursal;
using Catch::Matchers::Contains;
using test::Child;
using test::DaemonBench;
using test::Outcome;
using test::run;

namespace {

/// A variable of the environment for as long as this object lives.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) { setenv(name, value.c_str(), 1); }
  ~Variable() { unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
};

std::vector<std::string> with(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

int status_for(int port, const std::string& token, const std::string& headers) {
  test::RawConnection connection(port);
  connection.send("GET /api/status HTTP/1.1\r\n" + headers +
                  "\r\nConnection: close\r\nAuthorization: Bearer " + token + "\r\n\r\n");
  return test::status_of(connection.read_all());
}

}  // namespace

TEST_CASE("the commands steer a daemon by its address and token") {
  DaemonBench bench;
  bench.start_printer("100");
  bench.serve();
  const std::vector<std::string> there{"--daemon", "http://" + bench.host(), "--token", bench.token()};
  CHECK_THAT(run(with({"queue"}, there)).out, Contains("the queue is empty"));
  CHECK_THAT(run(with({"queue", "--jobs"}, there)).out, Contains("plate.toml") && !Contains("bench.toml"));
  CHECK_THAT(run(with({"queue", "--add", "plate.toml"}, there)).out, Contains("plate.toml"));
  const Outcome uploaded = run(with({"queue", "--upload", bench.path("jobs/plate.toml")}, there));
  INFO(uploaded.err);
  CHECK(uploaded.code == 0);
  CHECK(run(with({"start"}, there)).code == 0);
  bench.await_laying();
  CHECK(run(with({"pause"}, there)).code == 0);
  bench.await_print("paused");
  CHECK_THAT(run(with({"set", "--flow", "95"}, there)).out, Contains("flow 95 %"));
  CHECK_THAT(run(with({"answer", "0"}, there)).err, Contains("does not ask anything"));
  CHECK(run(with({"resume"}, there)).code == 0);
  bench.await_print("printing");
  {
    const Variable daemon("UNICURSAL_DAEMON", bench.host());
    const Variable token("UNICURSAL_TOKEN", bench.token());
    CHECK_THAT(run({"status"}).out, Contains("printing"));
    CHECK_THAT(run({"status", "--state", bench.path("none")}).err,
               Contains("no daemon runs with this state"));
    CHECK(run({"cancel"}).code == 0);
  }
  bench.await_job(1, "stopped");
}

TEST_CASE("a daemon that cannot be reached, or does not know the token, is reported with a remedy") {
  DaemonBench bench;
  bench.start_printer("100");
  bench.serve();
  const std::string wrong(64, '0');
  CHECK_THAT(run({"status", "--daemon", bench.host()}).err,
             Contains("does not know this token") && Contains("--token"));
  CHECK(run({"status", "--daemon", bench.host(), "--token", wrong}).code == 2);
  CHECK_THAT(run({"status", "--daemon", "127.0.0.1:1", "--token", wrong}).err,
             Contains("127.0.0.1:1") && Contains("does not answer"));
  for (const char* address :
       {"https://127.0.0.1:8377", "http://", "a b", "http://[::1", "h:99999", "h:0", "h/path"}) {
    INFO(address);
    const Outcome outcome = run({"status", "--daemon", address});
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Contains("--daemon") && Contains("; "));
  }
  CHECK(run({"status", "--daemon", bench.host(), "--token", "a\r\nX: y"}).code == 2);
  CHECK_THAT(bench.command({"status", "--token", wrong}).err, Contains("name that with --daemon"));
}

TEST_CASE("serve --lan obeys requests for this computer's addresses and its name, and for no other") {
  const DaemonBench bench;
  Child daemon({"serve", "--lan", "--listen", "0.0.0.0:0", "--state", bench.path("state"), "--port",
                bench.path("port"), "--jobs", bench.path("jobs")});
  test::await([&] { return daemon.out().find("on another computer") != std::string::npos; }, daemon);
  const std::string said = daemon.out();
  CHECK_THAT(said, !Contains("0.0.0.0") && !Contains("█"));  // not in a file
  const std::string token = test::read_text(bench.path("state/token")).substr(0, 64);
  const std::size_t begin = said.find("http://") + 7;
  const std::string address = said.substr(begin, said.find_first_of(";\n", begin) - begin);
  const std::string port = address.substr(address.rfind(':') + 1);
  const auto asked = [&](const std::string& headers) { return status_for(std::stoi(port), token, headers); };
  CHECK(asked("Host: " + address) == 200);
  CHECK(asked("Host: 127.0.0.1:" + port) == 200);
  for (const std::string& host : host::own_hosts(static_cast<unsigned>(std::stoi(port))))
    CHECK(asked("Host: " + host) == 200);
  for (const std::string& name : host::own_names()) CHECK(asked("Host: " + name + ":" + port) == 200);
  CHECK(asked("Host: " + address + "\r\nOrigin: http://" + address) == 200);
  CHECK(asked("Host: evil.example:" + port) == 421);  // a name that was made to mean this computer
  CHECK(asked("Host: 203.0.113.9:" + port) == 421);   // an address of another computer
  CHECK(asked("Host: evil.local:" + port) == 421);
  CHECK(asked("Host: " + address + "\r\nOrigin: http://evil.example") == 403);
  CHECK(asked("Host: " + address + "\r\nSec-Fetch-Site: cross-site") == 403);
  CHECK(status_for(std::stoi(port), std::string(64, '0'), "Host: " + address) == 401);
}

TEST_CASE("a daemon for the network keeps its token and does not listen on the loopback only") {
  const DaemonBench bench;
  const auto serve = [&](const std::vector<std::string>& more) {
    return run(with({"serve", "--lan", "--state", bench.path("state"), "--port", bench.path("port")}, more));
  };
  CHECK_THAT(serve({"--no-token"}).err, Contains("--no-token") && Contains("leave out"));
  CHECK_THAT(serve({"--listen", "127.0.0.1:0"}).err, Contains("--lan") && Contains("0.0.0.0"));
}
