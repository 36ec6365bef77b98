// From the colours of a chart's patches to how the filaments mix, and to the keys of a profile that keep it.
#pragma once

#include <vector>

#include "core/picture/fit_filaments.hpp"
#include "host/job/filament.hpp"
#include "host/job/profile_edit.hpp"
#include "host/tune/chart.hpp"
#include "host/tune/measured_colours.hpp"

namespace unicursal::host {

struct FittedPatch {
  std::size_t patch = 0;  ///< counted from 0
  picture::Colour foretold, seen;
  double before = 0, after = 0;  ///< what was foretold and what is now, from what was seen, ΔE2000
  bool stands_out = false;       ///< nothing explains it
};

struct ChartFit {
  Filaments filaments;  ///< the profile's, with what was found
  std::vector<FittedPatch> patches;
  double before = 0, after = 0;  ///< medians
};

/// Throws core::DataError if patches are missing, if two patches of one filament differ, or if no filaments
/// mix like this.
ChartFit fit_chart(const Chart& chart, const Filaments& filaments, const std::vector<SeenPatch>& seen,
                   picture::PureColours colours);

/// What a profile with [[filament]] has to say instead.
std::vector<ProfileChange> colour_changes(const Filaments& before, const Filaments& after);

}  // namespace unicursal::host
