#include "host/tune/curve_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.hpp"
#include "host/tune/joint_fit.hpp"

namespace unicursal::host {
namespace {

constexpr int first_steps = 6, all_steps = 40;
/// Besides what the points scatter: the places in the photo and the volumes that the printer feeds.
constexpr double volume_doubt = 0.02, volume_doubt_share = 0.01, tank_doubt_share = 0.2;

/// The volume after which the colour has gone `share` of its change for good: most of the points around it
/// have.
std::optional<double> first_beyond(const std::vector<CurvePoint>& points, const ColourAnswer& answer,
                                   double share) {
  constexpr std::size_t around = 4;
  const auto has = [&](const CurvePoint& point) {
    return answer.change(point.colour, point.fat) >= answer.change(answer(share, point.fat), point.fat);
  };
  for (std::size_t i = 0; i + around < points.size(); ++i) {
    if (points[i].passed < 0) continue;
    std::size_t beyond = 0, usable = 0;
    for (std::size_t j = i; j <= i + around; ++j) {
      if (points[j].trust == 0) continue;
      ++usable;
      beyond += has(points[j]) ? 1 : 0;
    }
    if (2 * beyond > usable) return points[i].passed;
  }
  return std::nullopt;
}

/// How far a colour is from all colours of the change: glare and dirt are not on the way from one mixture to
/// the other, whatever the nozzle.
double beside_the_way(const CurvePoint& point, const std::vector<Seen>& way, const ColourAnswer& answer) {
  double least = std::numeric_limits<double>::infinity();
  for (const Seen& colour : way) {
    double squares = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      if (answer.uses(c)) squares += (point.colour[c] - colour[c]) * (point.colour[c] - colour[c]);
    }
    least = std::min(least, squares);
  }
  return std::sqrt(least);
}

bool all_finite(const CurvePoint& point) {
  const auto finite = [](double value) { return std::isfinite(value); };
  return finite(point.fat) && finite(point.trust) &&
         std::all_of(point.colour.begin(), point.colour.end(), finite) &&
         std::all_of(point.brightness.begin(), point.brightness.end(), finite);
}

/// The points without those that lie beside the way of the colours, or that could not be measured.
std::vector<CurvePoint> on_the_way(std::vector<CurvePoint> points, const ColourAnswer& answer) {
  constexpr int steps = 100;
  constexpr double allowed = 0.03, usual_times = 4;
  std::array<std::vector<Seen>, 2> ways;
  for (int i = 0; i <= steps; ++i) {
    for (std::size_t fat = 0; fat < 2; ++fat)
      ways[fat].push_back(answer(static_cast<double>(i) / steps, static_cast<double>(fat)));
  }
  for (CurvePoint& point : points) {
    if (!all_finite(point)) point.trust = 0;
  }
  std::vector<double> distances;
  for (const CurvePoint& point : points)
    distances.push_back(beside_the_way(point, ways[point.fat < 0.5 ? 0 : 1], answer));
  std::vector<double> sorted;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].trust > 0) sorted.push_back(distances[i]);
  }
  if (sorted.empty()) return points;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (distances[i] > allowed + usual_times * *middle) points[i].trust = 0;
  }
  return points;
}

/// The best of some guesses, after a few steps from each.
JointFit best_start(const std::vector<CurvePoint>& points, const std::vector<MixtureSwitch>& switches,
                    const ColourAnswer& answer, double began, double stopped) {
  constexpr double usual_scatter = 0.01;
  const double way = std::max(0.2, 1.2 * (stopped - began));
  std::optional<JointFit> best;
  for (const double tanks : {1.2, 2.0, 3.5, 5.5}) {
    const FittedNozzle guess{std::max(0.0, began - 0.1 * way), way, tanks};
    JointFit fit(points, switches, answer, guess, usual_scatter);
    fit.improve(first_steps);
    if (!best || fit.cost() < best->cost()) best.emplace(fit);
  }
  return *best;
}

void check_certain(const CurveFit& fit, const std::filesystem::path& file) {
  constexpr double most_uncertain = 0.12;  // of the sum of both volumes
  const double most = most_uncertain * (fit.dead.value + fit.mixing.value);
  // A condition that NaN does not meet.
  if (possible({fit.dead.value, fit.mixing.value, fit.tanks.value}) && fit.dead.uncertainty <= most &&
      fit.mixing.uncertainty <= most)
    return;
  const double worse = std::max(fit.dead.uncertainty, fit.mixing.uncertainty);
  throw core::DataError(
      file.string(), "",
      std::isfinite(worse)
          ? fmt::format("leaves the volumes too uncertain: {:.1f} and {:.1f} mm³, give or take {:.1f}",
                        fit.dead.value, fit.mixing.value, worse)
          : "leaves the volumes too uncertain: what it shows does not determine them",
      "take it again from nearer, sharp and in brighter light, without glare on the bead");
}

Estimate estimate(double value, double deviation, double floor) {
  return {value, 2 * std::hypot(deviation, floor)};
}

}  // namespace

CurveFit fit_curve(const std::vector<CurvePoint>& seen, const std::vector<MixtureSwitch>& switches,
                   const ReferenceColours& references, const std::filesystem::path& file) {
  const ColourAnswer answer(references);
  const std::vector<CurvePoint> points = on_the_way(seen, answer);
  const auto began = first_beyond(points, answer, perception.began);
  const auto stopped = first_beyond(points, answer, 0.9);
  if (!began)
    throw core::DataError(file.string(), "", "shows a strip that does not change its colour",
                          "print the strip with two feeders of different colours");
  if (!stopped)
    throw core::DataError(file.string(), "", "shows a strip that still changes its colour at its end",
                          "print again with a larger --range");
  JointFit fit = best_start(points, switches, answer, *began, *stopped);
  // The first fit finds the scatter, the second uses it.
  fit.improve(all_steps);
  fit.set_scatter(std::max(1e-3, fit.scatter()));
  fit.improve(all_steps);
  constexpr double most_scatter = 0.06;
  if (!(fit.scatter() <= most_scatter))
    throw core::DataError(file.string(), "",
                          "shows a strip that does not change its colour as behind a mixing nozzle",
                          "take the photo again in even light, without glare on the bead");
  const FittedNozzle &nozzle = fit.nozzle(), doubts = fit.doubts();
  const double floor = volume_doubt + volume_doubt_share * (nozzle.dead + nozzle.mixing);
  CurveFit found;
  found.dead = estimate(nozzle.dead, doubts.dead, floor);
  found.mixing = estimate(nozzle.mixing, doubts.mixing, floor);
  found.tanks = estimate(nozzle.tanks, doubts.tanks, tank_doubt_share * nozzle.tanks);
  found.scatter = fit.scatter();
  found.foretold = fit.foretold();
  check_certain(found, file);
  return found;
}

}  // namespace unicursal::host
