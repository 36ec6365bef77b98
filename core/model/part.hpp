// A part: zones with patterns and materials, cut into layers of islands on demand.
// Frame: the part's own, mm, y up (an SVG's y is flipped about its viewBox), z up from the first layer's
// underside. Slices are taken at mid-layer heights. Paper §3: the input polygon P and its zones.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/geometry/polygon.hpp"

namespace unicursal::core {

/// How the curve is to run inside a zone (paper §3.1).
enum class PatternKind { none, isotropic, anisotropic, parallel, orthogonal, angle, field };

struct Pattern {
  PatternKind kind = PatternKind::isotropic;
  double angle = 0;             ///< radians counter-clockwise from +x, for PatternKind::angle
  std::filesystem::path field;  ///< the CSV of directions, for PatternKind::field
  /// For parallel and orthogonal: whether the zone's own borders count, not only the island's.
  bool along_zone_border = false;
};

/// A region of one pattern and one material. Zones of equal `material` form one material zone.
struct Zone {
  std::string select;  ///< the fill colour "#rrggbb", object name or file base name that it covers
  Pattern pattern;
  std::size_t material = 0;  ///< index of the mixture, which core knows nothing else about
};

/// The part of one zone that lies in one island.
struct ZoneRegion {
  std::size_t zone = 0;           ///< index into Part::zones()
  std::vector<Polygon> polygons;  ///< disjoint
};

/// A connected piece of a layer. Its zone regions cover the outline without overlap (to 0.01 mm).
struct Island {
  Polygon outline;
  std::vector<ZoneRegion> zones;  ///< at least one, ordered by zone index
};

struct Layer {
  std::size_t index = 0;
  double z = 0;                 ///< height of the cut above the part's underside, mm
  double top = 0;               ///< height of the layer's upper face above the part's underside, mm
  double height = 0;            ///< thickness, mm
  std::vector<Island> islands;  ///< largest first; may be empty
};

/// Whether the layer lies on the bed, as the first of a part does.
inline bool rests_on_bed(const Layer& layer) {
  constexpr double rounding = 1e-6;  // mm
  return layer.top - layer.height < rounding;
}

/// What to read and how to cut it.
struct PartSource {
  std::vector<std::filesystem::path> files;  ///< one SVG, or one or more STL
  double height = 0;                         ///< mm: the height of an extruded drawing; ignored for meshes
  double layer_height = 0;                   ///< mm
  std::vector<Zone> zones;
  double first_layer_height = 0;  ///< mm; 0: like the others
  /// Of a drawing: lines that are not filled surround areas, instead of being areas.
  bool strokes_are_contours = false;
};

/// A part that slices itself. Layers are computed on demand and not kept, so memory does not grow with their
/// number. `layer()` may be called from several threads at once.
class Part {
 public:
  virtual ~Part() = default;

  virtual std::size_t layer_count() const = 0;
  /// Throws ModelError naming the height if the section there does not consist of closed contours.
  virtual Layer layer(std::size_t index) const = 0;
  /// Extent in x and y of everything that will be printed.
  virtual Box extent() const = 0;
  /// Height of the last layer's upper face, mm.
  virtual double height() const = 0;
  virtual const std::vector<Zone>& zones() const = 0;
  /// Odd but harmless findings while reading, one sentence each.
  virtual const std::vector<std::string>& warnings() const = 0;
};

}  // namespace unicursal::core
