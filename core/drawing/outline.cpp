#include "core/drawing/outline.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "core/text/malformed.hpp"

namespace unicursal::core {
namespace {

using std::numbers::pi;

/// The number of chords for a Bézier curve whose control points have second differences of at most `bend` mm.
/// `factor` = degree·(degree − 1)/8 comes from the bound on a chord's distance by the curve's second
/// derivative.
int chords(double factor, double bend) {
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(factor * bend / flattening))));
}

const Vec2& within_limits(const Vec2& p) {
  // Written so that NaN fails too.
  if (!(std::abs(p.x()) <= farthest_coordinate && std::abs(p.y()) <= farthest_coordinate)) {
    throw TooFar("a point lies more than 100 m away");
  }
  return p;
}

/// The first of the differences that is not zero.
Vec2 first_of(const Vec2& a, const Vec2& b, const Vec2& c) {
  if (a != Vec2(0, 0)) return a;
  return b != Vec2(0, 0) ? b : c;
}

}  // namespace

int arc_chords(double radius, double turn) {
  constexpr double most = 1e5;
  const double sagitta = std::min(flattening / radius, 1.0);
  const double step = 4 * std::asin(std::sqrt(sagitta / 2));
  return static_cast<int>(std::clamp(std::ceil(std::abs(turn) / step), 2.0, most));
}

Vec2 Outline::checked(const Vec2& user) const {
  const Vec2 p = to_part_ * user;
  return within_limits(p);
}

void Outline::add(const Vec2& part_point, bool corner) {
  subpaths_.back().points.push_back(part_point);
  subpaths_.back().corner.push_back(corner);
  if (++points_ > most_outline_points) throw TooFar("it has more than 5 million points");
}

void Outline::depart(const Vec2& direction) {
  if (closed_) vertices_.push_back({start_, {0, 0}, {0, 0}});
  vertices_.back().out = direction;
}

void Outline::meet(const Vec2& arriving, const Vec2& to) {
  vertices_.push_back({to, arriving, {0, 0}});
  pen_ = to;
}

void Outline::move_to(const Vec2& to) {
  checked(to);
  pen_ = start_ = to;
  closed_ = true;
}

void Outline::start_if_needed() {
  if (!closed_) return;
  subpaths_.emplace_back();
  add(checked(start_), true);
  closed_ = false;
}

void Outline::line_to(const Vec2& to) {
  const Vec2 end = checked(to);
  depart(to - pen_);
  start_if_needed();
  add(end, true);
  meet(to - pen_, to);
}

void Outline::quadratic_to(const Vec2& control, const Vec2& to) {
  const Vec2 a = checked(pen_), b = checked(control), c = checked(to);
  depart(first_of(control - pen_, to - pen_, {0, 0}));
  start_if_needed();
  const int n = chords(2.0 / 8, (a - 2 * b + c).norm());
  for (int i = 1; i < n; ++i) {
    const double t = double(i) / n, s = 1 - t;
    add(s * s * a + 2 * s * t * b + t * t * c, false);
  }
  add(c, true);
  meet(first_of(to - control, to - pen_, {0, 0}), to);
}

void Outline::cubic_to(const Vec2& control1, const Vec2& control2, const Vec2& to) {
  const Vec2 a = checked(pen_), b = checked(control1), c = checked(control2), d = checked(to);
  depart(first_of(control1 - pen_, control2 - pen_, to - pen_));
  start_if_needed();
  const int n = chords(6.0 / 8, std::max((a - 2 * b + c).norm(), (b - 2 * c + d).norm()));
  for (int i = 1; i < n; ++i) {
    const double t = double(i) / n, s = 1 - t;
    add(s * s * s * a + 3 * s * s * t * b + 3 * s * t * t * c + t * t * t * d, false);
  }
  add(d, true);
  meet(first_of(to - control2, to - control1, to - pen_), to);
}

void Outline::arc(const Vec2& center, const Eigen::Matrix2d& axes, double from, double turn) {
  const Eigen::Matrix2d mapped = to_part_.linear() * axes;
  // The Frobenius norm is at least the longer half axis, so the chords are never too long.
  const int n = arc_chords(mapped.norm(), turn);
  const Vec2 middle = to_part_ * center;
  for (int i = 1; i < n; ++i) {
    const double angle = from + turn * i / n;
    add(within_limits(middle + mapped * Vec2(std::cos(angle), std::sin(angle))), false);
  }
}

void Outline::arc_to(const Vec2& radii, double rotation, bool large, bool sweep, const Vec2& to) {
  const Vec2 start = pen_, size = radii.cwiseAbs();
  const Vec2 end = checked(to);
  depart(to - start);
  Vec2 arriving = to - start;
  start_if_needed();
  if (size.minCoeff() > 0 && start != to) {
    Eigen::Matrix2d axes = Eigen::Rotation2Dd(rotation).toRotationMatrix() * size.asDiagonal();
    // Half the chord from the end to the start, in the frame in which the ellipse is the unit circle.
    Vec2 half = axes.inverse() * (start - to) / 2;
    double stretch = half.norm();
    if (stretch > 1) {
      axes *= stretch;
      half /= stretch;
      stretch = 1;
    }
    const double apothem = std::sqrt(std::max(0.0, 1 - stretch * stretch));
    const Vec2 aside = half.norm() > 0 ? Vec2(perpendicular(half.normalized())) : Vec2(0, 0);
    const Vec2 offset = (large == sweep ? -apothem : apothem) * aside;
    const Vec2 center = (start + to) / 2 - axes * offset;
    if (!center.allFinite()) throw Malformed("an arc's radii are out of range");
    const Vec2 first = half + offset, last = offset - half;
    double turn = std::atan2(cross(first, last), first.dot(last));
    if (sweep && turn < 0) turn += 2 * pi;
    if (!sweep && turn > 0) turn -= 2 * pi;
    const double side = turn < 0 ? -1 : 1;
    vertices_.back().out = side * (axes * perpendicular(first));
    arriving = side * (axes * perpendicular(last));
    arc(center, axes, std::atan2(first.y(), first.x()), turn);
  }
  add(end, true);
  meet(arriving, to);
}

void Outline::close() {
  if (!closed_) {
    if (pen_ != start_) {
      depart(start_ - pen_);
      meet(start_ - pen_, start_);
    }
    subpaths_.back().closed = true;
  }
  pen_ = start_;
  closed_ = true;
}

std::vector<Ring> Outline::rings() const {
  std::vector<Ring> result;
  for (const Subpath& path : subpaths_) {
    if (path.points.size() >= 3) result.push_back(path.points);
  }
  return result;
}

}  // namespace unicursal::core
