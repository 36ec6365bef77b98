// How an idle printer's connection is opened, held, lost, and found again.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <asio/co_spawn.hpp>
#include <asio/detached.hpp>
#include <asio/use_awaitable.hpp>
#include <exception>
#include <utility>

#include "core/error.hpp"
#include "core/text/printable.hpp"
#include "firmware_gcode/dialect/common_lines.hpp"
#include "host/engine/printer_check.hpp"
#include "host/engine/reconnecting.hpp"
#include "host/idle/idle_state.hpp"
#include "host/link/find_port.hpp"
#include "host/loop/sentence.hpp"

namespace unicursal::host {
namespace {

using namespace std::chrono_literals;

constexpr auto look_for_cable = 300ms;
constexpr auto doubtful_silence = 6s;  ///< without temperatures, which come every second; then it is asked
// How long a hot printer is looked for; then its firmware has cooled it.
constexpr auto hot_patience = 30min;
constexpr const char* soon_cold = "its heaters were on, and are switched off as soon as it is back";
constexpr const char* perhaps_hot =
    "the printer's heaters may still be on: switch it off by its own switch, or connect it again so that "
    "they are switched off";

struct OpenedPort {
  int descriptor = -1;
  bool boots = true;
  std::string stable_name;
};

asio::awaitable<OpenedPort> open_in_thread(std::string port, Profile profile) {
  LinkOptions options = link_options(profile, std::nullopt);
  OpenedPort opened;
  opened.descriptor = open_port(port, profile.baud, options);
  opened.boots = options.boot.count() > 0;
  const std::string device = device_of(opened.descriptor);
  opened.stable_name = stable_name_of(device);
  // "auto" may mean another printer when this one is unplugged.
  if (opened.stable_name.empty() && !port.starts_with('/')) opened.stable_name = device;
  co_return opened;
}

}  // namespace

IdlePrinter::State::~State() {
  if (descriptor >= 0) ::close(descriptor);
  if (handed_over >= 0) ::close(handed_over);
}

asio::awaitable<void> IdlePrinter::State::run([[maybe_unused]] std::shared_ptr<State> self) {
  std::exception_ptr error;
  try {
    co_await hold();
  } catch (...) {
    error = std::current_exception();
  }
  if (error && leave == Leave::no) problem = sentence(error);
  end();
}

asio::awaitable<void> IdlePrinter::State::hold() {
  if (descriptor < 0 && returning && !co_await come_back()) co_return;
  if (descriptor < 0) co_await open();
  for (;;) {
    std::exception_ptr lost;
    try {
      while (leave == Leave::no || (leaves_hot() && descriptor >= 0)) co_await converse();
    } catch (const LinkError&) {
      lost = std::current_exception();
    }
    const bool may_come_back = lost && note_failure(sentence(lost));
    ++turn;
    link.reset();
    if (!may_come_back || !co_await come_back()) co_return;
  }
}

/// Returns whether the printer is worth waiting for.
bool IdlePrinter::State::note_failure(const std::string& sentence) {
  const bool open = connection == IdleStatus::Connection::open;
  const bool cut = link ? link->statistics().cut : open && !stopped;
  if (restarted || (stopped && !cut))  // a stop whose cable was out has not reached the printer
    may_be_hot = cools_first = false;
  else if (may_be_hot || (open && hot()))
    may_be_hot = cools_first = true;
  if (leave != Leave::no) return false;
  if (problem.empty() || !stopped)
    problem = restarted ? "the printer has restarted, and is cold now" : sentence;
  clear_steps(Ending::failed);
  current.reset();
  known_axes = {};
  place.reset();
  nozzle = bed = 0;
  view = {};
  connection = IdleStatus::Connection::closed;
  if (!stopped && (open || cools_first) && (cut || restarted)) look_for_it();
  if (returning && cools_first) problem += std::string("; ") + soon_cold;
  changed();
  return returning && !stopped;
}

void IdlePrinter::State::look_for_it() {
  returning = true;
  wait_until = clock->now() + (cools_first ? Duration(hot_patience) : Duration(reconnecting_patience));
}

asio::awaitable<void> IdlePrinter::State::open() {
  const Clock::Hold hold(*clock);
  const std::string named = returning && !same_port.empty() ? same_port : port;
  OpenedPort opened = co_await asio::co_spawn(opener, open_in_thread(named, profile), asio::use_awaitable);
  descriptor = opened.descriptor;
  boots = opened.boots;
  same_port = std::move(opened.stable_name);
}

/// The port is looked for until the patience is over. A hot printer that is to be left is looked for once
/// more.
asio::awaitable<bool> IdlePrinter::State::come_back() {
  const std::function<bool()> wanted_away = [this] { return leave != Leave::no; };
  bool back = false;
  while (!back && clock->now() < wait_until) {
    const bool once = co_await wake.wait(clock->now() + look_for_cable, wanted_away);
    if (once && !leaves_hot()) break;
    try {
      co_await open();
      back = true;
    } catch (const PortError&) {
      // It is not there yet.
    }
    if (once) break;
  }
  co_return back && (leave == Leave::no || leaves_hot());
}

/// Before the connection is given up.
void IdlePrinter::State::warn_of_heat() {
  if (!cools_first) return;
  problem = returning || problem.empty() ? perhaps_hot : problem + "; " + perhaps_hot;
}

void IdlePrinter::State::end() {
  warn_of_heat();
  running = returning = false;
  ++turn;
  link.reset();
  if (descriptor >= 0) ::close(descriptor);
  descriptor = -1;
  connection = IdleStatus::Connection::closed;
  leave = Leave::no;
  clear_steps(Ending::failed);
  current.reset();
  known_axes = {};
  place.reset();
  view = {};
  nozzle = bed = 0;
  wake.notify();
  changed();
}

/// One link, until filament is to be moved, the connection is to be left, or a LinkError ends it.
asio::awaitable<void> IdlePrinter::State::converse() {
  co_await greet();
  const std::function<bool()> due = [this] {
    return failure || leave != Leave::no || !steps.empty() || must_cool();
  };
  while (link) {
    co_await wake.wait(next_look(), due);
    if (failure) throw LinkError(*failure);
    if (leave != Leave::no) co_return co_await say_farewell();
    if (must_cool()) {
      last_command = clock->now();
      problem = "nobody has given a command for a quarter of an hour, so the heaters were switched off";
      Step cold{Step::Kind::cool, cold_lines(), {}, "the heaters are switched off", {}};
      cold.lines.emplace_back("M84");
      known_axes = {};
      place.reset();
      steps.push_front(std::move(cold));
    }
    if (!steps.empty()) {
      Step step = std::move(steps.front());
      steps.pop_front();
      co_await perform(std::move(step));
    } else if (clock->now() >= last_heard + doubtful_silence) {
      last_heard = clock->now();  // a printer that has no thermometer is asked again and again
      std::vector<std::string> question(1, "M105");
      co_await send(std::move(question));
    }
  }
}

TimePoint IdlePrinter::State::next_look() const {
  const TimePoint silent = last_heard + doubtful_silence;
  return hot() ? std::min(silent, last_command + patience) : silent;
}

asio::awaitable<void> IdlePrinter::State::greet() {
  LinkOptions options = link_options(profile, std::nullopt);
  options.clock = clock;
  if (!boots) options.boot = {};
  failure.reset();
  restarted = stopped = false;
  view = {};
  link.emplace(executor, std::exchange(descriptor, -1), options);
  boots = false;
  link->on_message([weak = weak_from_this(), of = ++turn](const std::string& line) {
    if (const auto self = weak.lock(); self && self->turn == of) self->hear(line);
  });
  co_await link->connect();
  if (!link || (leave != Leave::no && !leaves_hot())) throw LinkError("the connection was closed");
  asio::co_spawn(executor, watch(shared_from_this(), turn), asio::detached);
  restarted = false;  // until now it may have booted
  note_firmware();
  const bool was_lost = std::exchange(returning, false);
  if (was_lost) problem = "the connection was lost; the printer is back, and its heaters were switched off";
  if (cools_first || was_lost)
    steps.push_front({Step::Kind::cool, cold_lines(), {}, "the heaters are switched off", {}});
  else if (hot())
    steps.push_front({Step::Kind::lines, {gcode::stay_watchful()}, {}, "", {}});
  connection = IdleStatus::Connection::open;
  last_command = last_heard = clock->now();
  changed();
}

void IdlePrinter::State::note_firmware() {
  const gcode::Identity& identity = link->identity();
  firmware = identity.firmware.empty() ? link->firmware() : identity.firmware;
  if (const auto why = mismatch(identity, profile.printer.firmware))
    problem = fmt::format("{}; {}", *why, correction(identity, profile.file));
}

/// A link that fails while nothing is sent wakes nobody.
asio::awaitable<void> IdlePrinter::State::watch([[maybe_unused]] std::shared_ptr<State> self,
                                                std::uint64_t of_turn) {
  std::string why;
  try {
    co_await link->until_failure();
  } catch (const LinkError& error) {
    why = error.what();
  }
  if (turn != of_turn) co_return;
  failure = why;
  wake.notify();
}

asio::awaitable<void> IdlePrinter::State::say_farewell() {
  const bool closes = leave == Leave::close;
  if (closes || cools_first) {
    std::vector<std::string> lines = cold_lines();
    if (closes && link->identity().can("AUTOREPORT_TEMP")) lines.emplace_back("M155 S0");
    co_await send(std::move(lines));
    may_be_hot = cools_first = false;
  } else {
    co_await link->drain();
    may_be_hot = hot();
  }
  if (leave == Leave::hand_over) handed_over = link->take_port();
}

void IdlePrinter::State::hear(const std::string& line) {
  const gcode::Temperatures before = view.temperatures;
  const Remark remark = view.hear(line);
  if (remark.kind == Remark::Kind::temperatures) {
    last_heard = clock->now();
    may_be_hot = cools_first;  // from now on it is known
  } else {
    quote(line);
  }
  if (remark.kind == Remark::Kind::halted) stopped = true;
  const gcode::Reply reply = gcode::parse_reply(line);
  if (std::holds_alternative<gcode::reply::Start>(reply)) restarted = true;
  if (const auto* position = std::get_if<gcode::reply::Position>(&reply); position && position->mm) {
    heard_place = position->mm;
    wake.notify();
  }
  if (!(before == view.temperatures)) changed();
}

/// "echo:busy: processing" comes every two seconds while it homes.
void IdlePrinter::State::quote(const std::string& line) {
  if (listener && line != std::exchange(quoted, line)) listener(line);
}

void IdlePrinter::State::changed() {
  if (observer) observer();
}

}  // namespace unicursal::host
