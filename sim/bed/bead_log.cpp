#include "sim/bed/bead_log.hpp"

#include <fmt/format.h>

namespace unicursal::sim {

void BeadLog::laid(const Bead& bead) {
  next_.laid(bead);
  file_ << fmt::format("{:.4f} {:.4f} {:.4f} {:.4f} {:.4f} {:.4f} {:.4f} {:.4f} {:.6f}", bead.start, bead.end,
                       bead.from.x, bead.from.y, bead.from.z, bead.to.x, bead.to.y, bead.to.z, bead.volume);
  for (std::size_t f = 0; f < feeders_; ++f) file_ << fmt::format(" {:.5f}", bead.shares[f]);
  file_ << '\n';
}

}  // namespace unicursal::sim
