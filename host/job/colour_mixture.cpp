#include "host/job/colour_mixture.hpp"

#include <fmt/format.h>

#include "core/picture/hex_colour.hpp"
#include "core/picture/nearest_shares.hpp"

namespace unicursal::host {
namespace {

constexpr double too_far = 6;  ///< ΔE2000 from which nobody takes it for the wanted colour

}  // namespace

ColourMixture mixture_near(picture::Colour wanted, const Profile& profile) {
  const picture::NearestShares nearest =
      picture::nearest_shares(picture::lab_of(picture::light_of(wanted)), profile.filaments.colours(),
                              profile.printer.feeders, profile.printer.floor_share);
  return {gcode::Shares::of(nearest.shares), picture::colour_of(nearest.made), nearest.difference};
}

gcode::Shares shares_near(const std::string& colour, const Profile& profile) {
  constexpr int steps = 20;
  const picture::Lab wanted = picture::lab_of(picture::light_of(picture::colour_in(colour).value()));
  return gcode::Shares::of(
      picture::nearest_shares(wanted, profile.filaments.colours(), profile.printer.feeders, 0, steps).shares);
}

std::string in_words(const ColourMixture& mixture, picture::Colour wanted) {
  const std::string shares = gcode::shares_text(gcode::Mixture(mixture.shares));
  const std::string made = picture::hex_of(mixture.made), asked = picture::hex_of(wanted);
  const std::string found =
      mixture.difference > too_far
          ? fmt::format("these filaments cannot make {}; the nearest that they make is {}", asked, made)
          : fmt::format("{} becomes {}", asked, made);
  return fmt::format("{} with {}, which is {} (ΔE {:.1f})", found, shares,
                     picture::in_words(mixture.difference), mixture.difference);
}

}  // namespace unicursal::host
