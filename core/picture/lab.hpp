// Colours as people see them: CIELAB (CIE 15:2004, white D65), and how far two of them lie apart, ΔE2000
// (CIE 142:2001, as computed by Sharma, Wu and Dalal, "The CIEDE2000 color-difference formula", 2005).
#pragma once

#include <array>
#include <string>

#include "core/picture/image.hpp"

namespace unicursal::picture {

/// Red, green and blue of sRGB (IEC 61966-2-1) as linear light, 0…1.
using Light = std::array<double, 3>;

Light light_of(Colour colour);
/// One channel, 0…1, from and to the values in which bytes hold it.
double decoded(double encoded);
double encoded(double linear);
/// The nearest colour that bytes can hold.
Colour colour_of(const Light& light);

struct Lab {
  double lightness = 0;  ///< L*, 0 black … 100 white
  double a = 0, b = 0;   ///< green to red, blue to yellow
};

Lab lab_of(const Light& light);
/// The light of a colour that may lie outside sRGB; channels may then be below 0 or above 1.
Light light_of(const Lab& lab);

/// 1 is about the least difference that a trained eye sees.
double difference(const Lab& one, const Lab& other);
/// What that means, after "which is": "the same to the eye", "very near", "near", "a similar colour",
/// "another colour".
std::string in_words(double difference);

}  // namespace unicursal::picture
