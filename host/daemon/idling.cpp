// The part of the daemon that concerns its printer while nothing is printed: the connection, who may use it,
// and its handing over to a print and back.
#include <fmt/format.h>

#include <algorithm>
#include <asio/co_spawn.hpp>
#include <asio/detached.hpp>

#include "core/picture/hex_colour.hpp"
#include "core/stopping.hpp"
#include "core/text/printable.hpp"
#include "host/daemon/daemon.hpp"
#include "host/daemon/elsewhere.hpp"
#include "host/daemon/log.hpp"
#include "host/daemon/refused.hpp"
#include "host/engine/session.hpp"
#include "host/engine/session_json.hpp"
#include "host/files/descriptor.hpp"
#include "host/job/usual_profile.hpp"
#include "host/link/find_port.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;
using Connection = IdleStatus::Connection;

constexpr auto idle_event_interval = std::chrono::seconds(1);

json heater_json(const std::optional<double>& actual, const std::optional<double>& target) {
  json heater = json::object();
  if (actual) heater["actual_c"] = *actual;
  if (target) heater["target_c"] = *target;
  return heater;
}

void add_heat(json& to, const gcode::Temperatures& known) {
  to["nozzle"] = heater_json(known.nozzle, known.nozzle_target);
  to["bed"] = heater_json(known.bed, known.bed_target);
}

json filaments_json(const Profile& profile) {
  json all = json::array();
  for (const Filament& filament : profile.filaments.of_feeders)
    all.push_back({{"name", filament.name},
                   {"material", filament.material},
                   {"colour", picture::hex_of(filament.colour)}});
  return all;
}

bool is_listed(const std::string& port) {
  const std::vector<PortInfo> ports = list_ports();
  return std::any_of(ports.begin(), ports.end(), [&](const PortInfo& one) {
    return one.path == port || (!one.stable_path.empty() && one.stable_path == port);
  });
}

}  // namespace

// ---- who may use it

std::optional<std::filesystem::path> Daemon::profile_file() const {
  return options_.profile ? options_.profile : own_profile();
}

void Daemon::load_own_profile() {
  if (profile_) return;
  try {
    if (const auto file = own_profile()) own_profile_ = load_profile(*file);
  } catch (const core::DataError& error) {
    log_line(fmt::format("the profile is not used: {}", error.what()));
  }
}

const Profile* Daemon::own() const {
  return profile_ ? &*profile_ : own_profile_ ? &*own_profile_ : nullptr;
}

void Daemon::check_idle() const {
  if (when_idle_) throw Refused(Why::conflict, "ending", "the daemon is ending");
  if (current_) throw Refused(Why::printing, "a print is going on; the printer belongs to it until it ends");
  if (*examining_)
    throw Refused(Why::conflict, "examining", "the printer is being examined; try again when that is done");
}

/// Before a print.
void Daemon::check_not_at_work() const {
  if (idle_.feeding())
    throw Refused(Why::conflict, "feeding", "filament is being moved; wait until that is done, or cancel it");
  if (*examining_)
    throw Refused(Why::conflict, "examining", "the printer is being examined; try again when that is done");
}

/// Lines to an interrupted printer would make it forget where the print was.
void Daemon::check_nothing_interrupted() const {
  if (interrupted_ && !bed_clear_)
    throw Refused(Why::conflict, "interrupted",
                  "the print of job " + std::to_string(interrupted_->id) +
                      " was interrupted and may go on; continue it, or confirm that the bed "
                      "is clear");
}

IdlePrinter& Daemon::idle() {
  check_idle();
  return idle_;
}

/// The port that is meant by what a client names; empty: the daemon's.
std::string Daemon::checked_port(const std::string& named) const {
  const std::string usual = port().empty() && own() ? own()->port : port();
  const bool any = named.empty() || (named == "auto" && options_.port);
  if (any || named == usual) return usual.empty() ? "auto" : usual;
  if (options_.port)
    throw Refused(Why::conflict, "the daemon has one port; choose another with `unicursal serve --port`");
  if (named != "auto" && !is_listed(named))
    throw Refused(Why::not_found, "no_port", "no serial port has that name");
  return named;
}

void Daemon::connect_printer(const std::string& named) {
  check_idle();
  check_nothing_interrupted();
  const Profile* profile = own();
  if (!profile)
    throw Refused(Why::conflict, "no_profile",
                  "this daemon has no profile of its printer; make one, or start it with --profile");
  const std::string port = checked_port(named);
  if (idle_.wanted() && idle_.status().port != port)
    throw Refused(Why::conflict, "other_port", "another port is open; disconnect first");
  if (port.starts_with('/') && !std::filesystem::exists(port))
    throw Refused(Why::absent, "the port " + core::printable(port) +
                                   " is not there: plug the printer in and switch it on");
  if (!named.empty()) chosen_port_ = port;
  idle_note_.clear();
  if (!idle_.wanted()) idle_baud_ = profile->baud;
  idle_.connect(*profile, port);
}

void Daemon::disconnect_printer() {
  check_idle();
  idle_note_.clear();
  idle_.disconnect();
}

// ---- a print takes it over, and gives it back

