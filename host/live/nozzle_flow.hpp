// What leaves the nozzle, and in which mixture, while the feeders push: retractions, dead volume and tanks by
// the model of the profile's chamber (firmware_gcode/mixing/chamber.hpp). Filament that was drawn back leaves
// a void in its inlet, which is filled again before anything comes out. Departures: no oozing, no pressure;
// at the beginning the chamber is full of equal shares. mm³.
//
// It can be copied: the copy goes on from the same state.
#pragma once

#include <functional>

#include "firmware_gcode/print/printer.hpp"
#include "firmware_gcode/remix/outflow.hpp"

namespace unicursal::host {

class NozzleFlow {
 public:
  explicit NozzleFlow(const gcode::Printer& printer);

  using Leaves = std::function<void(double volume, const gcode::Shares& shares)>;
  /// The feeders push `volume` of these shares, or draw it back if it is negative. `leaves` gets what comes
  /// out meanwhile, in order, in pieces so short that their mixture hardly changes.
  void feed(const gcode::Shares& shares, double volume, const Leaves& leaves);

 private:
  void fill_and_feed(const gcode::Shares& shares, double volume, const Leaves& leaves);

  gcode::Outflow outflow_;
  gcode::PerFeeder voids_;
  bool drawn_ = false;  ///< a void is open
};

}  // namespace unicursal::host
