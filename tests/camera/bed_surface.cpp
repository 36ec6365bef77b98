#include "tests/camera/bed_surface.hpp"

#include <algorithm>
#include <cmath>

#include "tests/camera/chance.hpp"

namespace unicursal::camera {
namespace {

constexpr double grid_step = 10, grid_line = 0.25, grid_start = 5;  ///< of glass, mm
constexpr double tape_width = 25, tape_gap = 0.5;                   ///< mm

/// How much of a line of this width, 0 to 1, covers a place at the distance `away` from its centre. mm.
double covered(double away, double width) {
  return std::clamp((width / 2 - std::abs(away)) / 0.05 + 0.5, 0.0, 1.0);
}

double from_nearest_line(double x) {
  return std::remainder(x - grid_start, grid_step);
}

double grain(double x, double y, double size, double strength, std::uint32_t seed) {
  return 1 + strength * (rippled(x / size, y / size, seed) - 0.5);
}

BedPlace glass_at(double x, double y) {
  const double line =
      std::max(covered(from_nearest_line(x), grid_line), covered(from_nearest_line(y), grid_line));
  const double smudge = std::max(0.0, rippled(x / 18, y / 14, 7) - 0.6);
  return {0.75 * line + 0.12 * smudge, 1};
}

BedPlace tape_at(double x, double y) {
  const double drift = 0.4 * (rippled(0.5, y / 40, 3) - 0.5);
  const double across = std::remainder(x + drift, tape_width);
  const double crepe = grain(x, y, 0.35, 0.25, 11) * grain(x / 3, y, 0.9, 0.12, 12);
  const double strip = std::floor((x + drift) / tape_width + 0.5);
  const double shade = 1 + 0.06 * (rippled(strip * 3.7, 0.2, 13) - 0.5);
  return {covered(across, tape_gap), crepe * shade};
}

}  // namespace

BedColours colours_of(Bed bed) {
  Spectrum tape{};
  const Spectrum dim = grey(0.16, -0.85), bright = grey(0.22, -0.9);
  for (std::size_t band = 0; band < bands; ++band)
    tape[band] = dim[band] + bright[band] * (band < 7 ? 0.8 : 0.1);
  switch (bed) {
    case Bed::glass:
      return {grey(0.06, -0.1), grey(0.7)};
    case Bed::pei:
      return {grey(0.11, 0.75), grey(0.16, 0.6)};
    case Bed::gold:
      return {grey(0.3, 0.55), grey(0.55, 0.4)};
    case Bed::tape:
      return {tape, grey(0.1)};
    case Bed::dark:
      return {grey(0.045), grey(0.08)};
    case Bed::light:
      return {grey(0.66, 0.05), grey(0.5)};
  }
  return {};
}

BedPlace bed_at(Bed bed, double x, double y) {
  switch (bed) {
    case Bed::glass:
      return glass_at(x, y);
    case Bed::pei:
      return {rippled(x / 25, y / 25, 1), grain(x, y, 0.25, 0.35, 2)};
    case Bed::gold:
      return {std::max(0.0, 2 * rippled(x / 0.3, y / 0.3, 4) - 1), grain(x, y, 0.6, 0.3, 5)};
    case Bed::tape:
      return tape_at(x, y);
    case Bed::dark:
      return {rippled(x / 30, y / 30, 6), grain(x, y, 0.15, 0.3, 8)};
    case Bed::light:
      return {0.2 * rippled(x / 40, y / 40, 9), grain(x, y, 0.5, 0.04, 10)};
  }
  return {};
}

Rgb table_at(double x, double y) {
  const double fibre = 0.7 + 0.6 * rippled(x / 60, y / 2.5, 21) * rippled(x / 15, y / 0.8, 22);
  const auto of = [&](double light) { return static_cast<float>(light * fibre); };
  return {of(0.24), of(0.15), of(0.09)};
}

}  // namespace unicursal::camera
