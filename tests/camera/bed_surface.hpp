// The beds on which photos of prints are taken, and the table around them. mm, in the frame of the bed.
#pragma once

#include "tests/camera/pigments.hpp"

namespace unicursal::camera {

enum class Bed {
  glass,  ///< dark glass with a printed grid of 10 mm
  pei,    ///< amber sheet with fine grain
  gold,   ///< powder-coated steel, coarse grain
  tape,   ///< strips of blue tape with seams
  dark,   ///< matt black
  light,  ///< a grey white plate
};

/// A place of the bed: between two reflectances, and how bright compared with them.
struct BedPlace {
  double second = 0;      ///< share of the second, 0 to 1
  double brightness = 1;  ///< grain
};

struct BedColours {
  Spectrum first{}, second{};
};

BedColours colours_of(Bed bed);
BedPlace bed_at(Bed bed, double x, double y);

/// What lies around the bed.
Rgb table_at(double x, double y);

}  // namespace unicursal::camera
