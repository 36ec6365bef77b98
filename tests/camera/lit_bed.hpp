// The bed with a print on it in the light of a lamp, as a picture from above in several sizes. Beads are
// round: the side that faces the lamp is brighter, the other darker, and their ridges shine. mm, linear
// light.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/camera/bed_surface.hpp"
#include "tests/camera/pigments.hpp"
#include "tests/camera/printed_layer.hpp"

namespace unicursal::camera {

/// Names of pigments: of the first and the second feeder, and of all others.
struct FilamentPair {
  std::string from, to, others = "white";
};

struct Lamp {
  double towards = 0.8;    ///< direction of the lamp, seen from the bed, radians from the x axis
  double elevation = 0.9;  ///< radians above the bed
  double gloss = 0.25;     ///< brightness of a ridge that mirrors the lamp
};

class LitBed {
 public:
  /// `visible`: around all that the photo shows.
  LitBed(const PrintedLayer& layer, const FilamentPair& pair, Bed bed, const Lamp& lamp,
         const std::array<double, 3>& towards_camera, const Rectangle& visible);

  /// The mean light around a place, over about `size` mm.
  Rgb at(double x, double y, double size) const;

 private:
  friend class Painter;

  /// A picture whose pixels are `pixel` mm wide.
  struct Level {
    double left = 0, bottom = 0, pixel = 0;
    std::size_t columns = 0, rows = 0;
    std::vector<std::array<std::uint16_t, 4>> light;  ///< red, green, blue × `unit`, and one that is unused

    bool holds(double x, double y) const;
    Rgb at(double x, double y) const;
  };
  using Levels = std::vector<Level>;

  static constexpr float unit = 32768;

  static Level level(const Rectangle& place, double pixel);
  static void add_halves(Levels& levels);
  static const Level& nearest(const Levels& levels, double size);

  Levels near_, around_;  ///< of the print, and of its surroundings
};

}  // namespace unicursal::camera
