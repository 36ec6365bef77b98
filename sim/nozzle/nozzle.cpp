#include "sim/nozzle/nozzle.hpp"

#include <numbers>

namespace unicursal::sim {

namespace {

bool moves_in_plane(const ExecutedMove& move) {
  return move.from.x != move.to.x || move.from.y != move.to.y;
}

}  // namespace

Nozzle::Nozzle(double filament_diameter, BedSink& bed)
    : filament_area_(std::numbers::pi * filament_diameter * filament_diameter / 4), bed_(bed) {}

void Nozzle::moved(const ExecutedMove& move) {
  if (lays_bead(move)) {
    bed_.laid({move.from, move.to, move.filament * filament_area_, shares_of(move.mix.factors), move.start,
               move.end});
  } else if (moves_in_plane(move)) {
    bed_.travelled(move.from, move.to);
  }
}

}  // namespace unicursal::sim
