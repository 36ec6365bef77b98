// Two maps of a layer as laid. Gaps: pale where the layer is just full, blue to black where plastic is
// missing, orange to red where it stands too high, grey stripes of nothing outside. Mixtures: what arrived in
// its own colour, paler where it is right; what is nearer to another zone's mixture is marked with a hatch of
// magenta; the borders between material zones are dark lines.
#pragma once

#include <vector>

#include "core/picture/filaments.hpp"
#include "core/picture/image.hpp"
#include "host/report/picture_place.hpp"
#include "host/report/scan.hpp"
#include "sim/bed/raster.hpp"

namespace unicursal::host {

struct DepositView {
  const PixelGrid& grid;
  const std::vector<RegionLabel>& labels;  ///< by material
  const std::vector<sim::RasterPixel>& pixels;
  const std::vector<bool>& wrong;
  const picture::Filaments& filaments;
};

/// Of both pictures.
PicturePlace place_of(const PixelGrid& grid);

picture::Image draw_gaps(const DepositView& view);
picture::Image draw_mixtures(const DepositView& view);

}  // namespace unicursal::host
