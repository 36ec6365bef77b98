// The first half of the remix: what a slicer's file lays, where it goes meanwhile, and what it says, with the
// parts left out that a mixing nozzle does not print: the loading and unloading of filament in a wipe tower,
// and the tower itself if that is asked for. mm, mm/min, mm³.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <istream>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "firmware_gcode/print/printer.hpp"
#include "firmware_gcode/remix/settings.hpp"
#include "firmware_gcode/sliced/reader.hpp"
#include "firmware_gcode/sliced/retraction.hpp"
#include "firmware_gcode/sliced/step.hpp"
#include "firmware_gcode/sliced/survey.hpp"

namespace unicursal::gcode {

/// A command that is sent as it is, or a comment.
struct Text {
  std::string line;
};
struct LayerMark {
  std::size_t index = 0;
  std::optional<double> top;  ///< absent until the layer's first bead was read
  double height = 0;
};
/// Motion and filament together; either may be absent.
struct Go {
  Place from, to;
  double feed = 0;
  double fed = 0;                ///< mm³ that come out of the nozzle
  double other = 0;              ///< mm of filament that are drawn back (negative) or pushed forward again
  double width = 0, height = 0;  ///< of the bead, as far as the file says; else 0
  std::size_t material = 0;
  Feature feature = Feature::unknown;
};
using Entry = std::variant<Text, LayerMark, Go>;

class Entries {
 public:
  /// Called for every piece of plastic, in order.
  using Want = std::function<void(const Go& go, std::size_t layer)>;

  /// As for Remix; all must outlive this object.
  Entries(std::istream& file, const std::string& name, const Printer& printer, const SlicedSurvey& survey,
          const RemixSettings& settings, Want want);

  /// Reads a step; to be called until complete(). Throws core::DataError.
  void read();
  /// All beads were read, and all that precedes them.
  bool complete() const { return complete_; }
  /// What was read and is not taken yet.
  std::deque<Entry>& queue() { return queue_; }
  /// What follows the last bead. To be called once, when complete.
  std::vector<SlicedStep> rest();
  double left_out() const { return left_out_; }

 private:
  void take(const SlicedMove& step);
  void take(const SlicedToolChange& step);
  void take(const SlicedLayer& step);
  void take(const SlicedPass& step);
  void take(const SlicedRemark& step);
  bool leaves_out(const SlicedMove& step);
  void hold(Entry entry);
  void release();
  void come_back(const SlicedMove& step);
  void draw(double length, double feed);
  void note_layer(std::optional<double> top, double height);
  std::size_t material_of(const SlicedMove& step) const;
  void look_whether_to_stop();

  const std::string name_;
  const Printer& printer_;
  const SlicedSurvey& survey_;
  const RemixSettings& settings_;
  const Want want_;
  const double filament_area_;  ///< mm²
  SlicedReader reader_;
  std::deque<Entry> queue_;
  std::vector<Entry>
      held_;  ///< travels that may lead to a tower that is left out, and what stands between them
  Retraction retraction_;
  double drawn_ = 0;     ///< mm of filament that are really drawn back, when the queue is carried out
  Place planned_{};      ///< the nozzle's place then
  bool away_ = false;    ///< the file's nozzle is elsewhere, in a part of the file that is left out
  bool rammed_ = false;  ///< filament was unloaded or loaded there
  int tool_ = 0;
  std::size_t layer_ = 0;
  double last_top_ = 0;
  bool layer_noted_ = true;  ///< the last layer's height is known
  bool complete_ = false;
  std::uint64_t looked_ = 0;
  double left_out_ = 0;
};

}  // namespace unicursal::gcode
