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

bool elsewhere(const gcode::ModalState& expected, const std::array<double, 3>& found) {
  for (std::size_t axis = 0; axis < found.size(); ++axis) {
    const auto& coordinate = expected.position[axis];
    if (coordinate && std::abs(*coordinate - found[axis]) > same_place) return true;
  }
  return false;
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

std::optional<Lost> lost_since(const JournalState& journal, const Rejoined& found,
                               const std::filesystem::path& chunks, const SpoolExtent& extent) {
  const auto place = journal.place_of(found.next);
  const std::uint64_t end = journal.leg.lead_in.size() + extent.lines - journal.leg.begins_at;
  if (!place || *place > end || *place + uncertain_oks < journal.acknowledged) {
    return Lost{"its line number is not one of this print: it has been reset or used otherwise",
                std::nullopt};
  }
  const gcode::ModalState expected = state_at(chunks, journal.leg, *place);
  if (found.position && elsewhere(expected, *found.position)) {
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
