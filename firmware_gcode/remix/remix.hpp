// Any slicer's file through the mixing nozzle: every tool of the file becomes a mixture, and the feeders
// switch ahead of the place where the slicer changes the tool, since the chamber answers late. A change that
// has room falls where it is not seen: into infill, supports, the skirt. mm, mm³.
//
// The geometry stays as the file has it: every vertex, in order, at its speed. A move is split where a switch
// falls inside it; arcs become chords. Positions are absolute in the output, and extrusion is relative. A
// streaming transducer as the Encoder is (toolpath/encoder.hpp): lines are withheld until the mixture of
// their plastic is certain. Memory does not grow with the file. The same file gives the same chunks.
//
//   std::ifstream file("part.gcode", std::ios::binary);
//   Remix remix(file, "part.gcode", printer, survey, settings);
//   use(remix.start());
//   while (auto chunk = remix.next()) use(*chunk);
//   use(remix.finish(false));
#pragma once

#include <cstddef>
#include <istream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "firmware_gcode/print/chunk.hpp"
#include "firmware_gcode/print/printer.hpp"
#include "firmware_gcode/remix/settings.hpp"
#include "firmware_gcode/sliced/feature.hpp"
#include "firmware_gcode/sliced/survey.hpp"

namespace unicursal::gcode {

/// A bead as the file wants it.
struct WantedStroke {
  core::Vec2 from{0, 0}, to{0, 0};
  double width = 0;
  double volume = 0;
  std::size_t material = 0;  ///< index into RemixSettings::materials
  Feature feature = Feature::unknown;
};

/// What a layer is to become.
struct WantedLayer {
  std::size_t index = 0;
  double top = 0;  ///< z of the nozzle
  double height = 0;
  std::vector<WantedStroke> strokes;
};

/// How the plastic that is seen comes out, by the model of the chamber. mm³.
struct SeenMixing {
  double volume = 0;     ///< that is seen
  double misplaced = 0;  ///< of it, in the wrong mixture
  double wrong = 0;      ///< of it, nearer to another material of the file
  double hidden = 0;     ///< misplaced where it is not seen
};

class Remix {
 public:
  /// `file` is read from its beginning and must outlive this object. Throws core::DataError.
  Remix(std::istream& file, const std::string& name, const Printer& printer, const SlicedSurvey& survey,
        const RemixSettings& settings);
  ~Remix();
  Remix(Remix&&) noexcept;

  /// Watchdog, mixtures, and the file's own lines up to its first layer. Once, before anything else.
  Chunk start();
  /// The next lines that have become certain: a layer or a part of one. Layers begin with comments as those
  /// of the encoder do (";LAYER_CHANGE", ";Z:", ";HEIGHT:"). nullopt after the last bead. Throws
  /// core::DataError if the file has changed since the survey.
  std::optional<Chunk> next();
  /// The end of the print. `stopped` false: the file's own end, after the last chunk. Else the print was
  /// ended somewhere in what was given: the nozzle rises above all of it and moves away. Both end with
  /// heaters, fan and motors off. Once, after start().
  Chunk finish(bool stopped);

  /// The mixture that will be delivered for a material, after floor share and rounding.
  Mixture intended(std::size_t material) const;
  /// The layers whose lines all are in chunks since the last call, in order. Only if listen() was called.
  void listen();
  std::vector<WantedLayer> wanted();
  SeenMixing seen() const;
  /// mm³ of the wipe tower that was left out.
  double left_out() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace unicursal::gcode
