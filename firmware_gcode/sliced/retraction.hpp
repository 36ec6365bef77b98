// How far the filament is drawn back, as the file counts it and as it really is: a file with several
// extruders counts for each tool, while one mixing nozzle has one filament path. mm of filament.
#pragma once

#include <map>

namespace unicursal::gcode {

class Retraction {
 public:
  /// The file feeds `filament`, or draws it back if it is negative; `alone`: the nozzle stands still
  /// meanwhile. Returns what is fed beyond what was drawn back.
  double take(double filament, bool alone);
  void change_tool(int tool);

  /// Nothing is drawn back any more.
  void forget() { drawn_ = 0; }
  /// How far the file takes it to be drawn back now. The nozzle has to follow.
  double drawn() const { return drawn_; }

 private:
  double drawn_ = 0;
  int tool_ = 0;
  bool new_tool_ = false;         ///< this tool has not fed since it came
  double before_ = 0;             ///< `drawn_` of the tool before
  std::map<int, double> others_;  ///< by tool
};

}  // namespace unicursal::gcode
