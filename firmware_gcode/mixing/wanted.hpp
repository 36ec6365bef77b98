// The materials that are wanted along the path, by volume: the input of schedule and forecast, kept as long
// as they need it. mm³.
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <vector>

#include "firmware_gcode/mixing/chamber.hpp"
#include "firmware_gcode/mixing/palette.hpp"

namespace unicursal::gcode {

/// The indices of all materials of a layer: those for which a place of the layer can be mistaken.
using LayerMaterials = std::shared_ptr<const std::vector<std::size_t>>;

/// A bead as the mixing schedule sees it.
struct WantedBead {
  double volume = 0;
  std::size_t material = 0;
  double part = 0;             ///< position along a gradient, 0…1
  double weight = 1;           ///< how much a wrong mixture matters; small for the prime line
  bool takes_changes = false;  ///< lies in a transition zone
  std::size_t layer = 0;
  LayerMaterials layer_materials;
};

/// Consecutive beads of one material, weight and layer.
struct WantedRun {
  double begin = 0, end = 0;  ///< mm³ since the beginning of the print
  std::size_t material = 0;
  double weight = 1;
  bool takes_changes = false;
  std::size_t layer = 0;
  LayerMaterials layer_materials;
  std::vector<std::pair<double, double>> parts;  ///< of a gradient: end volume and position along it

  double volume() const { return end - begin; }
  /// The position along the gradient; clamped to the run.
  double part_at(double volume) const;
};

/// The runs of a print in their order; old ones are forgotten.
class WantedRuns {
 public:
  explicit WantedRuns(const Palette& palette) : palette_(palette) {}

  void add(const WantedBead& piece);
  /// The volume up to which the runs are known.
  double end() const { return end_; }
  std::size_t first() const { return first_; }
  std::size_t past() const { return first_ + runs_.size(); }
  /// Runs are counted from the beginning of the print. Precondition: first() <= index < past().
  const WantedRun& run(std::size_t index) const { return runs_[index - first_]; }
  void forget_before(std::size_t index);

  /// The wanted shares. Precondition: the volume lies within the run.
  Shares shares(const WantedRun& run, double volume) const;

 private:
  const Palette& palette_;
  std::deque<WantedRun> runs_;
  std::size_t first_ = 0;
  double end_ = 0;
};

/// How far the outflow differs from the wanted mixture.
struct Mismatch {
  double misplaced = 0;  ///< fraction, 0…1
  bool wrong = false;    ///< it is nearer to another material of the layer
};

Mismatch mismatch(const Palette& palette, const WantedRun& run, const Shares& wanted, const Shares& arrived);

}  // namespace unicursal::gcode
