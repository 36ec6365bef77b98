#include "tests/camera/pigments.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>

namespace unicursal::camera {
namespace {

constexpr double outer_reflection = 0.04;  ///< of light that meets plastic from the air
constexpr double inner_reflection = 0.5;   ///< of diffuse light that meets the surface from within
constexpr double least_reflectance = 1e-4;

double wavelength(std::size_t band) {
  return 400 + 20 * static_cast<double>(band);
}

/// Rises from 0 to 1 around `centre`; nm.
double step(double nm, double centre, double width) {
  return 1 / (1 + std::exp((centre - nm) / width));
}

double bump(double nm, double centre, double width) {
  const double away = (nm - centre) / width;
  return std::exp(-away * away / 2);
}

/// What is seen of a body with the reflectance `within`, and the inverse.
double through_surface(double within) {
  return outer_reflection +
         (1 - outer_reflection) * (1 - inner_reflection) * within / (1 - inner_reflection * within);
}
double below_surface(double seen) {
  const double entered = std::max(seen - outer_reflection, 0.0);
  return entered / ((1 - outer_reflection) * (1 - inner_reflection) + inner_reflection * entered);
}

/// `reflectance`: of a thick plate, without the reflection of its surface. `scattering`: per mm.
Pigment pigment_with(const std::function<double(double)>& reflectance, double scattering) {
  Pigment pigment;
  for (std::size_t band = 0; band < bands; ++band) {
    const double r = std::clamp(below_surface(outer_reflection + reflectance(wavelength(band))), 0.005, 0.97);
    pigment.scattered[band] = scattering;
    pigment.absorbed[band] = scattering * (1 - r) * (1 - r) / (2 * r);
  }
  return pigment;
}

std::map<std::string, Pigment, std::less<>> make_pigments() {
  std::map<std::string, Pigment, std::less<>> all;
  all["white"] = pigment_with([](double nm) { return 0.55 + 0.3 * step(nm, 415, 10); }, 13);
  all["black"] = pigment_with([](double) { return 0.015; }, 2.5);
  all["red"] = pigment_with([](double nm) { return 0.02 + 0.62 * step(nm, 603, 11); }, 6);
  all["orange"] = pigment_with([](double nm) { return 0.03 + 0.7 * step(nm, 572, 13); }, 7);
  all["yellow"] = pigment_with([](double nm) { return 0.04 + 0.74 * step(nm, 512, 14); }, 8);
  all["green"] = pigment_with([](double nm) { return 0.025 + 0.36 * bump(nm, 528, 36); }, 6);
  all["cyan"] = pigment_with([](double nm) { return 0.04 + 0.45 * bump(nm, 482, 44); }, 6);
  all["blue"] =
      pigment_with([](double nm) { return 0.025 + 0.4 * bump(nm, 452, 36) + 0.1 * step(nm, 690, 10); }, 5);
  all["magenta"] =
      pigment_with([](double nm) { return 0.03 + 0.55 * step(nm, 618, 13) + 0.26 * bump(nm, 430, 34); }, 5.5);
  return all;
}

/// Rows: red, green and blue as the sensor's filters pass them, each with a sum of 1.
std::array<Spectrum, 3> make_filters() {
  constexpr std::array<double, 3> centres = {598, 538, 458}, widths = {36, 38, 28};
  std::array<Spectrum, 3> filters{};
  for (std::size_t c = 0; c < 3; ++c) {
    double sum = 0;
    for (std::size_t band = 0; band < bands; ++band)
      sum += filters[c][band] = bump(wavelength(band), centres[c], widths[c]);
    for (double& passed : filters[c]) passed /= sum;
  }
  return filters;
}

/// From the sensor's channels to those of sRGB; rows have a sum of 1, so that white stays white.
constexpr double correction[3][3] = {{1.55, -0.5, -0.05}, {-0.22, 1.47, -0.25}, {0, -0.4, 1.4}};

}  // namespace

Pigment pigment_named(std::string_view name) {
  static const auto pigments = make_pigments();
  const auto found = pigments.find(name);
  if (found == pigments.end()) throw std::out_of_range("unknown pigment: " + std::string(name));
  return found->second;
}

Pigment mixed(const Pigment& first, const Pigment& second, double part) {
  Pigment mixture;
  for (std::size_t band = 0; band < bands; ++band) {
    mixture.absorbed[band] = (1 - part) * first.absorbed[band] + part * second.absorbed[band];
    mixture.scattered[band] = (1 - part) * first.scattered[band] + part * second.scattered[band];
  }
  return mixture;
}

Spectrum reflected(const Pigment& pigment, double thickness, const Spectrum& behind) {
  Spectrum seen{};
  if (thickness <= 0) return behind;
  for (std::size_t band = 0; band < bands; ++band) {
    const double s = pigment.scattered[band], k = pigment.absorbed[band];
    const double a = 1 + k / s, b = std::sqrt(std::max(a * a - 1, 1e-9));
    const double coth = 1 / std::tanh(b * s * thickness);
    const double ground = std::max(below_surface(behind[band]), least_reflectance);
    seen[band] = through_surface((1 - ground * (a - b * coth)) / (a - ground + b * coth));
  }
  return seen;
}

Spectrum grey(double reflectance, double warmth) {
  Spectrum spectrum{};
  for (std::size_t band = 0; band < bands; ++band) {
    const double along = (wavelength(band) - 550) / 150;
    spectrum[band] = std::clamp(reflectance * (1 + warmth * along), 0.0, 0.98);
  }
  return spectrum;
}

Rgb recorded(const Spectrum& reflectance) {
  static const auto filters = make_filters();
  std::array<double, 3> raw{};
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t band = 0; band < bands; ++band) raw[c] += filters[c][band] * reflectance[band];
  }
  Rgb light{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double sum = correction[c][0] * raw[0] + correction[c][1] * raw[1] + correction[c][2] * raw[2];
    light[c] = static_cast<float>(std::max(sum, 0.0));
  }
  return light;
}

}  // namespace unicursal::camera
