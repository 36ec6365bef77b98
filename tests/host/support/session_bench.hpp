// A session in this process, a simulated printer in another, and one clock: virtual time.
#pragma once

#include <poll.h>

#include <asio/co_spawn.hpp>
#include <asio/io_context.hpp>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "host/dry_run/lockstep_clock.hpp"
#include "host/engine/session.hpp"
#include "host/job/job.hpp"
#include "host/job/load_job.hpp"
#include "tests/host/support/child_process.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal::test {

struct SampleFiles {
  std::string job = sample_job, profile = sample_profile;
  std::string part_name = "plate.svg", part = sample_drawing;
};

class SessionBench {
 public:
  using Script = std::function<void(host::Session&, const host::SessionEvent&)>;

  /// `simulator`: more options of the simulator. `profile_more`: lines for the end of the profile.
  explicit SessionBench(const std::vector<std::string>& simulator = {}, const std::string& profile_more = {},
                        const SampleFiles& sample = {})
      : job_(write_job(profile_more, sample)),
        prepared_(host::prepare(host::load_job(job_, {}))),
        printer_(simulate(simulator)),
        maker_(prepared_),
        clock_(connect()) {}

  host::StreamSettings settings;
  /// Printer seconds that a second of planning takes, on one thread; absent: planning takes no time.
  std::optional<double> charge;

  /// Prints; `script` is called at every event. Ends the simulator, which writes its report.
  host::StreamResult print(const Script& script = {}) {
    settings.clock = clock_;
    host::LookaheadOptions planning = host::lookahead_options(prepared_);
    planning.plan.quality = 0.1;  // nobody looks at the curves
    if (charge) {
      planning.pace = host::PlanningClock{{}, *charge};
      planning.threads = 1;
    }
    host::Lookahead lookahead(*prepared_.part, planning);
    std::optional<host::StreamResult> result;
    {
      asio::io_context loop{1};
      host::PlannedSource source(lookahead, maker_);
      host::Session session(loop.get_executor(), host::open_port(port_, 115200), source, settings);
      session.on_event([&](const host::SessionEvent& event) {
        if (script) script(session, event);
      });
      asio::co_spawn(loop, session.run(), [&](const std::exception_ptr& error, host::StreamResult ended) {
        result = error ? session.failed(error) : std::move(ended);
        last_ = session.status();
        loop.stop();
      });
      try {
        clock_->run(loop);
      } catch (...) {
        if (!result) result = session.failed(std::current_exception());
      }
    }
    clock_.reset();
    settings.clock.reset();  // hangs up, which the simulator waits for
    const Outcome printer = printer_.wait();
    if (printer.code != 0) {
      throw std::runtime_error("the simulator ended with " + std::to_string(printer.code) + ": " +
                               printer.err);
    }
    return *result;
  }

  nlohmann::json seen() const { return nlohmann::json::parse(read_text(folder_ / "seen.json")); }
  const host::SessionStatus& last() const { return last_; }
  bool cold() const {
    const nlohmann::json heat = seen()["temperatures"];
    return heat["nozzle"]["target"] == 0 && heat["bed"]["target"] == 0;
  }
  std::vector<std::string> executed() const {
    std::istringstream stream(read_text(folder_ / "executed"));
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
  }

 private:
  std::string write_job(const std::string& profile_more, const SampleFiles& sample) {
    folder_.write("bench.toml", sample.profile + profile_more);
    folder_.write(sample.part_name, sample.part);
    return folder_.write("job.toml", sample.job).string();
  }

  std::vector<std::string> simulate(const std::vector<std::string>& more) const {
    std::vector<std::string> all{"simulate",     "--once",
                                 "--profile",    (folder_ / "bench.toml").string(),
                                 "--control",    (folder_ / "clock").string(),
                                 "--report",     (folder_ / "seen.json").string(),
                                 "--transcript", (folder_ / "executed").string()};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  std::shared_ptr<host::LockstepClock> connect() {
    while (port_.find('\n') == std::string::npos) {
      if (!printer_.running()) throw std::runtime_error("no simulator: " + printer_.err());
      poll(nullptr, 0, 5);
      port_ = printer_.out();
    }
    port_.resize(port_.find('\n'));
    return std::make_shared<host::LockstepClock>(folder_ / "clock");
  }

  TempFolder folder_;
  std::string job_;
  host::PreparedJob prepared_;
  Child printer_;
  std::string port_;
  host::ChunkMaker maker_;
  std::shared_ptr<host::LockstepClock> clock_;
  host::SessionStatus last_;
};

}  // namespace unicursal::test
