// Finds what would be printed in the air: islands with nothing below them, layers without any island between
// others, and steep overhangs. Lengths in mm, places in the part's frame.
//
// An overhang is steep where a strand at the edge of a layer would have less than half of its width on the
// layer below: at a bead width of 0.8 mm and layers of 0.3 mm, beyond 53° from the vertical. Bridges count.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/geometry/region.hpp"
#include "core/model/part.hpp"

namespace unicursal::core {

struct HangingPlace {
  enum class Kind {
    island,        ///< with nothing below it
    empty_layers,  ///< a run of layers without any island, before one that has some
    overhang,      ///< a run of layers of which each hangs over
  };
  Kind kind = Kind::island;
  std::size_t layer = 0;   ///< of an overhang, where most hangs over; else the first one
  std::size_t layers = 1;  ///< of the run
  double z = 0;            ///< the layer's underside
  Vec2 place{0, 0};        ///< of the island, or of the largest piece that hangs over
  double area = 0;         ///< mm² in the air
};

/// "island", "empty layers", "overhang"
const char* word(HangingPlace::Kind kind);

class HangingCheck {
 public:
  explicit HangingCheck(double bead_width) : bead_width_(bead_width) {}

  /// Takes the layers in order, from the first one on. A layer on the bed begins another part.
  void add(const Layer& layer);

  /// In the order of the layers, at most a thousand. Empty layers at the end do not count.
  const std::vector<HangingPlace>& places() const { return places_; }

  /// One sentence for each island and run of empty layers, and one for all overhangs; at most ten, and a last
  /// one counts those that were left out.
  std::vector<std::string> sentences() const;

 private:
  void begin_part();
  void keep(const HangingPlace& place);
  void look_for_overhang(const Layer& layer, const Region& resting);

  double bead_width_;
  Region below_;
  bool begun_ = false;
  HangingPlace empty_{HangingPlace::Kind::empty_layers,
                      0,
                      0,
                      0,
                      {0, 0},
                      0};     ///< the run of empty layers that the last ones belong to; 0 layers: none
  bool overhung_ = false;     ///< whether the last layer hangs over
  std::size_t overhang_ = 0;  ///< index of the last overhang
  std::vector<HangingPlace> places_;
  std::size_t left_out_ = 0;
};

}  // namespace unicursal::core
