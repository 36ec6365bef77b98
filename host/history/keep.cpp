#include "host/history/keep.hpp"

#include <algorithm>
#include <chrono>
#include <numbers>

#include "core/picture/hex_colour.hpp"
#include "host/history/fed_by_print.hpp"
#include "host/history/history.hpp"
#include "host/history/print_picture.hpp"

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;

const char* outcome_word(LegOutcome outcome) {
  switch (outcome) {
    case LegOutcome::completed:
      return "completed";
    case LegOutcome::stopped:
      return "stopped";
    case LegOutcome::failed:
      break;
  }
  return "failed";
}

std::vector<PastFilament> filaments_fed(const Spool& spool, const Profile& profile,
                                        const JournalState& journal) {
  const gcode::Printer& printer = profile.printer;
  const gcode::PerFeeder lengths = fed_by_print(spool.chunks(), journal, printer.feeders);
  const double area = std::numbers::pi / 4 * printer.filament_diameter * printer.filament_diameter;
  std::vector<PastFilament> fed;
  for (std::size_t f = 0; f < printer.feeders; ++f) {
    const double volume = lengths[f] * area / printer.flow_factors[f];
    if (volume <= 0) continue;
    const Filament& filament = profile.filaments.of_feeders[f];
    fed.push_back({static_cast<std::int64_t>(f) + 1, filament.name, filament.material,
                   picture::hex_of(filament.colour), amount_of(volume, filament)});
  }
  return fed;
}

/// s that a print took in sessions that have left no row: those of a program that was killed.
double seconds_before(const Spool& spool, std::int64_t began) {
  const auto since = spool.last_written()->time_since_epoch();
  return std::max(0.0, std::chrono::duration<double>(since).count() - static_cast<double>(began));
}

PastPrint past_print(const Spool& spool, const Job& job, const EndedSession& session,
                     const JournalState& journal) {
  PastPrint print;
  print.print = spool.folder().filename().string();
  print.job = spool.order().job_name;
  print.file = session.job;
  const bool goes_on = spool.last_written().has_value();
  if (print.file.empty() && !goes_on) print.file = fs::absolute(job.file).string();
  if (const auto& layers = spool.order().layers) print.range = LayerRange{layers->first, layers->second};
  print.began = time_in_name(print.print);
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  print.ended_at = std::chrono::duration_cast<std::chrono::seconds>(now).count();
  print.seconds = session.seconds;
  print.foretold = session.foretold;
  print.ended = journal.ended ? outcome_word(journal.ended->outcome) : "failed";
  const bool completed = print.ended == "completed";
  if (!completed)
    print.reason = session.reason.empty() && journal.ended ? journal.ended->reason : session.reason;
  print.layers = static_cast<std::int64_t>(spool.order().layer_count);
  print.layers_done =
      completed ? print.layers : static_cast<std::int64_t>(layers_passed(spool.chunks(), journal));
  print.currency = job.profile.filaments.currency;
  print.filaments = filaments_fed(spool, job.profile, journal);
  print.warnings = session.warnings;
  return print;
}

}  // namespace

std::optional<HistoryEntry> history_entry(Spool& spool, const Production& production,
                                          const EndedSession& ended) {
  std::error_code unknown;
  if (!fs::exists(spool.folder() / "journal", unknown)) return std::nullopt;  // nothing was sent
  spool.journal().sync();
  const JournalState journal = read_journal(spool.folder() / "journal");
  if (!journal.connected || journal.furthest == 0) return std::nullopt;
  HistoryEntry entry;
  entry.root = spool.folder().parent_path();
  entry.goes_on = spool.last_written().has_value();
  entry.print = past_print(spool, production.job(), ended, journal);
  entry.picture = print_picture(production, spool.chunks());
  if (entry.goes_on && entry.print.began) entry.seconds_before = seconds_before(spool, *entry.print.began);
  return entry;
}

KeptInHistory keep_in_history(HistoryEntry entry) noexcept {
  try {
    PastPrint& print = entry.print;
    try {
      History history(entry.root, History::For::changing);
      if (entry.goes_on && !history.knows(print.print)) {
        print.foretold.reset();  // of the rest only
        if (print.seconds) *print.seconds += entry.seconds_before;
      }
      history.add(print, entry.picture, entry.goes_on);
      return {true, history.notes()};
    } catch (const HistoryError& error) {
      const bool waits = History::let_wait(entry.root, print, entry.goes_on);
      return {false,
              {std::string("the history of prints cannot be written: ") + error.what() +
               (waits ? "; the print is added to it later" : "; the print is missing from it")}};
    }
  } catch (...) {
    return {false, {"the print could not be added to the history: out of memory"}};
  }
}

std::vector<std::string> keep_in_history(Spool& spool, const Production& production,
                                         const EndedSession& ended) noexcept {
  try {
    const auto entry = history_entry(spool, production, ended);
    return entry ? keep_in_history(*entry).notes : std::vector<std::string>();
  } catch (const std::exception& error) {
    return {std::string("the print could not be added to the history: ") + error.what()};
  }
}

}  // namespace unicursal::host
