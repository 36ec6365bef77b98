// Writes every bead as it is laid, one on each line: start and end in printer seconds, x y z where it begins
// and where it ends, its volume, and the shares of the feeders in it. mm, mm³, s.
#pragma once

#include <cstddef>
#include <ostream>

#include "sim/nozzle/nozzle.hpp"

namespace unicursal::sim {

class BeadLog : public BedSink {
 public:
  /// Passes everything on to `next`.
  BeadLog(std::ostream& file, std::size_t feeders, BedSink& next)
      : file_(file), feeders_(feeders), next_(next) {}

  void laid(const Bead& bead) override;
  void travelled(const Position& from, const Position& to) override { next_.travelled(from, to); }

 private:
  std::ostream& file_;
  std::size_t feeders_;
  BedSink& next_;
};

}  // namespace unicursal::sim
