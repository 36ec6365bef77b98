// The link's protocol: greeting a firmware, answering its resend requests, resynchronising after silence. The
// facts behind it are in host/link/state.hpp.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "host/link/state.hpp"

namespace unicursal::host {
namespace {

using namespace std::chrono_literals;

constexpr auto answer_slack = 400ms;    ///< Beyond the estimated end of all moves; they brake at corners.
constexpr auto cooling_patience = 30s;  ///< Within which a wait must end that is to be ended.
constexpr auto boot_chatter = 500ms;    ///< Silence after which the firmware has finished booting.
constexpr int most_losses = 8;          ///< Within `losses_within` lines; more halve the window.
constexpr std::uint64_t losses_within = 200;
constexpr std::size_t least_window = 64;  ///< Bytes.
constexpr int longest_boot = 4;           ///< Multiple of LinkOptions::silence.
constexpr auto ask_again = 1000ms;        ///< Interval of questions to a firmware that may still boot.
constexpr auto longest_drain = 1000ms;    ///< Limit for printers that never fall silent.
constexpr int number_attempts = 5;        ///< Attempts to set the line number, on a noisy line.
constexpr int probe_attempts = 4;         ///< Each waits for LinkOptions::silence.
constexpr int longer_probe = 4;           ///< Multiple of that time, in later attempts during a slow command.
constexpr int find_attempts = 2;          ///< When rejoining; each waits for LinkOptions::silence.
constexpr int most_asks = 20;             ///< Repetitions of a question if refusals come in between.
constexpr int most_resends = 50;          ///< Resends in a row without progress.
constexpr auto finishes_nothing =
    "the printer is alive, but has not finished a command for a very long time; look at it, then start again";
constexpr std::uint32_t probe_distance = 1000;  ///< Distance of a probe's number from any possible number.

/// Writes ahead of all queues of this program, which send nothing any more. The first newline ends a half
/// written line; M108 ends a wait for heat. Returns the number of bytes written.
std::uint64_t switch_heaters_off(int descriptor) {
  constexpr std::string_view lines = "\nM108\nM104 S0\nM140 S0\n";
  const auto written = ::write(descriptor, lines.data(), lines.size());
  return static_cast<std::uint64_t>(std::max<ssize_t>(written, 0));
}

}  // namespace

asio::awaitable<void> LinkState::until(const std::function<bool()>& ready) {
  const std::function<bool()> ready_or_failed = [&] { return failure || ready(); };
  co_await signal.wait(TimePoint::max(), ready_or_failed);
  if (failure) throw LinkError(*failure);
}

asio::awaitable<bool> LinkState::until(const std::function<bool()>& ready, TimePoint deadline) {
  const std::function<bool()> ready_or_failed = [&] { return failure || ready(); };
  const bool woken = co_await signal.wait(deadline, ready_or_failed);
  if (failure) throw LinkError(*failure);
  co_return woken;
}

void LinkState::fail(const std::string& message) {
  if (!failure) failure = message;
  holding = true;
  signal.notify();
}

std::string LinkState::with_heat_warning(const std::string& message) const {
  if (phase == Phase::greeting) return message;
  return message + "; its heaters may still be on: if they are, switch the printer off";
}

void LinkState::give_up(std::string message) {
  if (phase == Phase::streaming) statistics.bytes += switch_heaters_off(port.native_handle());
  fail(with_heat_warning(message));
  throw LinkError(*failure);
}

asio::awaitable<void> LinkState::quiet(Duration pause) {
  const auto limit = now() + longest_drain + pause;
  std::uint64_t seen = 0;
  const std::function<bool()> more = [&] { return bytes_heard != seen; };
  do {
    seen = bytes_heard;
  } while (co_await until(more, now() + pause) && now() < limit);
}

// ---- greeting

asio::awaitable<void> LinkState::greet() {
  const std::function<bool()> spoken = [this] { return lines_heard > 0; };
  if (co_await until(spoken, now() + options.boot)) {
    co_await quiet(std::min<Duration>(boot_chatter, options.boot));
  }
  co_await ask_firmware();
  if (one_by_one()) co_await begin_one_by_one();
  co_await begin_reports();
  co_await reset_numbers();
  doubt = false;
  phase = Phase::streaming;
  if (numbering) numbering(ledger.next_to_number(), 0);
}

/// Tries twice; then the link asks itself.
asio::awaitable<void> LinkState::begin_reports() {
  if (options.temperatures.count() == 0) co_return;
  if (!identity.can("AUTOREPORT_TEMP")) {
    ask_at = now() + options.temperatures;
    co_return;
  }
  for (int attempt = 0; attempt < 2; ++attempt) {
    const auto oks_before = oks;
    const std::function<bool()> answered = [&] { return oks > oks_before; };
    write(fmt::format("M155 S{}\n", options.temperatures.count()));
    if (co_await until(answered, now() + std::min<Duration>(ask_again, options.silence))) co_return;
  }
  ask_at = now() + options.temperatures;
}

// ---- rejoining

/// Sends no line with an acceptable number, so it changes nothing and can be repeated.
asio::awaitable<Rejoined> LinkState::find_again(std::uint32_t beyond) {
  probing = true;
  const auto lines_before = lines_heard;
  // Ends half a line so that it is refused: Repetier would run a numbered line without a checksum. What
  // stands before the asterisk has the checksum 0 once in 256 times.
  write("*\n");
  co_await quiet(options.quiet);
  Rejoined found;
  const std::function<bool()> warm = [this] { return reported_temperatures.has_value(); };
  co_await ask("M105\n", warm);
  if (lines_heard == lines_before) {
    give_up("the printer does not answer; check that it is on, and the cable, then resume again");
  }
  // M114 is answered after everything that was sent before. Twice, since homing gives the same answer.
  const std::function<bool()> located = [this] { return reported_position.has_value(); };
  for (int i = 0; i < 2; ++i) {
    reported_position.reset();
    co_await ask("M114\n", located);
  }
  found.position = reported_position;
  found.temperatures = reported_temperatures.value_or(gcode::Temperatures{});
  const std::function<bool()> named = [this] { return !firmware.empty(); };
  co_await ask("M115\n", named);
  if (!one_by_one()) found.next = co_await ask_for_number(beyond);  // else 0: it does not count lines
  probing = false;
  co_return found;
}

/// A Repetier that already waits for a line does not answer; it repeats its request by its own clock.
asio::awaitable<std::uint32_t> LinkState::ask_for_number(std::uint32_t beyond) {
  const auto reported_before = std::exchange(reported_next, std::nullopt);
  const std::function<bool()> answered = [this] { return reported_next.has_value(); };
  co_await ask(framed(beyond, "M105"), answered);
  if (!reported_next) reported_next = reported_before;
  if (!reported_next) {
    give_up("the printer does not report which line it expects next; start the print again from its job");
  }
  co_return *reported_next;
}

/// Repeats the question if a refusal may have flushed the printer's buffer, and after silence, since noise
/// may have damaged it.
asio::awaitable<void> LinkState::ask(std::string_view query, const std::function<bool()>& answered) {
  auto refusals_before = refusals;
  const std::function<bool()> over = [&] { return answered() || restarted; };
  const std::function<bool()> over_or_refused = [&] { return over() || refusals != refusals_before; };
  const auto patient_until = now() + options.slow_ok;
  int silences = 0;
  for (int asks = 0; asks < most_asks && silences < find_attempts && !over(); ++asks) {
    last_life = now();
    refusals_before = refusals;
    write("\n");  // after an overrun, Marlin is silent until a newline arrives
    write(query);
    while (!over_or_refused() && now() < std::min(last_life + options.silence, patient_until)) {
      co_await until(over_or_refused, std::min(last_life + options.silence, patient_until));
    }
    if (!over_or_refused()) ++silences;
    co_await quiet(options.quiet);
  }
  if (restarted) throw PrinterReset("the printer has restarted");
}

void LinkState::go_on(std::uint32_t next) {
  ledger = new_ledger(next);
  doubt = true;  // the next ok may belong to an earlier line
  if (options.temperatures.count() > 0 && !identity.can("AUTOREPORT_TEMP"))
    ask_at = now() + options.temperatures;
  phase = Phase::streaming;
}

asio::awaitable<void> LinkState::ask_firmware() {
  const auto started = now();
  const auto lines_before = lines_heard;
  const std::function<bool()> answered = [this] { return !firmware.empty(); };
  // The newline ends a line that an earlier program may have left half written.
  for (int asked_times = 1;; ++asked_times) {
    write("\nM115\n");
    if (co_await until(answered, now() + std::min<Duration>(ask_again, options.silence))) break;
    if (oks > 0 && asked_times >= 3) break;  // it understands, but has no name
    const auto patient_until = std::max(started, last_life) + options.silence * longest_boot;
    if (now() < std::min(patient_until, started + options.no_ok)) continue;
    give_up(lines_heard > lines_before
                ? "the answer to M115 is not that of a printer; check the baud rate in its profile"
                : "the printer does not answer; check that it is on and that port and baud rate are right");
  }
  co_await quiet(options.quiet);
}

/// Sends M110 alone, since Marlin acts on it twice: on receipt and on execution.
asio::awaitable<void> LinkState::reset_numbers() {
  for (int attempt = 0; attempt < number_attempts; ++attempt) {
    const auto oks_before = oks, refusals_before = refusals;
    const std::function<bool()> answered = [&] { return oks > oks_before || refusals > refusals_before; };
    doubt = false;
    write(framed(0, "M110 N0"));
    const bool heard = co_await until(answered, now() + patience());
    co_await quiet(options.quiet);
    if (heard && refusals == refusals_before && !doubt) co_return;
  }
  give_up("the printer does not accept M110, or the line to it is too noisy; check the cable");
}

// ---- keeping it going

asio::awaitable<void> LinkState::supervise([[maybe_unused]] std::shared_ptr<LinkState> self) {
  const auto unproven = [this] { return draining && doubt && !holding && ledger.settled(); };
  // Numbering restarts only after lines that are proven to be done.
  const auto used_up = [this] { return !holding && ledger.exhausted(); };
  const auto idle = [this] { return idle_words > 1; };
  TimePoint deadline;  // may become earlier, since lines were sent or the firmware reports that it is busy
  const std::function<bool()> due = [&] {
    return asked || stranger || unproven() || used_up() || idle() || stall_deadline() < deadline;
  };
  try {
    for (;;) {
      deadline = stall_deadline();
      co_await until(due, std::min(deadline, ask_at));
      if (asked)
        co_await answer_resend();
      else if (stranger || unproven() || idle() || now() >= stall_deadline() || (used_up() && doubt))
        co_await resynchronise();
      else if (used_up())
        co_await count_again();
      else if (now() >= ask_at)
        ask_temperatures();
    }
  } catch (const LinkError&) {
    // fail() has woken all waiters.
  }
}

/// A firmware without an emergency parser reads nothing while it waits for heat, and so does not see M108.
/// Homing and probing are given their time; so are the lines of the end, which come after `beyond`.
asio::awaitable<void> LinkState::limit_wait([[maybe_unused]] std::shared_ptr<LinkState> self,
                                            std::uint32_t beyond) {
  const auto waits = [&] { return ledger.waits_before(beyond); };
  const std::function<bool()> over = [&] { return failure || !ledger.in_flight() || !waits(); };
  const std::function<bool()> waiting = [&] { return failure || !ledger.slow_in_flight() || waits(); };
  while (!failure && ledger.slow_in_flight()) {
    if (!co_await signal.wait(TimePoint::max(), waiting) || failure || !waits()) co_return;
    if (co_await signal.wait(now() + cooling_patience, over)) continue;
    cut_wait_short = true;
    fail(
        "the printer does not end its wait, since its firmware reads nothing meanwhile; it was stopped at "
        "once");
    emergency_stop();
  }
}

Duration LinkState::patience() const {
  const bool reports = identity.can("BUSY_PROTOCOL") ||
                       (heard_busy && identity.family == gcode::Family::marlin) ||
                       (one_by_one() && reported_temperatures);
  return reports ? std::min(options.keepalive, options.silence) : options.silence;
}

TimePoint LinkState::stall_deadline() const {
  if (!ledger.in_flight()) return now() + patience();
  return std::min({last_life + patience(), ok_deadline(), answer_deadline()});
}

/// Other firmwares say ok when a line has come, and report when they are idle.
TimePoint LinkState::answer_deadline() const {
  const bool timed = identity.family == gcode::Family::marlin && !waits_for_user;
  if (!timed || !ledger.all_timed()) return TimePoint::max();
  return std::max(last_life, moves_until) + answer_slack;
}

void LinkState::ask_temperatures() {
  ask_at = now() + options.temperatures;
  if (holding || ledger.exhausted()) return;
  insert_query();
  pump();
}

void LinkState::insert_query() {
  if (ledger.fence()) ++statistics.queries;
  if (numbering) numbering(ledger.next_to_number(), ledger.numbered());
}

/// M110 may act again when it is executed; no newer line may have arrived by then. A firmware whose oks come
/// on receipt must therefore be idle, which it reports every second.
asio::awaitable<void> LinkState::count_again() {
  holding = true;
  if (identity.family == gcode::Family::repetier) {
    const auto words_before = waits_heard;
    const std::function<bool()> idle = [&] { return waits_heard > words_before; };
    co_await until(idle, now() + options.no_ok);
  }
  co_await reset_numbers();
  ++statistics.recounts;
  ledger.restart();
  asked.reset();
  stranger.reset();
  doubt = holding = false;
  last_ok = last_life = now();
  if (numbering) numbering(ledger.next_to_number(), ledger.numbered());
  pump();
  signal.notify();
}

TimePoint LinkState::ok_deadline() const {
  return last_ok + (ledger.slow() ? options.slow_ok : options.no_ok);
}

asio::awaitable<void> LinkState::answer_resend() {
  co_await quiet(options.quiet);
  if (!asked) co_return;
  if (ledger.acknowledged() > best_acknowledged)
    best_acknowledged = ledger.acknowledged(), fruitless_resends = 0;
  if (++fruitless_resends > most_resends) {
    give_up(fmt::format(
        "the printer has asked {} times for line {} or its neighbours: the connection is too noisy; "
        "check the cable, and keep it away from motors and mains",
        most_resends, *asked));
  }
  ++statistics.resends;
  resume_from(*asked, false);
}

/// A receive buffer that is smaller than the profile says loses lines all the time. Each loss is repaired,
/// but some damage has a matching checksum.
void LinkState::note_loss() {
  if (ledger.acknowledged() > losses_since + losses_within) losses = 0, losses_since = ledger.acknowledged();
  if (++losses < most_losses || ledger.window() / 2 < least_window - 1) return;
  losses = 0;
  ledger.halve_window();
  if (!listener) return;
  listener(
      fmt::format("warning: the printer loses what is sent to it; from now on at most {} bytes are sent "
                  "ahead; if the cable "
                  "is sound, write receive_buffer = {} into the profile",
                  ledger.window(), ledger.window() + 1));
}

void LinkState::resume_from(std::uint32_t number, bool with_fence) {
  if (number < ledger.next()) note_loss();
  ledger.rewind(number);
  if (with_fence) insert_query();
  statistics.acknowledged = ledger.acknowledged();
  asked.reset();
  stranger.reset();
  holding = false;
  idle_words = 0;
  last_ok = last_life = now();
  pump();
  signal.notify();
}

asio::awaitable<void> LinkState::resynchronise() {
  if (ledger.in_flight() && now() >= ok_deadline()) {
    give_up(finishes_nothing);
  }
  if (one_by_one()) co_return co_await find_out();
  const auto waiting_since = ledger.in_flight() ? last_ok : now();
  holding = true;
  co_await quiet(options.quiet);
  for (int attempt = 0; attempt < probe_attempts || still_at_work(); ++attempt) {
    if (!co_await probe(options.silence * (attempt < probe_attempts ? 1 : longer_probe))) continue;
    co_await quiet(options.quiet);
    probing = false;
    resume_from(*asked, true);
    last_ok = std::max(waiting_since, last_person);  // the answer to a probe is not progress
    co_return;
  }
  if (now() >= ok_deadline()) give_up(finishes_nothing);
  give_up(stranger
              ? fmt::format("the printer asks for line {}, which was sent long ago: it must have been reset; "
                            "clear the bed and start the print again",
                            *stranger)
              : "the printer has fallen silent; check its power and the cable");
}

/// A Marlin says ok when a slow command is done, others perhaps when it is queued.
bool LinkState::still_at_work() const {
  const bool slow = identity.family == gcode::Family::marlin || one_by_one()
                        ? ledger.slow_in_flight()
                        : ledger.in_flight() && ledger.slow();
  return slow && !stranger && now() < std::min(last_line + options.no_ok, ok_deadline());
}

asio::awaitable<bool> LinkState::probe(Duration patience) {
  ++statistics.probes;
  probing = true;
  doubt = false;
  asked.reset();
  stranger.reset();
  // The newline ends a line whose own newline was lost.
  write("\n" + framed(ledger.next() + probe_distance, "M105"));
  const std::function<bool()> answered = [this] { return asked || stranger; };
  last_life = now();
  // A printer whose command queue is full reads nothing, but reports that it is busy.
  while (!answered() && now() < std::min(last_life + patience, ok_deadline())) {
    co_await until(answered, std::min(last_life + patience, ok_deadline()));
  }
  co_return asked.has_value();
}

}  // namespace unicursal::host
