// What a colour reflects in each part of the spectrum, as far as its red, green and blue can say: the
// smoothest such spectrum is guessed, a sigmoid of a parabola over the wavelength (Jakob and Hanika, "A
// Low-Dimensional Function Space for Efficient Spectral Upsampling", 2019). Plastics have smooth spectra.
//
// The spectrum has twelve bands of 25 nm from 400 to 700 nm, the first and the last with what lies beyond.
// They are seen in daylight (D65) by the observer of 1931 (CIE 15).
#pragma once

#include <array>
#include <cstddef>

#include "core/picture/lab.hpp"

namespace unicursal::picture {

inline constexpr std::size_t bands = 12;
using Reflectance = std::array<double, bands>;  ///< shares of light, 0…1

/// How much each band adds to red, green and blue of sRGB, as linear light; the sum of each is 1.
inline constexpr std::array<Reflectance, 3> seen_of_band{
    {{0.01542, 0.05182, -0.01060, -0.10950, -0.20467, -0.15098, 0.13646, 0.42935, 0.49462, 0.26445, 0.07322,
      0.01041},
     {-0.01244, -0.05047, -0.01644, 0.09090, 0.25601, 0.37088, 0.28342, 0.11407, -0.00793, -0.02291, -0.00562,
      0.00053},
     {0.08998, 0.40818, 0.44728, 0.15282, 0.01090, -0.03606, -0.03747, -0.02298, -0.00907, -0.00251, -0.00079,
      -0.00028}}};

/// Channels below 0 or above 1 are reached as nearly as a reflectance can. Each is between 0 and 1,
/// exclusive.
Reflectance reflectance_of(const Light& light);
Light light_of(const Reflectance& reflectance);

}  // namespace unicursal::picture
