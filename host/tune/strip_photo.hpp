// Reads a strip from a photo of it. The photo itself holds all that it is compared with: pure places of both
// mixtures and the reference lines give the colours, so that the white balance does not matter; the round
// marks, the ticks and all pure places show how the light falls.
#pragma once

#include <filesystem>

#include "host/photo/sheet.hpp"
#include "host/tune/curve_fit.hpp"
#include "host/tune/strip.hpp"

namespace unicursal::host {

/// What a photo of the strip shows, and where.
SheetPlan sheet_plan(const Strip& strip);

struct StripCurve {
  std::vector<CurvePoint> points;  ///< along the whole bead
  std::vector<MixtureSwitch> switches;
  ReferenceColours references;
};

/// Throws core::DataError if the sheet is another strip than this one, or if its colours are too alike or too
/// bright to be read. `file` is for messages.
StripCurve read_curve(const Sheet& sheet, const Strip& strip, const std::filesystem::path& file);

}  // namespace unicursal::host
