#include "host/tune/transition_fit.hpp"

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "core/error.hpp"

namespace unicursal::host {
namespace {

constexpr double mixing_end = 0.95;  ///< share of the change at which the profile's mixing volume ends
constexpr double least_tanks = 1, most_tanks = 6;
constexpr double tank_step = 0.1;
constexpr double most_widening = 5;  ///< ticks; worse readings cannot be of this strip
constexpr double widening_step = 1.25;
constexpr double slack = 1e-9;  ///< mm³, of rounding

/// dead + share·mixing lies within the range.
struct Band {
  double share;
  VolumeRange range;
};

/// A straight line dead + share·mixing = volume, or dead = 0 (share 0), or mixing = 0.
struct Line {
  double dead, mixing, volume;
};

struct Span {
  double least = std::numeric_limits<double>::infinity(), greatest = -least;

  void include(double value) {
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
  bool empty() const { return least > greatest; }
  Estimate middle() const { return {(least + greatest) / 2, (greatest - least) / 2}; }
};

struct Feasible {
  Span dead, mixing;
};

bool agrees(const std::vector<Band>& bands, double dead, double mixing) {
  if (dead < -slack || mixing < -slack) return false;
  return std::all_of(bands.begin(), bands.end(), [&](const Band& band) {
    const double passed = dead + band.share * mixing;
    return passed >= band.range.least - slack && passed <= band.range.greatest + slack;
  });
}

/// The volumes that agree form a convex polygon, whose corners are crossings of two borders.
void add_corners(const std::vector<Band>& bands, Feasible& feasible) {
  std::vector<Line> lines = {{1, 0, 0}, {0, 1, 0}};
  for (const Band& band : bands) {
    lines.push_back({1, band.share, band.range.least});
    lines.push_back({1, band.share, band.range.greatest});
  }
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t j = i + 1; j < lines.size(); ++j) {
      const Line &a = lines[i], &b = lines[j];
      const double determinant = a.dead * b.mixing - a.mixing * b.dead;
      if (std::abs(determinant) < slack) continue;
      const double dead = (a.volume * b.mixing - a.mixing * b.volume) / determinant;
      const double mixing = (a.dead * b.volume - a.volume * b.dead) / determinant;
      if (!agrees(bands, dead, mixing)) continue;
      feasible.dead.include(dead);
      feasible.mixing.include(mixing);
    }
  }
}

VolumeRange widened(const VolumeRange& range, double times) {
  const double middle = (range.least + range.greatest) / 2, half = (range.greatest - range.least) / 2;
  return {std::max(0.0, middle - times * half), middle + times * half};
}

Feasible feasible_with(const ReadVolumes& read, double times) {
  Feasible feasible;
  for (double tanks = least_tanks; tanks <= most_tanks + tank_step / 2; tanks += tank_step) {
    const double whole = gamma_quantile(tanks, mixing_end);
    const auto band = [&](double seen, const VolumeRange& range) {
      return Band{gamma_quantile(tanks, seen) / whole, widened(range, times)};
    };
    std::vector<Band> bands = {band(perception.began, read.began), band(perception.stopped, read.stopped)};
    if (read.half) bands.push_back(band(perception.half, *read.half));
    add_corners(bands, feasible);
  }
  return feasible;
}

}  // namespace

double gamma_quantile(double tanks, double p) {
  return boost::math::gamma_p_inv(tanks, p);
}

Transition fit_transition(const ReadVolumes& read) {
  for (double times = 1; times <= most_widening; times *= widening_step) {
    const Feasible feasible = feasible_with(read, times);
    if (feasible.dead.empty()) continue;
    return {feasible.dead.middle(), feasible.mixing.middle(), times};
  }
  throw core::DataError("", "the readings", "fit no mixing nozzle",
                        "read again: half changed lies between a fifth and two fifths of the way from where "
                        "the colour begins to change to where it stops");
}

}  // namespace unicursal::host
