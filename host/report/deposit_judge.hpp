// Compares one layer as the simulator laid it with the zones that it was to fill, at every pixel of the
// raster whose middle lies in the part. Nothing was laid where the raster does not reach. mm, mm².
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/picture/filaments.hpp"
#include "core/picture/image.hpp"
#include "firmware_gcode/mixing/palette.hpp"
#include "host/report/deposit_findings.hpp"
#include "host/report/picture_place.hpp"
#include "host/report/scan.hpp"
#include "host/report/worst_places.hpp"
#include "sim/bed/raster.hpp"

namespace unicursal::host {

/// The mixture that a material should have.
struct IntendedMaterial {
  gcode::Mixture mixture;  ///< of a gradient, where it begins
  std::optional<gcode::Gradient> gradient = {};
  bool transition = false;  ///< a transition zone: no mixture is wrong in it

  IntendedMaterial(const gcode::Mixture& plain) : mixture(plain) {}

  /// The shares that are wanted at a place.
  gcode::Shares at(const core::Vec2& place, double z) const;
};

/// A straight piece of bead.
struct Stroke {
  core::Vec2 from{0, 0}, to{0, 0};
  double width = 0;
};

/// What a layer should look like, in the bed's frame.
struct TargetLayer {
  std::size_t index = 0;
  double top = 0;  ///< where the nozzle runs
  double height = 0;
  std::vector<LabelledPolygon> zones;          ///< labelled by material
  double bead_width = 0;                       ///< of the job; the rim of the part is half as wide
  std::vector<Stroke> prime = {}, skirt = {};  ///< beside the part
  bool by_beads = false;  ///< the zones are single beads; distances from their borders mean nothing
};

/// Reads the next of the simulator's rows, the lowest first.
using RowSource = std::function<void(std::span<sim::RasterPixel>)>;

struct JudgedLayer {
  DepositFindings findings;
  std::vector<WorstPlace> worst;           ///< at most one of each kind
  std::optional<picture::Image> gaps;      ///< missing and surplus plastic
  std::optional<picture::Image> mixtures;  ///< in their colours, wrong ones hatched
  PicturePlace place;                      ///< of both pictures
};

/// `materials`: as the printer was to mix them. A place of a gradient is wrong if a tenth of its plastic or
/// more is misplaced; any other place is wrong if its mixture is nearer to another material of the layer.
/// Reads every row.
JudgedLayer judge(const TargetLayer& target, const sim::RasterFrame& frame, const RowSource& rows,
                  const std::vector<IntendedMaterial>& materials, bool draw,
                  const picture::Filaments& filaments = {});

}  // namespace unicursal::host
