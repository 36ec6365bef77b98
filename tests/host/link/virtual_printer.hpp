// A simulated printer in a process of its own, at the other end of a real pseudo-terminal, in virtual time.
#pragma once

#include <poll.h>

#include <asio/co_spawn.hpp>
#include <asio/io_context.hpp>
#include <exception>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "host/dry_run/lockstep_clock.hpp"
#include "host/link/link.hpp"
#include "tests/host/support/child_process.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal::test {

/// The result of a conversation.
struct Talk {
  std::string error;  ///< Message of a LinkError; empty after success.
  host::LinkStatistics statistics;
  gcode::Identity identity;
  gcode::Temperatures temperatures;
  std::optional<host::PrinterQueues> queues;
  std::vector<std::string> messages;
  double seconds = 0;  ///< Printer time from connection to end.
};

class VirtualPrinter {
 public:
  /// `options` are those of `unicursal simulate`.
  explicit VirtualPrinter(const std::vector<std::string>& options = {}) : child_(arguments(options)) {
    while (child_.out().find('\n') == std::string::npos) {
      if (!child_.running()) throw std::runtime_error("no simulator: " + child_.err());
      poll(nullptr, 0, 5);
    }
  }

  /// Connects and runs `say`. To be called once.
  Talk talk(const std::function<asio::awaitable<void>(host::Link&, host::Clock&)>& say,
            host::LinkOptions options = {},
            const std::function<void(host::Link&, const std::string&)>& on_message = {}) {
    Talk talk;
    options.clock = std::make_shared<host::LockstepClock>(folder_ / "clock");
    asio::io_context loop{1};
    host::Link link(loop.get_executor(), host::open_port((folder_ / "port").string(), 250000), options);
    link.on_message([&](const std::string& message) {
      talk.messages.push_back(message);
      if (on_message) on_message(link, message);
    });
    const auto conversation = [&]() -> asio::awaitable<void> {
      try {
        co_await link.connect();
        const auto begun = options.clock->now();
        co_await say(link, *options.clock);
        talk.seconds = std::chrono::duration<double>(options.clock->now() - begun).count();
      } catch (const host::LinkError& error) {
        talk.error = error.what();
      }
    };
    std::exception_ptr other;
    asio::co_spawn(loop, conversation, [&](std::exception_ptr thrown) {
      other = thrown;
      loop.stop();
    });
    options.clock->run(loop);
    if (other) std::rethrow_exception(other);
    talk.statistics = link.statistics();
    talk.identity = link.identity();
    talk.temperatures = link.temperatures();
    talk.queues = link.queues();
    return talk;
  }

  Talk print(std::vector<std::string> lines, host::LinkOptions options = {},
             const std::function<void(host::Link&, const std::string&)>& on_message = {}) {
    const auto say = [&lines](host::Link& link, host::Clock&) -> asio::awaitable<void> {
      co_await link.send(lines);
      co_await link.drain();
    };
    return talk(say, options, on_message);
  }

  /// Waits for the end of the process, which follows the end of the conversation.
  const nlohmann::json& report() {
    if (report_.is_null()) {
      child_.wait();
      report_ = nlohmann::json::parse(read_text(folder_ / "report"));
    }
    return report_;
  }

  /// To be called after report(): the executed commands, without the link's own questions.
  std::vector<std::string> executed() const {
    std::vector<std::string> lines;
    std::istringstream text(read_text(folder_ / "transcript"));
    for (std::string line; std::getline(text, line);) {
      if (line != "M105" && line != "M115" && !line.starts_with("M110") && !line.starts_with("M155"))
        lines.push_back(line);
    }
    return lines;
  }

 private:
  std::vector<std::string> arguments(const std::vector<std::string>& options) const {
    std::vector<std::string> all = {"simulate",     "--once",
                                    "--link",       (folder_ / "port").string(),
                                    "--control",    (folder_ / "clock").string(),
                                    "--report",     (folder_ / "report").string(),
                                    "--transcript", (folder_ / "transcript").string()};
    all.insert(all.end(), options.begin(), options.end());
    return all;
  }

  TempFolder folder_;
  Child child_;
  nlohmann::json report_;
};

}  // namespace unicursal::test
