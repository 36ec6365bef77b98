#include "core/geometry/segment_diagram.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/geometry/border_index.hpp"
#include "core/geometry/cell_integrals.hpp"
#include "core/geometry/cell_walk.hpp"
#include "core/geometry/clip.hpp"
#include "core/geometry/curve_sites.hpp"
#include "core/geometry/diagram_frame.hpp"
#include "core/geometry/piece_diagram.hpp"

namespace unicursal::core {
namespace {

constexpr double piece_size = 1500;   ///< segments in a piece of the island
constexpr double small_curve = 2.0;   ///< pieces; an island of less is not divided
constexpr double off_round = 0.0137;  ///< shift of the lines, in pieces, so that they avoid round coordinates
constexpr double first_halo = 0.9;  ///< mean spacings around a piece that are searched for segments at first
constexpr double headroom = 1.1;    ///< factor on the halo of a repeated search
constexpr std::size_t pieces_in_memory = 64;

/// The island, divided along straight lines into rectangles of about `piece_size` segments.
class Pieces {
 public:
  Pieces(const CurveSites& sites, const Polygon& island)
      : sites_(sites), island_(island), border_(island, sites.pitch()), box_(bounds(island)) {
    const auto count = static_cast<double>(sites.size());
    spacing_ = area(island) / perimeter(sites.curve());
    if (count <= small_curve * piece_size) return;
    const double side = std::sqrt(area(island) * piece_size / count);
    columns_ = static_cast<std::size_t>(std::ceil(box_.size().x() / side));
    rows_ = static_cast<std::size_t>(std::ceil(box_.size().y() / side));
  }

  std::size_t count() const { return columns_ * rows_; }

  /// The cells inside piece `number`; absent if no part of the island lies there.
  std::optional<CellSums> cells(std::size_t number) const {
    Frame frame{&border_, lines(number), {}};
    const Polygon piece = polygon(frame.lines);
    if (piece.outer.size() < 3) return std::nullopt;
    const double everywhere = std::numeric_limits<double>::infinity();
    const Box box = bounds(piece);
    for (double halo = count() > 1 ? first_halo * spacing_ : everywhere;;) {
      frame.searched = {box.min.array() - halo, box.max.array() + halo};
      const std::vector<std::size_t> found = sites_.segments_near(frame.searched);
      if (found.empty()) {
        halo = 2 * halo;
        continue;
      }
      CellSums cells(sites_, vertices_of(sites_, found));
      const double missing = walk_cells(sites_, piece_diagram(sites_, found), frame, piece, cells);
      if (missing <= 0) return cells;
      halo = headroom * (halo + missing);
    }
  }

 private:
  static double line(double low, double size, std::size_t number, std::size_t count) {
    if (number == 0) return -std::numeric_limits<double>::infinity();
    if (number == count) return std::numeric_limits<double>::infinity();
    return low + size * (static_cast<double>(number) + off_round) / static_cast<double>(count);
  }

  Box lines(std::size_t number) const {
    const std::size_t column = number % columns_, row = number / columns_;
    const Vec2 low = box_.min, size = box_.size();
    return {{line(low.x(), size.x(), column, columns_), line(low.y(), size.y(), row, rows_)},
            {line(low.x(), size.x(), column + 1, columns_), line(low.y(), size.y(), row + 1, rows_)}};
  }

  Polygon polygon(const Box& between) const {
    Polygon piece = island_;
    const auto clip = [&](Side side, double at) {
      if (!std::isfinite(at)) return;
      piece.outer = clipped(piece.outer, side, at);
      piece.holes = clipped(piece.holes, side, at);
    };
    clip(Side::right, between.min.x());
    clip(Side::left, between.max.x());
    clip(Side::above, between.min.y());
    clip(Side::below, between.max.y());
    return piece;
  }

  const CurveSites& sites_;
  const Polygon& island_;
  BorderIndex border_;
  Box box_;
  double spacing_ = 0;  ///< mean spacing of the curve, mm
  std::size_t columns_ = 1, rows_ = 1;
};

}  // namespace

SegmentDiagram segment_diagram(const Ring& curve, const Polygon& island, Workers* workers) {
  const CurveSites sites(curve);
  const Pieces pieces(sites, island);
  Workers serial(1);
  SegmentDiagram diagram{std::vector<CellIntegrals>(curve.size()), std::vector<CellIntegrals>(curve.size())};
  std::vector<std::optional<CellSums>> cells;
  for (std::size_t first = 0; first < pieces.count(); first += pieces_in_memory) {
    cells.assign(std::min(pieces_in_memory, pieces.count() - first), std::nullopt);
    (workers != nullptr ? *workers : serial).each(cells.size(), [&](std::size_t k) {
      cells[k] = pieces.cells(first + k);
    });
    for (const std::optional<CellSums>& piece : cells) {
      if (piece) piece->add_to(diagram.points, diagram.segments);
    }
  }
  return diagram;
}

}  // namespace unicursal::core
