#include "tests/bench/paper/figures.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "core/curve/clearance.hpp"
#include "core/curve/orientation.hpp"
#include "core/field/make_direction_field.hpp"
#include "core/geometry/lattice.hpp"
#include "core/geometry/lattice_owners.hpp"
#include "core/geometry/predicates.hpp"
#include "core/geometry/segment_grid.hpp"
#include "core/numeric/random.hpp"
#include "core/planner/measure.hpp"
#include "tests/bench/paper/bed.hpp"

namespace unicursal::bench {
namespace {

using core::Polygon;
using core::Ring;
using core::Vec2;

constexpr double samples_per_width = 12;
constexpr double lattice_turn = 0.6180339;  ///< rad; keeps the lattice from resonating with rows
constexpr double far_away = 0.75;           ///< bead widths
constexpr double samples_for_zones = 8;     ///< per bead width along a line
constexpr double jitter = 2e-4;  ///< bead widths; see core/README.md on straight lines in the diagram

Ring turned_by(const Ring& ring, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Ring result;
  for (const Vec2& p : ring) result.emplace_back(c * p.x() - s * p.y(), s * p.x() + c * p.y());
  return result;
}

Polygon turned_by(const Polygon& polygon, double angle) {
  Polygon result{turned_by(polygon.outer, angle), {}};
  for (const Ring& hole : polygon.holes) result.holes.push_back(turned_by(hole, angle));
  return result;
}

std::vector<core::Segment> segments_of_lines(const std::vector<Line>& lines) {
  std::vector<core::Segment> segments;
  for (const Line& line : lines) {
    for (std::size_t i = 0; i < line.segments(); ++i) segments.push_back({line.start(i), line.end(i)});
  }
  return segments;
}

/// The zone at a point; nullopt beside all zones.
class ZonesHere {
 public:
  explicit ZonesHere(const core::Island& island) {
    for (const core::ZoneRegion& zone : island.zones) {
      for (const Polygon& polygon : zone.polygons)
        regions_.push_back({zone.zone, core::BorderIndex(polygon, 1.0)});
    }
  }
  std::optional<std::size_t> at(const Vec2& point) const {
    for (const auto& [zone, border] : regions_) {
      if (border.contains(point)) return zone;
    }
    return std::nullopt;
  }

 private:
  std::vector<std::pair<std::size_t, core::BorderIndex>> regions_;
};

/// Crossings of materials, and the directions in isotropic zones.
class ZoneFigures {
 public:
  ZoneFigures(const Part& part) : part_(part) {}

  void add(const core::Island& island, const std::vector<Line>& lines) {
    const ZonesHere zones(island);
    for (const Line& line : lines) add(line, zones);
  }
  std::size_t crossings() const { return crossings_; }
  std::optional<double> isotropy() const {
    if (strokes_.empty()) return std::nullopt;
    return core::isotropy_distance(strokes_);
  }

 private:
  void add(const Line& line, const ZonesHere& zones) {
    std::optional<std::size_t> first, last;
    for (std::size_t i = 0; i < line.segments(); ++i) {
      const double length = line.length(i);
      const Vec2 along = line.end(i) - line.start(i);
      const auto pieces =
          std::max(1, static_cast<int>(std::ceil(length * samples_for_zones / part_.width())));
      for (int k = 0; k < pieces; ++k) {
        const auto zone = zones.at(line.start(i) + (k + 0.5) / pieces * along);
        if (!zone) continue;
        const std::size_t material = part_.zones[*zone].material;
        if (last && *last != material) ++crossings_;
        if (!first) first = material;
        last = material;
        if (part_.zones[*zone].pattern.kind == core::PatternKind::isotropic && length > 0)
          strokes_.push_back({std::atan2(along.y(), along.x()), length / pieces});
      }
    }
    if (line.closed && first && *first != *last) ++crossings_;
  }

