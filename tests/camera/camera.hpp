// Takes photos of simulated prints, as a phone takes them: from any side and slant, through a lens that
// distorts and blurs, in uneven and coloured light with reflections, with noise and the phone's own idea of
// contrast. Independent of the code that reads photos (host/photo), so that a mistake there cannot hide here.
//
//   const camera::PrintedLayer print = camera::read_layer("strip.rasters");
//   const camera::Conditions& slanted = camera::conditions()[3];
//   camera::write_photo("strip.jpg", camera::take_photo(print, {"blue", "red"}, slanted), slanted.quality);
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/camera/lit_bed.hpp"
#include "tests/camera/photo.hpp"
#include "tests/camera/pinhole.hpp"
#include "tests/camera/printed_layer.hpp"

namespace unicursal::camera {

/// Pixels of the photo.
struct Blur {
  double defocus = 0;           ///< standard deviation
  double motion = 0;            ///< way of the camera while it exposed
  double motion_towards = 0.5;  ///< radians
};

/// A soft white reflection. Position in shares of the print's rectangle, from its front left corner.
struct Glare {
  double x = 0, y = 0;
  double radius = 6;  ///< mm
  double light = 0.5;
};

struct Light {
  double falloff = 1;        ///< least ÷ greatest light on the print
  double slope_towards = 0;  ///< where a part of the light comes from, radians
  Place spot = {0.3, 0.6};   ///< of a lamp, in shares of the print's rectangle
  double spot_radius = 60;   ///< mm
  Rgb spot_tint = {1, 1, 1};
  Rgb gains = {1, 1, 1};   ///< a wrong white balance
  double exposure = 0.95;  ///< white in the brightest place; above 1 it is clipped
  std::vector<Glare> glares;
};

struct Sensor {
  double electrons = 6000;  ///< of white; fewer give more shot noise
  double read_noise = 0.001;
  double sharpening = 0;  ///< overshoot at edges, 0 to 1
  double contrast = 0.3;  ///< of the S-curve after that of sRGB, 0 to 1
};

struct Conditions {
  std::string name;
  std::size_t width = 4000, height = 3000;
  Bed bed = Bed::dark;
  Lamp lamp;
  View view;
  Blur blur;
  Light light;
  Sensor sensor;
  int quality = 90, orientation = 1;
  std::uint32_t seed = 1;
  bool bare = false;  ///< without the print
};

/// The upright photo. Deterministic. The print fills the frame as the view says, also if it is left out.
Photo take_photo(const PrintedLayer& layer, const FilamentPair& pair, const Conditions& conditions);

/// The pinhole of that photo.
Pinhole pinhole(const PrintedLayer& layer, const Conditions& conditions);

/// A bed on which the first filament stands out: that of the conditions, or another.
Bed contrasting_bed(const PrintedLayer& layer, const FilamentPair& pair, Bed wanted);

/// Ten that can be read, from easy to hard.
std::vector<Conditions> conditions();

/// Some that cannot be read.
std::vector<Conditions> unreadable_conditions();
/// Some that a reader may read or refuse.
std::vector<Conditions> doubtful_conditions();

/// Easily distinguished.
std::vector<FilamentPair> filament_pairs();
/// The first can hardly be seen in the second: the end of a change may be beyond reading.
FilamentPair lopsided_pair();
/// Too similar to be read.
FilamentPair similar_pair();

}  // namespace unicursal::camera
