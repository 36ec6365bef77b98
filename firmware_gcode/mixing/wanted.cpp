#include "firmware_gcode/mixing/wanted.hpp"

#include <algorithm>

namespace unicursal::gcode {

double WantedRun::part_at(double volume) const {
  if (parts.empty()) return 0;
  const auto found = std::lower_bound(parts.begin(), parts.end(), volume,
                                      [](const auto& entry, double v) { return entry.first < v; });
  return found == parts.end() ? parts.back().second : found->second;
}

void WantedRuns::add(const WantedBead& piece) {
  if (piece.volume <= 0) return;
  const bool same = !runs_.empty() && runs_.back().material == piece.material &&
                    runs_.back().weight == piece.weight && runs_.back().layer == piece.layer;
  if (!same) {
    runs_.push_back({end_,
                     end_,
                     piece.material,
                     piece.weight,
                     piece.takes_changes,
                     piece.layer,
                     piece.layer_materials,
                     {}});
  }
  end_ += piece.volume;
  WantedRun& run = runs_.back();
  run.end = end_;
  if (palette_.is_gradient(piece.material)) run.parts.push_back({end_, piece.part});
}

void WantedRuns::forget_before(std::size_t index) {
  while (first_ < index && !runs_.empty()) runs_.pop_front(), ++first_;
}

Shares WantedRuns::shares(const WantedRun& run, double volume) const {
  if (!palette_.is_gradient(run.material)) return palette_.mixture(Shade{run.material, 0}).shares();
  return palette_.mixture(run.material, run.part_at(volume)).shares();
}

Mismatch mismatch(const Palette& palette, const WantedRun& run, const Shares& wanted, const Shares& arrived) {
  Mismatch result{misplaced(arrived, wanted), false};
  if (!run.layer_materials || palette.is_gradient(run.material)) return result;
  const double own = squared_distance(arrived, wanted);
  result.wrong =
      std::any_of(run.layer_materials->begin(), run.layer_materials->end(), [&](std::size_t rival) {
        return rival != run.material && !palette.is_gradient(rival) &&
               squared_distance(arrived, palette.mixture(Shade{rival, 0}).shares()) < own;
      });
  return result;
}

}  // namespace unicursal::gcode