  const Part& part_;
  std::size_t crossings_ = 0;
  std::vector<core::Stroke> strokes_;
};

/// Σ length · ‖V‖ · θ² and Σ length · ‖V‖ against a field.
void add_alignment(const std::vector<Line>& lines, const core::DirectionField& field, double& squares,
                   double& weights) {
  for (const core::Segment& segment : segments_of_lines(lines)) {
    const Vec2 along = segment.b - segment.a;
    const double length = along.norm();
    const auto pieces = std::max(1, static_cast<int>(std::ceil(length)));
    for (int k = 0; k < pieces && length > 0; ++k) {
      const Vec2 v = field.at(segment.a + (k + 0.5) / pieces * along);
      if (!(v.squaredNorm() > 0)) continue;
      const Vec2 d = core::doubled(along);
      const double theta = std::atan2(core::cross(v, d), v.dot(d)) / 2;
      squares += length / pieces * v.norm() * theta * theta;
      weights += length / pieces * v.norm();
    }
  }
}

bool asks_for_directions(const std::vector<core::Zone>& zones) {
  return std::any_of(zones.begin(), zones.end(), [](const core::Zone& zone) {
    const core::PatternKind kind = zone.pattern.kind;
    return kind != core::PatternKind::none && kind != core::PatternKind::isotropic &&
           kind != core::PatternKind::anisotropic;
  });
}

std::optional<double> alignment_of(const Part& part, const Run& run) {
  if (!asks_for_directions(part.zones)) return std::nullopt;
  const core::ZoneDirections files = core::read_zone_directions(part.zones);
  double squares = 0, weights = 0;
  for (std::size_t k = 0; k < run.islands.size(); ++k) {
    add_alignment(
        run.islands[k].lines,
        core::make_direction_field(part.layer.islands[k], part.zones, files, part.layer.z, part.width() / 4),
        squares, weights);
  }
  if (!(weights > 0)) return std::nullopt;
  return squares / weights;
}

/// E and CV by the exact diagram, for a part of one island with a single closed curve.
void measure_exactly(const Part& part, const Run& run, Figures& result) {
  if (run.islands.size() != 1 || run.islands[0].lines.size() != 1 || !run.islands[0].lines[0].closed) return;
  const Polygon& island = part.layer.islands[0].outline;
  const double w = part.width();
  core::Random random(1);
  core::Curve curve{run.islands[0].lines[0].points};
  for (Vec2& p : curve.vertices) p += jitter * w * Vec2(random.uniform(-1, 1), random.uniform(-1, 1));
  if (curve.size() < 5 || core::self_intersections(curve) > 0 ||
      core::segments_outside(curve, core::BorderIndex(island, w)) > 0)
    return;
  const core::SegmentDiagram diagram = core::segment_diagram(curve.vertices, island);
  result.exact_coverage = core::objectives(diagram, curve, core::area(island), w, {}).normalised_coverage;
  SpreadMeter meter(w);
  meter.add({curve.vertices, true}, core::segment_areas(diagram, curve, w).data());
  result.exact_variation = meter.spread().variation;
}

/// Half a bead width of the line to either side of a vertex shares the points that are nearest to it, as
/// core::segment_areas() does it; else a short segment at the tip of a hairpin would get a blob.
void share_vertex(const Line& line, std::size_t vertex, double area, double reach, double* areas) {
  struct Share {
    std::size_t segment;
    double length;
  };
  const std::size_t count = line.segments();
  std::vector<Share> shares;
  double all = 0;
  for (const bool ahead : {true, false}) {
    double left = reach;
    std::size_t i = ahead ? vertex : vertex - 1;
    for (std::size_t steps = 0; left > 0 && steps < count; ++steps) {
      if (i >= count) {
        if (!line.closed) break;
        i = ahead ? 0 : count - 1;
      }
      const double length = std::min(left, line.length(i));
      shares.push_back({i, length});
      all += length;
      left -= line.length(i);
      i = ahead ? i + 1 : i - 1;
    }
  }
  for (const Share& share : shares) {
    if (all > 0) areas[share.segment] += area * share.length / all;
  }
}

}  // namespace

std::vector<double> areas_of(const std::vector<Line>& lines, const Polygon& island, double bead_width,
                             double& moment, double& bare) {
  const core::Lattice lattice = core::sample(turned_by(island, lattice_turn), bead_width / samples_per_width);
  std::vector<Line> turned = lines;
  for (Line& line : turned) line.points = turned_by(line.points, lattice_turn);
  const std::vector<core::Segment> segments = segments_of_lines(turned);
  std::vector<double> areas(segments.size(), 0.0);
  if (segments.empty()) {
    bare += core::area(island);
    return areas;
  }
  core::LatticeOwners owners(lattice);
  owners.assign(segments);
  moment += owners.second_moment();
  const double limit = far_away * far_away * bead_width * bead_width;
  std::vector<double> starts(segments.size(), 0.0), ends(segments.size(), 0.0);  // of the vertices' cells
  for (std::size_t k = 0; k < lattice.size(); ++k) {
    if (owners.owner(k) < 0) continue;
    const auto owner = static_cast<std::size_t>(owners.owner(k));
    const core::Segment& s = segments[owner];
    const double along = (lattice.position(k) - s.a).dot(s.b - s.a), whole = (s.b - s.a).squaredNorm();
    (along <= 0 ? starts : along >= whole ? ends : areas)[owner] += lattice.weight(k);
    if (owners.distance2(k) > limit) bare += lattice.weight(k);
  }
  std::size_t first = 0;
  for (const Line& line : lines) {
    for (std::size_t i = 0; i < line.segments(); ++i) {
      share_vertex(line, i, starts[first + i], bead_width / 2, &areas[first]);
      share_vertex(line, i + 1, ends[first + i], bead_width / 2, &areas[first]);
    }
    first += line.segments();
  }
  return areas;
}

void SpreadMeter::add(const Line& line, const double* areas) {
  // A segment may be longer than a window and then counts for several.
  double length = 0, area = 0;
  for (std::size_t i = 0; i < line.segments(); ++i) {
    double left = line.length(i);
    if (!(left > 0)) {
      area += areas[i];
      continue;
    }
    const double width = areas[i] / left;
    while (left > 0) {
      const double step = std::min(left, w_ - length);
      length += step;
      area += step * width;
      left -= step;
      if (length < w_ * (1 - 1e-9)) continue;
      widths_.push_back(area / length);
      length = area = 0;
    }
  }
}

Spread SpreadMeter::spread() const {
  Spread spread;
  if (widths_.empty()) return spread;
  const auto n = static_cast<double>(widths_.size());
  double squares = 0;
  for (const double width : widths_) {
    spread.mean += width / n;
    squares += width * width / n;
    const auto bin = static_cast<std::size_t>(width / w_ / Spread::bin);
    spread.shares[std::min(bin, Spread::bins - 1)] += 1 / n;
  }
  spread.variation = std::sqrt(std::max(0.0, squares - spread.mean * spread.mean)) / spread.mean;
  return spread;
}

std::size_t meetings(const std::vector<Line>& lines) {
  struct Place {
    std::size_t line = 0, index = 0;
  };
  std::vector<Place> places;
  double length = 0;
  for (std::size_t l = 0; l < lines.size(); ++l) {
    for (std::size_t i = 0; i < lines[l].segments(); ++i) {
      places.push_back({l, i});
      length += lines[l].length(i);
    }
  }
  if (places.empty()) return 0;
  const std::vector<core::Segment> segments = segments_of_lines(lines);
  const core::SegmentGrid grid(segments, std::max(length / static_cast<double>(places.size()), 1e-3));
  const auto neighbours = [&](std::size_t a, std::size_t b) {
    if (places[a].line != places[b].line) return false;
    const Line& line = lines[places[a].line];
    const std::size_t apart = places[b].index - places[a].index;
    return apart == 1 || (line.closed && apart + 1 == line.segments());
  };
  std::size_t count = 0;
  std::vector<std::size_t> seen(segments.size(), segments.size());
  for (std::size_t a = 0; a < segments.size(); ++a) {
    const core::Segment& s = segments[a];
    grid.near({s.a.cwiseMin(s.b), s.a.cwiseMax(s.b)}, [&](std::size_t b) {
      if (b <= a || seen[b] == a || neighbours(a, b)) return;
      seen[b] = a;
      const core::Segment& t = segments[b];
      if (core::orientation(s.a, s.b, t.a) * core::orientation(s.a, s.b, t.b) <= 0 &&
          core::orientation(t.a, t.b, s.a) * core::orientation(t.a, t.b, s.b) <= 0 &&
          core::distance_between_segments(s.a, s.b, t.a, t.b) < 1e-9)
        ++count;
    });
  }
  return count;
}

Figures figures(const Part& part, const Run& run, const std::filesystem::path& folder) {
  Figures result;
  result.method = run.method;
  result.seconds = run.seconds;
  SpreadMeter meter(part.width());
  ZoneFigures zones(part);
  double moment = 0, bare = 0;
  std::vector<std::vector<double>> areas;
  for (std::size_t k = 0; k < run.islands.size(); ++k) {
    const core::Island& island = part.layer.islands[k];
    const std::vector<Line>& lines = run.islands[k].lines;
    areas.push_back(areas_of(lines, island.outline, part.width(), moment, bare));
    const double* next = areas.back().data();
    const core::BorderIndex border(island.outline, part.width());
    for (std::size_t l = 0; l < lines.size(); ++l) {
      meter.add(lines[l], next);
      next += lines[l].segments();
      for (std::size_t i = 0; i < lines[l].segments(); ++i) result.length += lines[l].length(i);
      if (l > 0) {
        const Line& before = lines[l - 1];
        result.travel_length +=
            (lines[l].points.front() - (before.closed ? before.points.front() : before.points.back())).norm();
      }
      if (lines[l].closed) {
        result.outside += core::segments_outside({lines[l].points}, border);
      } else {
        result.outside +=
            static_cast<std::size_t>(std::count_if(lines[l].points.begin(), lines[l].points.end(),
                                                   [&](const Vec2& p) { return !border.contains(p); }));
      }
    }
    result.lines += lines.size();
    result.travels += lines.empty() ? 0 : lines.size() - 1;
    result.meetings += meetings(lines);
    result.iterations += run.islands[k].iterations;
    result.finished = result.finished && run.islands[k].finished;
    zones.add(island, lines);
  }
  const double area = part.area(), w = result.length > 0 ? area / result.length : part.width();
  result.spacing = meter.spread();
  result.coverage = moment / (area * w * w);
  result.bare = bare / area;
  result.crossings = zones.crossings();
  result.isotropy = zones.isotropy();
  result.alignment = alignment_of(part, run);
  measure_exactly(part, run, result);
  lay_and_draw(part, run, areas, folder, result);
  return result;
}

}  // namespace unicursal::bench
