// A chart of mixtures, by whose colours a printer's filaments are measured: numbered squares in rows, of
// lines that go back and forth without a break. Each row is one band. Before each square the band has room in
// which the mixture changes: one and a half times the dead and the mixing volume. Rows go to and fro.
//
//   each feeder alone, twice; steps between every two feeders; even and uneven mixtures of three. The feeders
//   alone are references: both of one feeder lie far apart, half of the chart between them.
//
// Further layers repeat the first one. They hide the bed, which shines through a single layer. Six round
// marks (host/photo/marks.hpp) surround the chart. mm, mm³, in the frame of the bed.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/geometry/polygon.hpp"
#include "firmware_gcode/print/mixture.hpp"
#include "firmware_gcode/print/printer.hpp"
#include "host/photo/marks.hpp"
#include "host/tune/test_print.hpp"

namespace unicursal::host {

inline constexpr std::size_t most_patches = 28;
/// mm. The bed shines through thinner layers of white and yellow.
inline constexpr double usual_thickness = 0.8;

struct ChartPatch {
  gcode::Mixture mixture;             ///< as it is delivered
  std::optional<std::size_t> feeder;  ///< that is alone, except for the floor share of the others
  core::Box square;
  core::Box middle;  ///< where its colour is pure, and no edge is near
};

struct Chart {
  std::vector<ChartPatch> patches;  ///< in the order of printing; their numbers start from 1
  MarkPlaces marks;
  TestPrint print;
};

/// `marks`: the feeder of marks and numbers, which should stand out from the bed. `thickness`: of the patches
/// at least, mm. Throws core::DataError if the chart does not fit.
Chart make_chart(const gcode::Printer& printer, std::size_t marks, double thickness = usual_thickness);

}  // namespace unicursal::host
