// A print whose line is followed: a production and a session in this process, a simulated printer in another
// that writes down every bead, and one clock: virtual time.
#pragma once

#include <poll.h>

#include <asio/co_spawn.hpp>
#include <asio/io_context.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/numeric/vec2.hpp"
#include "host/dry_run/lockstep_clock.hpp"
#include "host/engine/planned_production.hpp"
#include "host/engine/produce.hpp"
#include "host/engine/session.hpp"
#include "host/job/load_job.hpp"
#include "host/live/live_line.hpp"
#include "tests/host/support/child_process.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal::test {

/// A bead as the simulator has laid it. mm, mm³, printer seconds.
struct SimBead {
  double start = 0, end = 0;
  core::Vec2 from{0, 0}, to{0, 0};
  double z = 0, volume = 0;
  std::vector<double> shares;
};

class LineBench {
  TempFolder folder_;  ///< goes away last

 public:
  using Script =
      std::function<void(LineBench& bench, host::Session& session, const host::SessionEvent& event)>;

  /// `simulator`: more options of the simulator. `files`: beside the job and its profile.
  explicit LineBench(const std::string& job = sample_job, const std::vector<std::string>& simulator = {},
                     const std::string& profile = sample_profile,
                     const std::vector<std::pair<std::string, std::string>>& files = {
                         {"plate.svg", sample_drawing}}) {
    folder_.write("bench.toml", profile);
    for (const auto& [name, text] : files) folder_.write(name, text);
    production = host::produce(host::load_job(folder_.write("job.toml", job), {}), {});
    start_printer(simulator);
  }

  std::unique_ptr<host::Production> production;
  std::unique_ptr<host::LiveLine> live;
  std::shared_ptr<host::LockstepClock> clock;
  std::unique_ptr<host::Spool> spool;

  /// What a daemon would follow.
  host::LiveSubject subject() const {
    host::LiveSubject subject;
    subject.printer = production->job().profile.printer;
    subject.filaments = production->job().profile.filaments;
    subject.asked = production->asked();
    subject.layers = production->layers();
    subject.folder = folder_.path();
    return subject;
  }

  /// Prints; `script` is called at every event, when all lines so far are read. Ends the simulator.
  host::StreamResult print(const Script& script) {
    host::StreamSettings settings;
    settings.clock = clock;
    host::PrintOrder order;
    order.job_name = "job";
    order.layer_count = production->layers();
    spool = std::make_unique<host::Spool>(host::Spool::create(folder_ / "spool", production->job(), order));
    settings.spool = &*spool;
    live = std::make_unique<host::LiveLine>(subject());
    settings.follower = &*live;
    if (auto* planned = dynamic_cast<host::PlannedProduction*>(&*production)) {
      host::LookaheadOptions options = host::lookahead_options(planned->prepared());
      options.plan.quality = 0.1;  // nobody looks at the curves
      planned->plan(options);
    } else {
      production->begin(clock, {});
    }
    std::optional<host::StreamResult> result;
    {
      asio::io_context loop{1};
      host::Session session(loop.get_executor(), host::open_port(port_, 115200), production->open({}),
                            settings);
      session.on_event([&](const host::SessionEvent& event) {
        live->wait();
        script(*this, session, event);
      });
      asio::co_spawn(loop, session.run(), [&](const std::exception_ptr& error, host::StreamResult ended) {
        result = error ? session.failed(error) : std::move(ended);
        loop.stop();
      });
      clock->run(loop);
    }
    live->wait();
    settings.clock.reset();
    clock.reset();  // hangs up, which the simulator waits for
    if (printer_->wait().code != 0) throw std::runtime_error("no sound simulator: " + printer_->err());
    return *result;
  }

  /// After print().
  std::vector<SimBead> laid() const {
    std::vector<SimBead> beads;
    std::istringstream text(read_text(folder_ / "beads"));
    for (std::string line; std::getline(text, line);) {
      std::istringstream words(line);
      SimBead bead;
      double z = 0;
      words >> bead.start >> bead.end >> bead.from.x() >> bead.from.y() >> z >> bead.to.x() >> bead.to.y() >>
          bead.z >> bead.volume;
      for (double share = 0; words >> share;) bead.shares.push_back(share);
      beads.push_back(std::move(bead));
    }
    return beads;
  }

  std::optional<host::LiveNozzle> nozzle(host::Session& session) const {
    return live->nozzle(session.line_place(), clock->now(), session.status().speed_percent);
  }

 private:
  void start_printer(const std::vector<std::string>& more) {
    std::vector<std::string> all{"simulate",  "--once",
                                 "--profile", (folder_ / "bench.toml").string(),
                                 "--control", (folder_ / "clock").string(),
                                 "--beads",   (folder_ / "beads").string()};
    all.insert(all.end(), more.begin(), more.end());
    printer_ = std::make_unique<Child>(all);
    while (port_.find('\n') == std::string::npos) {
      if (!printer_->running()) throw std::runtime_error("no simulator: " + printer_->err());
      poll(nullptr, 0, 5);
      port_ = printer_->out();
    }
    port_.resize(port_.find('\n'));
    clock = std::make_shared<host::LockstepClock>(folder_ / "clock");
  }

  std::unique_ptr<Child> printer_;
  std::string port_;
};

}  // namespace unicursal::test
