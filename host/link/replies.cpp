// Handles the printer's replies. The facts behind it are in host/link/state.hpp.
#include <algorithm>
#include <variant>

#include "core/text/printable.hpp"
#include "firmware_gcode/reply/phrases.hpp"
#include "host/link/state.hpp"

namespace unicursal::host {
namespace {

using namespace gcode;

/// The number of oks in a line that noise has damaged: one "ok" with a changed letter, or several replies
/// that have run together. One ok too many is harmless, since the firmware's command queue holds as much
/// again as its receive buffer; one too few would narrow the window for ever.
int damaged_oks(std::string_view text) {
  if (text.size() <= 2) return text.find_first_of("ok") != std::string_view::npos ? 1 : 0;
  if (!text.starts_with("ok") && !text.ends_with("ok")) return 0;
  int count = 0;
  for (auto at = text.find("ok"); at != std::string_view::npos; at = text.find("ok", at + 2)) ++count;
  return count;
}

/// Whether a line reports a temperature, even one that is not a number ("ok T:nan /0.0 B:23.9 /0.0").
bool mentions_heat(std::string_view line) {
  const auto mentions = [&](std::string_view label) { return line.find(label) != std::string_view::npos; };
  return mentions("T:") || mentions("T0:") || mentions("B:");
}

/// Whether an ok has run together with the report before it. Reports hold only labels and numbers.
bool ends_in_ok(const Reply& reply, std::string_view line) {
  return (std::holds_alternative<reply::TemperatureReport>(reply) ||
          std::holds_alternative<reply::Position>(reply)) &&
         line.find("ok") != std::string_view::npos;
}

/// Why a print cannot go on after such a line, a clause; empty if it can.
std::string_view consequence(std::string_view line) {
  const auto meaning = meaning_of(line);
  if (meaning == Meaning::refuses_to_move)
    return "the printer refuses to move, since it has lost its position; look at the part, then begin again";
  if (meaning == Meaning::no_such_tool)
    return "the printer has fewer tools than its profile says; correct the profile or the firmware";
  return {};
}

Duration in_clock(double seconds) {
  constexpr double longest = 1e6;  // s; no move takes longer
  return std::chrono::duration_cast<Duration>(std::chrono::duration<double>(std::min(seconds, longest)));
}

bool is_plain_ok(const Reply& reply) {
  const auto* ok = std::get_if<reply::Ok>(&reply);
  return ok != nullptr && ok->temperatures.empty();
}

}  // namespace

void LinkState::hear(std::string_view line) {
  if (line.ends_with('\r')) line.remove_suffix(1);  // Repetier ends lines with both
  const Reply reply = parse_reply(line);
  about_heat = mentions_heat(line);
  if (!std::holds_alternative<reply::Blank>(reply)) ++lines_heard, last_line = now();
  std::visit([this](const auto& what) { take(what); }, reply);
  if (ends_in_ok(reply, line)) about_heat = false, take(reply::Ok{});
  if (probing && std::holds_alternative<reply::Error>(reply)) return;  // the expected answer to a probe
  // A printer is asked for its tools before anything moves.
  const bool tolerated = !ledger.has_moved() && meaning_of(line) == Meaning::no_such_tool;
  if (const auto why = consequence(line); !why.empty() && !tolerated && phase == Phase::streaming) {
    cool_down();
    fail(std::string(why) + " (" + core::printable(line) + ")");
  }
  if (listener && !is_plain_ok(reply) && !std::holds_alternative<reply::Blank>(reply)) {
    listener(core::printable(line));
  }
}

void LinkState::take(const reply::Ok& ok) {
  ++oks;
  last_ok = last_life = now();
  waits_for_user = false;
  idle_words = 0;
  if (!ok.temperatures.empty()) {
    reported_temperatures = ok.temperatures;
    note(ok.temperatures);
  }
  const std::uint32_t queued = note_places(ok);
  if (phase == Phase::greeting || holding) return;
  const std::string oldest(one_by_one() && ledger.in_flight() ? ledger.oldest_command() : "");
  const std::uint64_t acknowledged = ledger.acknowledged();
  bool expected;
  if (ok.line)
    expected = ledger.acknowledge_number(*ok.line, queued);
  else if (about_heat && ledger.acknowledge_query())
    expected = true;
  else
    expected = ledger.acknowledge() || ledger.at_fence();
  if (!expected) doubt = true;
  if (ledger.acknowledged() > acknowledged) whereabouts.done(oldest);
  statistics.acknowledged = ledger.acknowledged();
  moves_until = std::max(moves_until, now()) + in_clock(ledger.take_acknowledged_seconds());
  moves_until = std::min(moves_until, now() + in_clock(ledger.queued_seconds()));
}

void LinkState::note(const Temperatures& reported) {
  if (reported.nozzle)
    temperatures.nozzle = reported.nozzle, temperatures.nozzle_target = reported.nozzle_target;
  if (reported.bed) temperatures.bed = reported.bed, temperatures.bed_target = reported.bed_target;
}

std::uint32_t LinkState::note_places(const reply::Ok& ok) {
  if (!ok.planner_places || !ok.command_places) return 0;
  constexpr std::uint32_t most = 4096;  // no firmware has longer queues; noise may say anything
  const std::uint32_t moves = std::min(*ok.planner_places, most);
  const std::uint32_t commands = std::min(*ok.command_places, most);
  if (!queues) queues.emplace();
  queues->planner_free = moves, queues->commands_free = commands;
  if (phase == Phase::greeting) {
    // The firmware is idle except for the command that this ok answers.
    queues->planner_size = std::max(queues->planner_size, moves);
    queues->commands_size = std::max(queues->commands_size, commands + 1);
  }
  const std::uint32_t taken = commands + 1;
  return out_of_band || taken > queues->commands_size ? 0 : queues->commands_size - taken;
}

void LinkState::take(const reply::Resend& resend) {
  asked_for(resend.line);
}

void LinkState::take(const reply::Error& error) {
  if (error.last_line) return asked_for(*error.last_line + 1);
  if (!error.halted) {
    last_error = core::printable(error.text);
    ++refusals;
    return;
  }
  // The words of kill() hide the reason, which came before. A printer that only refuses to move still
  // listens.
  const bool bare = error.text.find("kill()") != std::string::npos && !last_error.empty();
  const std::string why = bare ? last_error : core::printable(error.text);
  cool_down();
  fail("the printer has stopped itself (" + why +
       "); remove the cause, then switch the printer off and on again");
}

void LinkState::asked_for(std::uint32_t number) {
  ++refusals;
  reported_next = number;
  if (phase == Phase::greeting) return;
  if (!probing) doubt = true;
  const auto known = ledger.locate(number);
  if (known)
    asked = known;
  else
    stranger = number;
  holding = true;
}

void LinkState::take(const reply::Start&) {
  ++refusals;
  restarted = true;
  if (phase == Phase::greeting) return;
  fail(
      "the printer has reset itself in the middle of the job: its position and heat are lost; "
      "check its power supply, then see `unicursal resume`");
}

/// A wait for a person can take any time.
void LinkState::take(const reply::Busy& busy) {
  last_life = now();
  heard_busy = true;
  waits_for_user = busy.for_user;
  if (busy.for_user) last_ok = last_person = now();
}

/// Repetier says "wait" every second in which it is idle. The first one may have crossed with lines in
/// transit.
void LinkState::take(const reply::Wait&) {
  ++waits_heard;
  if (phase == Phase::streaming && !holding && ledger.in_flight()) ++idle_words;
}

void LinkState::take(const reply::TemperatureReport& report) {
  note(report.temperatures);
  if (one_by_one()) last_life = now();
  if (!report.waiting) {
    reported_temperatures = report.temperatures;
    return;
  }
  last_life = now();
  if (interruptions <= 0 || failure) return;
  --interruptions;
  doubt = true;
  write("M108\n");
}

void LinkState::take(const reply::Firmware& reported) {
  firmware = core::printable(reported.text, 1000);
  auto promised = std::move(identity.capabilities);
  identity = identify(reported.text);
  identity.capabilities = std::move(promised);
}

void LinkState::take(const reply::Capability& capability) {
  identity.learn(capability.name, capability.on);
}

void LinkState::take(const reply::Echo& echo) {
  if (!echo.unknown_command) return;
  ++refusals;
  doubt = true;
}

void LinkState::take(const reply::Position& position) {
  reported_position = position.mm;
  ++places_heard;
}

void LinkState::take(const reply::Unknown& unknown) {
  doubt = true;
  const int count = damaged_oks(unknown.text);
  for (int i = 0; i < count; ++i) take(reply::Ok{});
}

}  // namespace unicursal::host
