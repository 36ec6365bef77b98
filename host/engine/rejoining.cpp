#include "host/engine/rejoining.hpp"

#include <fmt/format.h>

#include <cmath>

namespace unicursal::host {
namespace {

constexpr double same_place = 0.05;  ///< mm; printers report two decimals, and round to their steps
/// Far from every line that the printer can have received, also modulo 65536.
constexpr std::uint32_t number_distance = 20000;
/// Lines that may count as acknowledged too early, after an ok was damaged (host/link/ledger.hpp).
constexpr std::uint64_t uncertain_oks = 16;

bool is_elsewhere(const gcode::ModalState& expected, const std::array<double, 3>& found) {
  for (std::size_t axis = 0; axis < found.size(); ++axis) {
    const auto& coordinate = expected.position[axis];
    if (coordinate && std::abs(*coordinate - found[axis]) > same_place) return true;
  }
  return false;
}

constexpr double exactly_same_place = 0.002;  ///< mm; for printers that report three decimals
constexpr std::size_t most_unknown = 64;      ///< lines that may have been executed without being noted

bool is_at(const gcode::ModalState& state, const std::array<double, 3>& found) {
  for (std::size_t axis = 0; axis < found.size(); ++axis) {
    const auto& coordinate = state.position[axis];
    if (!coordinate || std::abs(*coordinate - found[axis]) > exactly_same_place) return false;
  }
  return !state.relative;
}

/// Lines that do not move may be repeated, unless they move filament alone. Only one run of places may fit.
std::optional<std::uint64_t> place_by_position(const JournalState& journal,
                                               const std::array<double, 3>& found,
                                               const std::filesystem::path& chunks) {
  gcode::ModalState state = state_at(chunks, journal.leg, journal.acknowledged);
  LegReader reader(chunks, journal.leg, journal.acknowledged);
  std::optional<std::uint64_t> first;
  std::uint64_t last = 0;
  double drawn_back = 0;
  std::vector<std::string> lines;
  for (auto more = reader.next(most_unknown); !more.empty() && lines.size() < most_unknown;
       more = reader.next(most_unknown))
    lines.insert(lines.end(), more.begin(), more.end());
  for (std::size_t i = 0;; ++i) {
    const std::uint64_t place = journal.acknowledged + i;
    if (is_at(state, found)) {
      if (first && (last + 1 != place || state.drawn_back != drawn_back)) return std::nullopt;
      if (!first) first = place;
      last = place, drawn_back = state.drawn_back;
    }
    if (i == lines.size()) return first;
    state.run(lines[i]);
  }
}

bool cooled(double wanted, const std::optional<double>& target) {
  return wanted > 0 && target && *target == 0;
}

}  // namespace

std::uint32_t number_beyond(const JournalState& journal) {
  if (journal.anchors.empty()) return number_distance;
  const Anchor& last = journal.anchors.back();
  const std::uint64_t since = journal.handed > last.place ? journal.handed - last.place : 0;
  return last.number + static_cast<std::uint32_t>(since) + number_distance;
}

std::optional<std::uint64_t> place_found(const JournalState& journal, const Rejoined& found,
                                         const std::filesystem::path& chunks) {
  if (found.next > 0) return journal.place_of(found.next);
  return found.position ? place_by_position(journal, *found.position, chunks) : std::nullopt;
}

std::optional<Lost> lost_since(const JournalState& journal, const Rejoined& found,
                               const std::filesystem::path& chunks, const SpoolExtent& extent) {
  const auto place = place_found(journal, found, chunks);
  if (found.next == 0 && !place)
    return Lost{"it does not count lines, and its nozzle is not at one place of this print alone",
                std::nullopt};
  const std::uint64_t end = journal.leg.lead_in.size() + extent.lines - journal.leg.begins_at;
  if (!place || *place > end || *place + uncertain_oks < journal.acknowledged) {
    return Lost{"its line number is not one of this print: it has been reset or used otherwise",
                std::nullopt};
  }
  const gcode::ModalState expected = state_at(chunks, journal.leg, *place);
  if (found.position && is_elsewhere(expected, *found.position)) {
    return Lost{fmt::format("its nozzle is at {:.2f}, {:.2f}, {:.2f} mm, where this print did not leave it",
                            (*found.position)[0], (*found.position)[1], (*found.position)[2]),
                std::nullopt};
  }
  if (cooled(expected.nozzle, found.temperatures.nozzle_target) ||
      cooled(expected.bed, found.temperatures.bed_target)) {
    return Lost{"its heaters have been switched off", place};
  }
  return std::nullopt;
}

}  // namespace unicursal::host
