// What leaves the nozzle while the feeders push: the chamber of mixing/chamber.hpp with its dead volume. mm³.
#pragma once

#include <deque>
#include <functional>

#include "firmware_gcode/mixing/chamber.hpp"

namespace unicursal::gcode {

class Outflow {
 public:
  /// The chamber is full of equal shares.
  Outflow(const ChamberModel& chamber, std::size_t feeders);

  /// Feeds `volume` of these shares; `leaves` gets what comes out meanwhile, in short pieces.
  void feed(const Shares& shares, double volume,
            const std::function<void(double volume, const Shares& shares)>& leaves);

 private:
  struct Plug {
    Shares shares;
    double volume;
  };

  double longest_;          ///< of a piece
  std::deque<Plug> plugs_;  ///< in the dead volume, the oldest first
  Tanks tanks_;
};

}  // namespace unicursal::gcode
