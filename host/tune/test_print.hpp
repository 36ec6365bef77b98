// A print that measures something about a printer, and its G-code: on each layer first marks, which are open
// lines for people and cameras, then one bead without a break, whose mixture changes. mm, mm³, mm³/s, in the
// frame of the bed.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/geometry/polygon.hpp"
#include "firmware_gcode/print/mixture.hpp"
#include "firmware_gcode/print/printer.hpp"
#include "host/engine/source.hpp"

namespace unicursal::host {

struct TestMove {
  core::Vec2 to{0, 0};
  double volume = 0;
  std::size_t mixture = 0;  ///< of TestPrint::mixtures
};

struct TestBead {
  core::Vec2 start{0, 0};
  std::vector<TestMove> moves;
};

struct TestLayer {
  std::vector<TestBead> purge;  ///< laid first
  std::vector<std::vector<core::Vec2>> marks;
  std::vector<TestBead> beads;
};

struct TestPrint {
  std::string title;  ///< a comment
  std::string name;   ///< in messages, such as "the strip"
  double layer_height = 0;
  double line_width = 0;  ///< of the marks
  double flow = 2;        ///< or less, if the hot end melts less
  /// Each as the firmware will deliver it. Where the firmware has too few virtual tools, they are defined
  /// again and again; mixtures that follow each other should then have neighbouring numbers.
  std::vector<gcode::Mixture> mixtures;
  std::size_t marks_mixture = 0;
  std::vector<TestLayer> layers;
};

/// One chunk for each layer. Throws core::DataError if the printer's profile is invalid.
FinishedPrint gcode_of(const TestPrint& print, const gcode::Printer& printer);

/// The mixture that is delivered if a feeder is asked for alone: the others keep their floor share.
gcode::Mixture feeder_alone(std::size_t feeder, const gcode::Printer& printer);

}  // namespace unicursal::host
