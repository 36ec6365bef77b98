// `unicursal serve` as a real process, with a folder of jobs and perhaps a simulated printer.
#pragma once

#include <poll.h>

#include <chrono>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/host/support/child_process.hpp"
#include "tests/host/support/raw_http.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal::test {

/// Looks again and again until it is so; a process that has ended, or two minutes, end the wait.
inline void await(const std::function<bool()>& so, const Child& process) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
  while (!so()) {
    if (!process.running()) throw std::runtime_error("it has ended: " + process.err());
    if (std::chrono::steady_clock::now() > end) throw std::runtime_error("waited in vain");
    poll(nullptr, 0, 5);
  }
}

class DaemonBench {
 public:
  DaemonBench() {
    std::filesystem::create_directory(path("jobs"));
    folder_.write("jobs/bench.toml.profile", tall_profile());
    folder_.write("jobs/plate.svg", sample_drawing);
    folder_.write("jobs/plate.toml", replaced(tall_job(), "bench.toml", "bench.toml.profile"));
    folder_.write("secret.toml", sample_job);
  }

  std::string path(const std::string& name) const { return folder_ / name; }
  const TempFolder& folder() const { return folder_; }

  /// `speed`: printer seconds per second; 0: as fast as lines come.
  void start_printer(const std::string& speed, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"simulate", "--profile",    path("jobs/bench.toml.profile"),
                                       "--link",   path("port"),   "--speed",
                                       speed,      "--transcript", path("lines.txt")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    printer_ = std::make_unique<Child>(arguments);
    await([this] { return std::filesystem::exists(path("port")); }, *printer_);
  }

  void serve(const std::vector<std::string>& more = {}) { serve_at(path("port"), more); }
  /// Another's printer.
  void serve_at(const std::string& device, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"serve",       "--listen", "127.0.0.1:0", "--state",
                                       path("state"), "--spool",  path("spool"), "--port",
                                       device,        "--jobs",   path("jobs")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    daemon_ = std::make_unique<Child>(arguments);
    await([this] { return daemon_->out().find('\n') != std::string::npos; }, *daemon_);
    const std::string said = daemon_->out();
    port_ = std::stoi(said.substr(said.find("127.0.0.1:") + 10));
    if (std::filesystem::exists(path("state/token"))) token_ = read_text(path("state/token")).substr(0, 64);
  }

  Child& daemon() { return *daemon_; }
  /// What the printer has run; it is switched off for that.
  std::string transcript() {
    kill(printer_->id(), SIGTERM);
    printer_->wait();
    return read_text(path("lines.txt"));
  }
  int port() const { return port_; }
  const std::string& token() const { return token_; }
  std::string host() const { return "127.0.0.1:" + std::to_string(port_); }

  /// A request that is sound but for what is asked; `more`: further headers, each with its line end.
  std::string request(const std::string& method, const std::string& target, const std::string& body = {},
                      const std::string& more = {}) const {
    return method + " " + target + " HTTP/1.1\r\nHost: " + host() + "\r\nConnection: close\r\n" +
           "Content-Type: application/json\r\nAuthorization: Bearer " + token_ + "\r\n" + more +
           "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
  }
  std::string send(const std::string& bytes) const {
    RawConnection connection(port_);
    connection.send(bytes);
    return connection.read_all();
  }
  int status(const std::string& bytes) const { return status_of(send(bytes)); }
  nlohmann::json ask(const std::string& method, const std::string& target,
                     const std::string& body = {}) const {
    const std::string answer = send(request(method, target, body));
    return nlohmann::json::parse(answer.substr(answer.find("\r\n\r\n") + 4));
  }
  /// A command of the program's, with the state folder of this daemon.
  Outcome command(std::vector<std::string> words) const {
    words.insert(words.end(), {"--state", path("state")});
    return run(words);
  }
  /// Of the session; empty when there is none.
  std::string print_state() const {
    return ask("GET", "/api/status").value("print", nlohmann::json::object()).value("state", "");
  }
  /// Until the daemon's print is in this state.
  void await_print(const std::string& state) {
    await([&] { return print_state() == state; }, *daemon_);
  }
  /// Until something is extruded: being hot is not enough.
  void await_laying() {
    await([this] { return read_text(path("lines.txt")).find("G1 ") != std::string::npos; }, *daemon_);
  }
  void await_job(int id, const std::string& state) {
    await([&] { return ask("GET", "/api/jobs/" + std::to_string(id)).value("state", "") == state; },
          *daemon_);
  }

 private:
  TempFolder folder_;
  std::unique_ptr<Child> printer_, daemon_;
  int port_ = 0;
  std::string token_;
};

}  // namespace unicursal::test
