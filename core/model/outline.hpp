// Turns strokes of a pen (lines, Béziers, elliptical arcs) into closed rings. Commands are in the drawing's
// user units; rings come out in the part's frame, mm, through the transform given at the start.
// Curves are flattened so that no chord is farther than `flattening` from its curve. Arcs follow the
// implementation notes of SVG 1.1 (appendix F.6): too small radii grow, a zero radius is a line.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/geometry/polygon.hpp"

namespace unicursal::core {

/// mm, greatest distance of a chord from the curve that it stands for.
inline constexpr double flattening = 0.01;
/// mm, beyond this no coordinate is believed (and the integer grid of region.hpp ends).
inline constexpr double farthest_coordinate = 1e5;

/// Every drawing command throws Malformed when a point leaves ±farthest_coordinate.
class Outline {
 public:
  explicit Outline(const Eigen::Affine2d& to_part) : to_part_(to_part) {}

  /// Starts a new ring; the last one is closed if it was not.
  void move_to(const Vec2& to);
  void line_to(const Vec2& to);
  void quadratic_to(const Vec2& control, const Vec2& to);
  void cubic_to(const Vec2& control1, const Vec2& control2, const Vec2& to);
  /// `rotation` in radians; `sweep`: towards growing angles in user units.
  void arc_to(const Vec2& radii, double rotation, bool large, bool sweep, const Vec2& to);
  /// Goes back to where the ring started; further strokes start a new ring there.
  void close();

  /// Where the pen is, user units.
  const Vec2& pen() const { return pen_; }
  /// What was enclosed so far; rings of fewer than three points enclose nothing and are left out.
  std::vector<Ring> rings() const;

 private:
  Vec2 checked(const Vec2& user) const;
  void add(const Vec2& part_point);
  void start_if_needed();
  void arc(const Vec2& center, const Eigen::Matrix2d& axes, double from, double turn);

  Eigen::Affine2d to_part_;
  std::vector<Ring> rings_;
  Vec2 pen_{0, 0}, start_{0, 0};
  bool closed_ = true;  ///< the next stroke has to start a ring
};

}  // namespace unicursal::core
