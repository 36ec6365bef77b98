// The colours of printed plastic, by a model that shares nothing with core/picture: the theory of Kubelka and
// Munk
// ("Ein Beitrag zur Optik der Farbanstriche", 1931) in 16 bands of wavelength, with Saunderson's correction
// for the surface (J. Opt. Soc. Am. 32, 1942). A thin layer lets some of what is behind it shine through. The
// spectra are invented, and have the shapes of usual pigments. Lengths in mm, reflectances 0 to 1.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace unicursal::camera {

inline constexpr std::size_t bands = 16;  ///< 400 to 700 nm in steps of 20 nm
using Spectrum = std::array<double, bands>;
/// Red, green and blue as linear light; white is 1.
using Rgb = std::array<float, 3>;

struct Pigment {
  Spectrum absorbed{}, scattered{};  ///< per mm
};

/// "white", "black", "red", "orange", "yellow", "green", "cyan", "blue" or "magenta". Throws
/// std::out_of_range.
Pigment pigment_named(std::string_view name);

/// `part` of the second pigment, 0 to 1, mixed through with the first.
Pigment mixed(const Pigment& first, const Pigment& second, double part);

/// What a layer of this thickness reflects on a ground that reflects `behind`; mm.
Spectrum reflected(const Pigment& pigment, double thickness, const Spectrum& behind);

/// A grey that reflects all bands alike, warmer if `warmth` is positive (-1 to 1).
Spectrum grey(double reflectance, double warmth = 0);

/// How a camera that is balanced for the light records the reflectance.
Rgb recorded(const Spectrum& reflectance);

}  // namespace unicursal::camera
