// The link to a firmware that neither compares line numbers nor asks for a line again (host/link/state.hpp,
// "RepRapFirmware"): one line at a time, and the place of the nozzle after silence.
#include <fmt/format.h>

#include "core/text/printable.hpp"
#include "host/link/state.hpp"

namespace unicursal::host {
namespace {

constexpr int attempts = 4;     ///< Each waits for LinkOptions::silence.
constexpr int longer_wait = 4;  ///< Multiple of that time, in later attempts during a slow command.
constexpr std::size_t one = 1;  ///< Byte: a window in which one line always fits, and no second one.

}  // namespace

bool LinkState::one_by_one() const {
  return identity.family == gcode::Family::reprapfirmware;
}

Ledger LinkState::new_ledger(std::uint32_t first) const {
  return Ledger(one_by_one() ? one : options.receive_buffer, first, options.last_number);
}

/// From its first M105 on, the firmware reports temperatures every 2 s during each command that takes longer.
asio::awaitable<void> LinkState::begin_one_by_one() {
  const std::function<bool()> warm = [this] { return reported_temperatures.has_value(); };
  ledger = new_ledger(1);
  write("M105\n");
  co_await until(warm, now() + options.silence);
  co_await quiet(options.quiet);
}

/// M114 is answered behind everything that was read. The line in flight is done by then, or was lost.
asio::awaitable<void> LinkState::find_out() {
  const auto waiting_since = ledger.in_flight() ? last_ok : now();
  holding = true;
  const auto oks_before = oks, places_before = places_heard;
  co_await quiet(options.quiet);
  const std::function<bool()> located = [&] { return places_heard > places_before; };
  for (int attempt = 0; attempt < attempts || still_at_work(); ++attempt) {
    ++statistics.probes;
    reported_position.reset();
    write("\n" + framed(0, "M114"));
    last_life = now();
    const auto patient = options.silence * (attempt < attempts ? 1 : longer_wait);
    while (!located() && now() < std::min(last_life + patient, ok_deadline()))
      co_await until(located, std::min(last_life + patient, ok_deadline()));
    if (!reported_position) continue;
    co_await quiet(options.quiet);
    doubt = false;
    judge_line_in_flight(oks - oks_before > places_heard - places_before);
    last_ok = waiting_since;  // the answer is not progress
    co_return;
  }
  give_up("the printer has fallen silent; check its power and the cable");
}

/// `late_ok`: the line's own ok has come meanwhile.
void LinkState::judge_line_in_flight(bool late_ok) {
  using Verdict = Whereabouts::Verdict;
  if (!ledger.in_flight()) return resume_from(ledger.next(), false);
  const std::string line(ledger.oldest_command());
  const Verdict verdict = late_ok ? Verdict::done : whereabouts.judge(line, *reported_position);
  if (verdict == Verdict::unknown)
    give_up(
        fmt::format("the printer has not answered \"{}\", and the place of its nozzle does not show whether "
                    "it has run that line; check the cable, then see `unicursal resume`",
                    core::printable(line)));
  if (verdict == Verdict::repeatable) {
    ++statistics.resends;
    return resume_from(ledger.oldest(), false);
  }
  whereabouts.done(line);
  resume_from(ledger.oldest() + 1, false);
}

}  // namespace unicursal::host
