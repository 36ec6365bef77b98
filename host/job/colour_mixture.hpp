// Mixtures that are asked for by their colour.
#pragma once

#include <string>

#include "core/picture/image.hpp"
#include "firmware_gcode/print/mixture.hpp"
#include "host/job/profile.hpp"

namespace unicursal::host {

struct ColourMixture {
  gcode::Shares shares;
  picture::Colour made;   ///< what these filaments then give, as far as is known
  double difference = 0;  ///< from the wanted colour, ΔE2000
};

/// The mixture of the profile's filaments that comes nearest. Each share is at least the floor share.
ColourMixture mixture_near(picture::Colour wanted, const Profile& profile);

/// Shares for a written job, of the filaments that come nearest to a colour, "#rrggbb": in steps of 1/20,
/// without the floor share, which is applied to every mixture.
gcode::Shares shares_near(const std::string& colour, const Profile& profile);

/// "#3c9664 becomes #4a9a60 with 0.40 : 0.50 : 0.10; that is near (ΔE 4.2)", or that these filaments cannot
/// make it.
std::string in_words(const ColourMixture& mixture, picture::Colour wanted);

}  // namespace unicursal::host
