// Reads a slicer's file step by step, and refuses what would break a print: motion outside the bed, heat
// beyond the limits, cold extrusion, settings written into the printer, waits for a person who may not be
// there. All modes of the file (units, relative positions, absolute extrusion, offsets) are resolved; arcs
// become chords; the firmware's own retraction (G10, G11) becomes the profile's. mm, mm/min, °C.
//
// Departure: G90 does not change how E counts after M82 or M83, as Marlin 1.1 and Repetier have it and
// slicers mean it; in Marlin 2 it does.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <istream>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "firmware_gcode/print/mixture.hpp"
#include "firmware_gcode/print/printer.hpp"
#include "firmware_gcode/sliced/commands.hpp"
#include "firmware_gcode/sliced/comments.hpp"
#include "firmware_gcode/sliced/limits.hpp"
#include "firmware_gcode/sliced/line_source.hpp"
#include "firmware_gcode/sliced/rates.hpp"
#include "firmware_gcode/sliced/step.hpp"

namespace unicursal::gcode {

class SlicedReader {
 public:
  /// `file` must outlive this object. `marked`: comments mark the layers, also where none has come yet.
  SlicedReader(std::istream& file, std::string name, const Printer& printer, const SlicedLimits& limits,
               bool marked = false);

  /// nullopt at the end of the file. Throws core::DataError.
  std::optional<SlicedStep> next();

  /// Comments mark the layers.
  bool marked() const { return marked_; }
  /// They do, and layers were begun before by their height: the file has to be read again with `marked`.
  bool marked_late() const { return marked_late_; }
  /// Whether next() has to read a line.
  bool nothing_pending() const { return steps_.empty(); }
  const CommentState& comments() const { return comments_; }
  /// Lines and bytes that were read.
  std::uint64_t lines() const { return source_.number(); }
  std::uint64_t bytes() const { return source_.bytes(); }
  double hottest_nozzle() const { return hottest_nozzle_; }
  double hottest_bed() const { return hottest_bed_; }
  /// The shares that the file itself gives to a tool (M163, M165, M567), by the tool's number in the steps.
  const std::map<int, Mixture>& own_mixtures() const { return own_mixtures_; }
  /// The colour that a planned change of filament gives to a tool, by the tool's number in the steps.
  const std::map<int, std::string>& own_colours() const { return own_colours_; }
  /// What was left out or is strange, one sentence each.
  std::vector<std::string> notes() const;

 private:
  void read(std::string_view line);
  void comment(std::string_view text);
  void command(const SlicedCommand& command);
  void motion(const SlicedCommand& command);
  void arc(const SlicedCommand& command, const Place& to, double filament, bool clockwise);
  void move(const Place& to, double filament);
  void relative_from_nowhere(const SlicedCommand& command, double filament);
  void retract_by_firmware(bool back);
  double filament_of(const SlicedCommand& command);
  Place target_of(const SlicedCommand& command) const;
  void set_mode(const SlicedCommand& command);
  void set_position(const SlicedCommand& command);
  void home(const SlicedCommand& command);
  void heat(const SlicedCommand& command);
  void wait_for_person(const SlicedCommand& command);
  void mixture(const SlicedCommand& command);
  void change_tool(const SlicedCommand& command);
  void enter_tool(int tool);
  void change_colour();
  void pass(std::string text);
  void check_inside(const Place& place) const;
  void check_warm() const;
  void check_homed() const;
  void wait_for_heat();
  void begin_layer_by_height(double z);
  void begin_layer();
  void note(const std::string& key, const std::string& sentence);
  [[noreturn]] void refuse(const std::string& problem, const std::string& remedy) const;
  double unit(double value) const { return inches_ ? value * 25.4 : value; }

  LineSource source_;
  std::string name_;
  Printer printer_;
  SlicedLimits limits_;
  CommentState comments_;
  std::deque<SlicedStep> steps_;  ///< read, and not given yet
  Place at_{};
  std::array<double, 3> offset_{};  ///< native minus logical position (G92)
  double e_ = 0;                    ///< the file's E
  double feed_ = 0;
  Rates rates_;
  bool inches_ = false, relative_ = false, relative_filament_ = false;
  bool drawn_by_firmware_ = false;
  int tool_ = 0;          ///< the file's number
  int mixture_tool_ = 0;  ///< the number in the steps
  std::array<bool, 3> homed_{};
  bool waited_ = true;  ///< for the nozzle's heat
  std::string macro_;   ///< the first word that was left out; it may have homed and heated
  double nozzle_ = 0, bed_ = 0, hottest_nozzle_ = 0, hottest_bed_ = 0;
  bool laid_ = false;
  bool marked_late_ = false;
  bool marked_ = false;  ///< comments mark the layers
  std::size_t layers_ = 0;
  double layer_z_ = 0;
  std::array<std::optional<double>, most_feeders> collected_{};  ///< M163 since the last M164
  std::map<int, int> numbers_;                                   ///< of tools whose mixture the file gives
  std::map<int, Mixture> own_mixtures_;
  std::map<int, std::string> own_colours_;
  bool changes_colour_ = false;  ///< the wait for new filament that follows is not needed
  struct Noted {
    std::uint64_t line = 0, count = 0;
    std::string sentence;
  };
  std::map<std::string, Noted> noted_;  ///< by kind
};

}  // namespace unicursal::gcode