/// Opens the print's port, which the idle connection may have open; without a reset of the board then.
asio::awaitable<void> Daemon::connect_print(Print& print, std::optional<Leg> leg) {
  const IdleStatus before = idle_.status();
  const Profile* profile = own();
  const unsigned baud = idle_baud_ != 0 ? idle_baud_ : profile ? profile->baud : 0;
  idle_returns_ = idle_returns_ || idle_.wanted();
  const int descriptor = co_await idle_.hand_over();
  current_->took_over = current_->took_over || descriptor >= 0;
  if (current_->cancelled) {
    if (descriptor >= 0 && profile)
      idle_.connect(*profile, before.port, descriptor);  // somebody must look after its heat
    else if (descriptor >= 0)
      ::close(descriptor);
    throw core::Stopped();
  }
  const auto connect = [&print, &leg, open = OpenPort{descriptor, before.port, baud},
                        stop = current_->preparing.get_token()] {
    const core::StopScope scope(stop);
    return print.connect(leg, open), true;
  };
  co_await elsewhere(preparing_, connect);
}

/// When a print has ended. A printer that was hot before, and that the print has not reached, is looked for.
void Daemon::take_printer_back() {
  const auto left_hot = std::exchange(left_hot_, std::nullopt);
  if (left_hot) idle_.expect_hot(left_hot->profile, left_hot->port);
  const bool returns = std::exchange(idle_returns_, false), hot = idle_.may_be_hot();
  if (when_idle_ || !(returns || hot)) return;
  try {
    if (left_hot)
      idle_.connect(left_hot->profile, left_hot->port);
    else if (hot && own())
      idle_.connect(*own(), idle_.status().port);
    else
      connect_printer({});
  } catch (const std::exception& refused) {
    idle_note_ = refused.what();
  }
}

/// When the daemon ends: what is hot is switched off. `again`: a second time, so that nothing is waited for.
void Daemon::let_printer_go(bool again) {
  if (again && idle_.wanted()) {
    try {
      return idle_.stop_at_once();
    } catch (const IdleRefused&) {
      // It is not open; the first call is closing it.
    }
  }
  if (again || !(idle_.wanted() || idle_.may_be_hot())) return when_idle_();
  asio::co_spawn(
      loop_,
      [this]() -> asio::awaitable<void> {
        co_await idle_.close();
        when_idle_();
      },
      asio::detached);
}

// ---- what it says

void Daemon::watch_idle_printer() {
  idle_.on_line([this](const std::string& line) { log_record_.note(LogRecord::From::printer, line); });
  idle_.on_change([this] {
    const IdleStatus now = idle_.status();
    if (now.connection == Connection::open) temperature_record_.note(now.temperatures);
    if (now.problem != idle_problem_) {
      idle_problem_ = now.problem;
      if (!now.problem.empty()) {
        log_line("printer: " + now.problem);
        announce("problem", {}, now.problem);
        log_record_.note(LogRecord::From::notice, now.problem);
      }
    }
    show_idle_soon();
  });
}

/// At most one event a second; the last one is never lost.
void Daemon::show_idle_soon() {
  if (idle_waits_ || followers_.empty()) return;
  idle_waits_ = true;
  idle_shown_.expires_at(std::max(asio::steady_timer::clock_type::now(), idle_next_));
  idle_shown_.async_wait([this](const asio::error_code& cut) {
    idle_waits_ = false;
    if (cut) return;
    idle_next_ = asio::steady_timer::clock_type::now() + idle_event_interval;
    broadcast({{"event", "idle"}, {"printer", printer()}});
  });
}

json Daemon::idle_heat(const gcode::Temperatures& known) {
  json heat = json::object();
  add_heat(heat, known);
  return heat;
}

void Daemon::add_idle(json& printer) const {
  const IdleStatus now = idle_.status();
  const Session* session = current_ && current_->print ? current_->print->session() : nullptr;
  printer["connection"] = session ? "printing" : name(now.connection);
  if (session) return add_heat(printer, session->status().temperatures);
  if (!now.problem.empty()) printer["problem"] = now.problem;
  if (now.problem.empty() && !idle_note_.empty()) printer["problem"] = idle_note_;
  if (!now.doing.empty()) printer["doing"] = now.doing;
  if (now.fed) printer["fed"] = name(*now.fed);
  if (!now.firmware.empty()) printer["firmware"] = core::printable(now.firmware);
  if (now.connection == Connection::closed) return;
  printer["port"] = now.port;
  add_heat(printer, now.temperatures);
  printer["homed"] = now.homed;
  if (now.at) printer["at"] = *now.at;
  if (now.action != IdleStatus::Action::none) printer["action"] = name(now.action);
  if (now.cools_in) printer["cools_in_seconds"] = *now.cools_in;
}

void Daemon::add_profile(json& printer, const Profile& profile) {
  printer["feeders"] = profile.printer.feeders;
  printer["filaments"] = filaments_json(profile);
  printer["limits"] = {{"nozzle_c", profile.hottest_nozzle}, {"bed_c", profile.hottest_bed}};
}

}  // namespace unicursal::host
