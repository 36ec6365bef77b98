// Reads a chart from a photo of it. The filaments alone are references: their colours are known, so that what
// the camera makes of them shows its white balance and exposure, how steep its contrast is, and how the light
// falls across the chart.
#pragma once

#include <filesystem>
#include <vector>

#include "host/photo/sheet.hpp"
#include "host/tune/chart.hpp"
#include "host/tune/chart_fit.hpp"
#include "host/tune/measured_colours.hpp"

namespace unicursal::host {

/// What a photo of the chart shows, and where.
SheetPlan sheet_plan(const Chart& chart);

/// The light of the patches, in even light but as the camera shows it. Patches that are too bright for the
/// camera are left out. Throws core::DataError if both patches of a filament are.
std::vector<SeenPatch> read_chart(const Sheet& sheet, const Chart& chart, const std::filesystem::path& file);

/// Fits how the filaments mix; the colours of the filaments alone are those of the profile. Throws
/// core::DataError as fit_chart().
ChartFit fit_photo(const Chart& chart, const Filaments& filaments, const std::vector<SeenPatch>& seen);

}  // namespace unicursal::host
