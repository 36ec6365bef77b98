#include "host/tune/chart_fit.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/picture/hex_colour.hpp"

namespace unicursal::host {
namespace {

constexpr double most_disagreement = 6;  ///< ΔE between two patches of one filament
constexpr double most_unexplained = 5;   ///< ΔE, median of a chart that a sound print cannot have
constexpr double outstanding = 5, outstanding_times = 4;  ///< ΔE, and medians

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void expect_agreement(const Chart& chart, const std::vector<SeenPatch>& seen) {
  for (const SeenPatch& one : seen) {
    for (const SeenPatch& other : seen) {
      const auto feeder = chart.patches[one.patch].feeder;
      if (one.patch >= other.patch || !feeder || chart.patches[other.patch].feeder != feeder) continue;
      const double apart = difference(picture::lab_of(one.light), picture::lab_of(other.light));
      if (apart <= most_disagreement) continue;
      throw core::DataError(
          "", fmt::format("patches {} and {}", one.patch + 1, other.patch + 1),
          fmt::format("are both of feeder {} alone, but differ by a ΔE of {:.1f}", *feeder + 1, apart),
          "measure both again, in even light without gloss; if one was spoilt in the "
          "print, leave it out");
    }
  }
}

std::vector<double> shares_of(const gcode::Mixture& mixture) {
  return {mixture.shares().begin(), mixture.shares().end()};
}

}  // namespace

ChartFit fit_chart(const Chart& chart, const Filaments& filaments, const std::vector<SeenPatch>& seen,
                   picture::PureColours colours) {
  expect_agreement(chart, seen);
  std::vector<picture::MeasuredMixture> measured;
  for (const SeenPatch& one : seen)
    measured.push_back({shares_of(chart.patches[one.patch].mixture), one.light, one.noise});
  std::vector<picture::Colour> pure;
  for (const Filament& filament : filaments.of_feeders) pure.push_back(filament.colour);
  const auto fitted = picture::fit_filaments(pure, measured, colours);
  if (!fitted)
    throw core::DataError("", "the chart", "has too few patches, or they look too much alike",
                          "measure all of its patches, and check that the feeders hold different colours");
  ChartFit result{filaments, {}, 0, 0};
  for (std::size_t f = 0; f < pure.size(); ++f) {
    result.filaments.of_feeders[f].colour = fitted->pure[f];
    result.filaments.of_feeders[f].strength = fitted->mixing.strengths[f];
  }
  result.filaments.lift = fitted->mixing.lift;
  result.filaments.losses = fitted->mixing.pairs;
  const picture::Filaments usual = filaments.colours();
  std::vector<double> before;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const picture::Light foretold = mixed_light(measured[i].shares, usual);
    before.push_back(difference(picture::lab_of(foretold), picture::lab_of(seen[i].light)));
    result.patches.push_back({seen[i].patch, picture::colour_of(foretold), picture::colour_of(seen[i].light),
                              before.back(), fitted->differences[i]});
  }
  result.before = median_of(before);
  result.after = median_of(fitted->differences);
  if (result.after > most_unexplained)
    throw core::DataError(
        "", "the chart", fmt::format("cannot be explained: its patches are a ΔE of {:.1f} off", result.after),
        "check that the colours stand beside the right numbers, and that the profile's "
        "filaments are those in the feeders");
  for (FittedPatch& patch : result.patches)
    patch.stands_out = patch.after > std::max(outstanding, outstanding_times * result.after);
  return result;
}

std::vector<ProfileChange> colour_changes(const Filaments& before, const Filaments& after) {
  std::vector<ProfileChange> changes;
  const auto numbers = [](const picture::Light& light) {
    return fmt::format("{:.4f}, {:.4f}, {:.4f}", light[0], light[1], light[2]);
  };
  for (std::size_t f = 0; f < after.of_feeders.size(); ++f) {
    const Filament& filament = after.of_feeders[f];
    if (filament.colour != before.of_feeders[f].colour)
      changes.push_back(
          {"filament", f, "colour", fmt::format("\"{}\"", picture::hex_of(filament.colour)), "name"});
    changes.push_back(
        {"filament", f, "strength", fmt::format("[{}]", numbers(filament.strength.value())), "colour"});
  }
  std::string losses = "[";
  for (const picture::Mixing::Pair& pair : after.losses)
    losses += fmt::format("\n  [{}, {}, {}],", pair.one + 1, pair.other + 1, numbers(pair.loss));
  changes.push_back({"colours", {}, "lift", fmt::format("{:.4f}", after.lift), ""});
  changes.push_back({"colours", {}, "losses", losses + "\n]", "lift"});
  return changes;
}

}  // namespace unicursal::host
