// What is wanted along the path, by volume: the schedule's input, kept as far as it is still needed. mm³.
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <vector>

#include "firmware_gcode/mixing/chamber.hpp"
#include "firmware_gcode/mixing/palette.hpp"

namespace unicursal::gcode {

/// The materials of a layer: what a place can be mistaken for.
using LayerMaterials = std::shared_ptr<const std::vector<std::size_t>>;

/// A bead, as far as mixing is concerned.
struct WantedBead {
  double volume = 0;
  std::size_t material = 0;
  double part = 0;             ///< of a gradient: how far along, 0…1
  double weight = 1;           ///< how much a wrong mixture matters here; little where nobody looks
  bool takes_changes = false;  ///< lies in a zone that is there for it
  std::size_t layer = 0;
  LayerMaterials layer_materials;
};

/// Consecutive pieces of one material, weight and layer.
struct WantedRun {
  double begin = 0, end = 0;  ///< volumes from the beginning of the print
  std::size_t material = 0;
  double weight = 1;
  bool takes_changes = false;
  std::size_t layer = 0;
  LayerMaterials layer_materials;
  std::vector<std::pair<double, double>> parts;  ///< of a gradient: up to which volume, how far along

  double volume() const { return end - begin; }
  /// Clamped to the run.
  double part_at(double volume) const;
};

class WantedRuns {
 public:
  explicit WantedRuns(const Palette& palette) : palette_(palette) {}

  void add(const WantedBead& piece);
  /// Up to where it is known.
  double end() const { return end_; }
  std::size_t first() const { return first_; }
  std::size_t past() const { return first_ + runs_.size(); }
  /// Precondition: first() <= index < past(). Runs are counted from the beginning of the print.
  const WantedRun& run(std::size_t index) const { return runs_[index - first_]; }
  void forget_before(std::size_t index);

  /// What is wanted there. Precondition: within the run.
  Tanks::Shares shares(const WantedRun& run, double volume) const;

 private:
  const Palette& palette_;
  std::deque<WantedRun> runs_;
  std::size_t first_ = 0;
  double end_ = 0;
};

/// How what has arrived fits what is wanted.
struct Mismatch {
  double misplaced = 0;  ///< 0…1
  bool wrong = false;    ///< nearer to another material of the layer
};

Mismatch mismatch(const Palette& palette, const WantedRun& run, const Tanks::Shares& wanted,
                  const Tanks::Shares& arrived);

}  // namespace unicursal::gcode
