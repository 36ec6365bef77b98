#include "host/engine/restart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "firmware_gcode/interruption/lead_in.hpp"
#include "host/spool/spool_error.hpp"

namespace unicursal::host {
namespace {

/// Acknowledged lines that may not have been executed: Marlin's 16 planned moves and its queue of 4 commands.
constexpr std::uint64_t planned_lines = 20;

std::vector<std::string> commands(std::vector<std::string> lines) {
  gcode::keep_commands(lines);
  return lines;
}

bool placed_somewhere(const gcode::ModalState& state) {
  return std::all_of(state.position.begin(), state.position.end(),
                     [](const auto& coordinate) { return coordinate.has_value(); });
}

/// Notes the heights that the nozzle passed between two places, and while it was parked.
void note_heights(Restart& restart, const std::filesystem::path& chunks, const JournalState& journal,
                  std::uint64_t from, std::uint64_t to) {
  gcode::ModalState state = state_at(chunks, journal.leg, from);
  restart.lowest = restart.highest = state.position[2].value_or(0);
  const auto run = [&](const std::string& line) {
    state.run(line);
    const double height = state.position[2].value_or(restart.lowest);
    restart.lowest = std::min(restart.lowest, height);
    restart.highest = std::max(restart.highest, height);
  };
  LegReader reader(chunks, journal.leg, from);
  while (from < to) {
    const std::vector<std::string> lines = reader.next(to - from);
    if (lines.empty()) break;
    std::for_each(lines.begin(), lines.end(), run);
    from += lines.size();
  }
  std::for_each(journal.parking.begin(), journal.parking.end(), run);
  restart.drawn = state.drawn_back;
}

}  // namespace

Restart restart_after(const Production& production, const Spool& spool, const Lost& lost) {
  const JournalState& journal = spool.before();
  const bool settled = journal.aside || (journal.ended && journal.ended->outcome == LegOutcome::stopped);
  const std::uint64_t sent = std::max(journal.handed, journal.acknowledged);
  std::uint64_t certain = journal.acknowledged - std::min(journal.acknowledged, planned_lines);
  if (settled) certain = sent;
  if (lost.place) certain = *lost.place;
  Restart restart;
  const std::uint64_t line = journal.leg.line(certain);
  const gcode::ModalState state = state_at(spool.chunks(), Leg{}, line);
  if (!placed_somewhere(state)) {
    if (spool.extent().layers > 0 || !spool.untouched()) {
      throw SpoolError(
          spool.folder().string(), "",
          fmt::format("has no certain place to continue from: the printer had taken {} lines, and the "
                      "part had been begun; the start lines would home z onto it",
                      journal.leg.line(journal.acknowledged)),
          "clear the bed, and print the job again from the beginning");
    }
    return restart;
  }
  restart.leg.begins_at = line;
  restart.layer = layer_of(spool.chunks(), line);
  restart.repeated = std::max(sent, certain) - certain;
  if (!journal.ended && spool.extent().lines > line) restart.perhaps = spool.extent().lines - line;
  note_heights(restart, spool.chunks(), journal, certain, std::max(sent, certain));
  if (settled) restart.lowest = restart.highest;
  gcode::Chunk chunk = gcode::lead_in(
      production.job().profile.printer,
      {state, restart.lowest, production.job().print.flow, production.extent(), restart.drawn});
  restart.leg.height = restart.lowest;
  restart.leg.lead_in = commands(std::move(chunk.lines));
  restart.warnings = std::move(chunk.warnings);
  return restart;
}

std::optional<Lost> lost_before(const JournalState& journal) {
  if (!journal.parking.empty())
    return Lost{journal.aside ? "its nozzle was moved aside" : "it was parked and cooled", std::nullopt};
  if (journal.anchors.empty()) return Lost{"nothing had been sent to it", std::nullopt};
  return std::nullopt;
}

std::string check_not_superseded(const Spool& spool, const std::optional<std::string>& port) {
  const LaterPrints later = later_prints(spool, port);
  if (!spool.before().superseded && later.same.empty()) return later.other;
  const std::string& by = later.same.empty() ? spool.before().superseded_by : later.same;
  throw SpoolError(spool.folder().string(), "",
                   "this print cannot be resumed, because another print has begun on its printer since" +
                       (by.empty() ? by : ": " + by),
                   "resume that one, or print the job again from the beginning");
}

std::string restart_in_words(const Restart& restart, const Lost& lost, const Spool& spool) {
  std::string words;
  const auto out = std::back_inserter(words);
  fmt::format_to(out, "The printer cannot continue with the next line: {}.\n", lost.why);
  if (restart.from_start()) {
    fmt::format_to(out, "Nothing had been printed yet, so the print starts from the beginning.\n");
    return words;
  }
  if (restart.layer) {
    fmt::format_to(out, "The print continues in layer {} of {}, at z = {:.2f} mm.\n",
                   restart.layer->index + 1, spool.order().layer_count, restart.layer->top);
  }
  if (restart.repeated > 0) {
    fmt::format_to(
        out,
        "Everything before that place was printed. Of the next {} lines some may have been printed; they "
        "are printed again.\n",
        restart.repeated);
  }
  if (restart.perhaps > restart.repeated) {
    fmt::format_to(
        out,
        "The record of the print has no end. If this computer lost its power, too, up to {} lines may have "
        "been "
        "printed\nand are printed again: check that the nozzle stands where the print continues.\n",
        restart.perhaps);
  }
  fmt::format_to(
      out,
      "The nozzle heats where it stands, rises, homes x and y (not z, because of the part), purges plastic "
      "beside the\npart, and continues. Its height is taken to be {:.2f} mm: do not continue if the z axis "
      "was moved or has sunk.\n",
      restart.lowest);
  if (restart.highest > restart.lowest) {
    fmt::format_to(
        out,
        "The nozzle was rising: it may be as high as {:.2f} mm, and then the rest of the print is that much "
        "too high.\n",
        restart.highest);
  }
  fmt::format_to(out, "Manual changes of speed, flow and temperature are reset to the job's values.\n");
  for (const std::string& warning : restart.warnings) fmt::format_to(out, "note: {}\n", warning);
  return words;
}

}  // namespace unicursal::host
