// Turns the commands of a path (lines, Béziers, elliptical arcs) into polygonal lines. Commands are in the
// drawing's user units; the transform given at the start turns them into points in the part's frame, mm.
// Curves are flattened so that no chord is farther than `flattening` from its curve. Arcs follow the
// implementation notes of SVG 1.1 (appendix F.6): radii that are too small grow, and an arc with a zero
// radius is a line.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "core/geometry/polygon.hpp"
#include "core/text/malformed.hpp"

namespace unicursal::core {

/// Greatest distance of a chord from the curve that it replaces, mm.
inline constexpr double flattening = 0.01;
/// Greatest accepted coordinate, mm; within the range of the integer grid of region.hpp.
inline constexpr double farthest_coordinate = 1e5;

/// One polygonal line of a path. A line without length has one point.
struct Subpath {
  Ring points;
  std::vector<bool> corner;  ///< for each point: whether commands meet there, or a curve goes on
  bool closed = false;       ///< the last point is joined to the first
};

/// Where two commands of a path meet, for markers. User units.
struct PathVertex {
  Vec2 at{0, 0};
  Vec2 in{0, 0}, out{0, 0};  ///< directions of arrival and departure; zero if the path begins or ends here
};

/// Greatest number of points of one outline.
inline constexpr std::size_t most_outline_points = 5'000'000;

/// A point that lies beyond ±farthest_coordinate, or beyond the number of points.
class TooFar : public Malformed {
 public:
  using Malformed::Malformed;
};

/// The number of chords for `turn` radians of a circle of `radius` mm.
int arc_chords(double radius, double turn);

/// Every drawing command throws TooFar if a point lies beyond ±farthest_coordinate, or if they are too many.
class Outline {
 public:
  explicit Outline(const Eigen::Affine2d& to_part) : to_part_(to_part) {}

  /// Starts a new ring; the previous one is closed if necessary.
  void move_to(const Vec2& to);
  void line_to(const Vec2& to);
  void quadratic_to(const Vec2& control, const Vec2& to);
  void cubic_to(const Vec2& control1, const Vec2& control2, const Vec2& to);
  /// `rotation` in radians; `sweep`: the arc runs towards growing angles, in user units.
  void arc_to(const Vec2& radii, double rotation, bool large, bool sweep, const Vec2& to);
  /// Returns to the start of the ring; further strokes start a new ring there.
  void close();

  /// The position of the pen, user units.
  const Vec2& pen() const { return pen_; }
  /// The lines so far as closed rings, without those of fewer than three points.
  std::vector<Ring> rings() const;
  const std::vector<Subpath>& subpaths() const { return subpaths_; }
  const std::vector<PathVertex>& vertices() const { return vertices_; }
  std::size_t point_count() const { return points_; }

 private:
  Vec2 checked(const Vec2& user) const;
  void add(const Vec2& part_point, bool corner);
  void meet(const Vec2& arriving, const Vec2& to);
  void depart(const Vec2& direction);
  void start_if_needed();
  void arc(const Vec2& center, const Eigen::Matrix2d& axes, double from, double turn);

  Eigen::Affine2d to_part_;
  std::vector<Subpath> subpaths_;
  std::vector<PathVertex> vertices_;
  std::size_t points_ = 0;
  Vec2 pen_{0, 0}, start_{0, 0};
  bool closed_ = true;  ///< the next stroke has to start a ring
};

}  // namespace unicursal::core
