// One layer as the simulator laid it against the zones that it was to fill. Places are the raster's pixels
// whose middle lies in the part; where the simulator's raster does not reach, nothing was laid. mm, mm².
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/picture/image.hpp"
#include "firmware_gcode/mixing/palette.hpp"
#include "host/report/deposit_findings.hpp"
#include "host/report/scan.hpp"
#include "sim/bed/raster.hpp"

namespace unicursal::host {

/// What a material is to come out as.
struct IntendedMaterial {
  gcode::Mixture mixture;  ///< of a gradient, where it begins
  std::optional<gcode::Gradient> gradient = {};
  bool transition = false;  ///< it is there to take up changes: nothing is wrong in it

  IntendedMaterial(const gcode::Mixture& plain) : mixture(plain) {}

  /// The shares that are wanted there.
  std::array<double, gcode::max_feeders> at(const core::Vec2& place, double z) const;
};

/// A straight piece of bead.
struct Stroke {
  core::Vec2 from{0, 0}, to{0, 0};
  double width = 0;
};

/// What a layer was to be, in the bed's frame.
struct TargetLayer {
  std::size_t index = 0;
  double top = 0;  ///< where the nozzle runs
  double height = 0;
  std::vector<LabelledPolygon> zones;          ///< labelled by material
  double bead_width = 0;                       ///< of the job; the rim of the part is half as wide
  std::vector<Stroke> prime = {}, skirt = {};  ///< that are to lie beside the part
};

/// Gives the simulator's rows from the lowest up.
using RowSource = std::function<void(std::span<sim::RasterPixel>)>;

struct JudgedLayer {
  DepositFindings findings;
  std::optional<picture::Image> gaps;      ///< what is missing and what is too much
  std::optional<picture::Image> mixtures;  ///< the right ones in their colours, the wrong ones marked
};

/// `materials`: as the printer was to mix them. A place of a gradient is wrong where a tenth of its plastic
/// or more is misplaced, any other where what arrived is nearer to another material of the layer. Reads every
/// row.
JudgedLayer judge(const TargetLayer& target, const sim::RasterFrame& frame, const RowSource& rows,
                  const std::vector<IntendedMaterial>& materials, bool draw);

}  // namespace unicursal::host
