#include "core/drawing/stroke.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/text/malformed.hpp"

namespace unicursal::core {
namespace {

using std::numbers::pi;

constexpr double same_point = 1e-7;     ///< mm: points closer than this have no direction
constexpr double dot = 1e-5;            ///< mm: length of a dash of length zero, which gives it a direction
constexpr double farthest_miter = 1e4;  ///< mm
constexpr std::size_t most_ring_points = 2'000'000;
constexpr std::size_t most_dashes = 1'000'000;

/// A line whose points all differ from their neighbours.
struct Line {
  Ring points;
  std::vector<bool> corner;
  bool closed = false;
};

Line without_repeats(const Subpath& path) {
  Line line;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    if (!line.points.empty() && (path.points[i] - line.points.back()).norm() < same_point) {
      line.corner.back() = line.corner.back() || path.corner[i];
      continue;
    }
    line.points.push_back(path.points[i]);
    line.corner.push_back(path.corner[i]);
  }
  line.closed = path.closed;
  if (line.closed && line.points.size() > 1 &&
      (line.points.front() - line.points.back()).norm() < same_point) {
    line.points.pop_back();
    line.corner.pop_back();
  }
  if (line.points.size() < 3 && path.closed && line.points.size() == 2) line.corner.assign(2, true);
  return line;
}

Vec2 right_of(const Vec2& direction) {
  return {direction.y(), -direction.x()};
}

/// The edge of the pen on the right side of a line.
class Edge {
 public:
  Edge(const StrokeStyle& style, Ring& ring) : style_(style), half_(style.width / 2), ring_(ring) {}

  void add(const Vec2& point) {
    ring_.push_back(point);
    if (ring_.size() > most_ring_points) throw Malformed("its stroke has more than 2 million points");
  }

  /// Turns about `at` from the direction `from` to `to`, at the right side.
  void join(const Vec2& at, const Vec2& from, const Vec2& to, bool corner) {
    const double turn = std::atan2(cross(from, to), from.dot(to));
    add(at + half_ * right_of(from));
    if (turn <= 0) {
      add(at);  // the inner side: the winding number stays positive where both arms overlap
    } else if (!corner || style_.join == Join::round) {
      arc(at, right_of(from), turn);
    } else if (style_.join == Join::miter) {
      const double stretch = 1 / std::cos(turn / 2);
      if (stretch > 0 && stretch <= style_.miter_limit && half_ * stretch <= farthest_miter) {
        add(at + half_ * stretch * (right_of(from) + right_of(to)).normalized());
      }
    }
    add(at + half_ * right_of(to));
  }

  /// Turns round the end of a line that arrives in the direction `along`.
  void cap(const Vec2& at, const Vec2& along) {
    const Vec2 right = half_ * right_of(along);
    add(at + right);
    if (style_.cap == Cap::round) {
      arc(at, right_of(along), pi);
    } else if (style_.cap == Cap::square) {
      add(at + right + half_ * along);
      add(at - right + half_ * along);
    }
    add(at - right);
  }

 private:
  void arc(const Vec2& center, const Vec2& from, double turn) {
    const int n = arc_chords(half_, turn);
    for (int i = 1; i < n; ++i) add(center + half_ * (Eigen::Rotation2Dd(turn * i / n) * from));
  }

  const StrokeStyle& style_;
  double half_;
  Ring& ring_;
};

std::vector<Vec2> directions(const Line& line) {
  std::vector<Vec2> result;
  const std::size_t n = line.points.size();
  for (std::size_t i = 0; i + 1 < n || (line.closed && i < n); ++i)
    result.push_back((line.points[(i + 1) % n] - line.points[i]).normalized());
  return result;
}

void add_closed(const Line& line, const StrokeStyle& style, std::vector<Ring>& rings) {
  const std::size_t n = line.points.size();
  const std::vector<Vec2> along = directions(line);
  Ring right, left;
  Edge right_edge(style, right), left_edge(style, left);
  for (std::size_t i = 0; i < n; ++i) {
    right_edge.join(line.points[i], along[(i + n - 1) % n], along[i], line.corner[i]);
    const std::size_t k = n - 1 - i;
    left_edge.join(line.points[k], -along[k], -along[(k + n - 1) % n], line.corner[k]);
  }
  rings.push_back(std::move(right));
  rings.push_back(std::move(left));
}

void add_open(const Line& line, const StrokeStyle& style, std::vector<Ring>& rings) {
  const std::size_t n = line.points.size();
  const std::vector<Vec2> along = directions(line);
  Ring ring;
  Edge edge(style, ring);
  for (std::size_t i = 1; i + 1 < n; ++i) edge.join(line.points[i], along[i - 1], along[i], line.corner[i]);
  edge.cap(line.points.back(), along.back());
  for (std::size_t i = n - 2; i > 0; --i) edge.join(line.points[i], -along[i], -along[i - 1], line.corner[i]);
  edge.cap(line.points.front(), -along.front());
  rings.push_back(std::move(ring));
}

/// A point is drawn by the caps alone.
void add_dot(const Vec2& at, const StrokeStyle& style, std::vector<Ring>& rings) {
  if (style.cap == Cap::butt) return;
  Ring ring;
  Edge edge(style, ring);
  edge.cap(at, Vec2(1, 0));
  edge.cap(at, Vec2(-1, 0));
  rings.push_back(std::move(ring));
}

/// Cuts one line by arc length.
class Dasher {
 public:
  Dasher(const std::vector<double>& pattern, double offset, std::vector<Subpath>& result)
      : pattern_(pattern), result_(result) {
    double whole = 0;
    for (const double part : pattern) whole += part;
    left_ = std::fmod(offset, whole);
    if (left_ < 0) left_ += whole;
    while (left_ > pattern_[at_] || (left_ == pattern_[at_] && left_ > 0)) {
      left_ -= pattern_[at_];
      at_ = (at_ + 1) % pattern_.size();
    }
    left_ = pattern_[at_] - left_;
  }

  void cut(const Line& line) {
    const std::size_t first = result_.size();
    const bool begins_with_dash = inked();
    const std::size_t n = line.points.size(), segments = line.closed ? n : n - 1;
    if (inked()) begin(line.points[0]);
    for (std::size_t i = 0; i < segments; ++i) {
      const Vec2 &a = line.points[i], &b = line.points[(i + 1) % n];
      segment(a, b);
      const bool last = i + 1 == segments;
      if (inked() && !last) add(b, line.corner[(i + 1) % n]);
      if (inked() && last) add(b, true);
    }
    const bool ends_with_dash = inked();
    // The dashes at both ends of a closed line are one.
    if (line.closed && begins_with_dash && ends_with_dash && result_.size() > first + 1) {
      Subpath tail = std::move(result_.back());
      result_.pop_back();
      Subpath& head = result_[first];
      tail.corner.back() = line.corner[0];
      tail.points.insert(tail.points.end(), head.points.begin() + 1, head.points.end());
      tail.corner.insert(tail.corner.end(), head.corner.begin() + 1, head.corner.end());
      head = std::move(tail);
    }
  }

 private:
  bool inked() const { return at_ % 2 == 0; }

  void begin(const Vec2& at) {
    if (result_.size() >= most_dashes) throw Malformed("it has more than a million dashes");
    result_.push_back({{at}, {true}, false});
  }
  void add(const Vec2& at, bool corner) {
    result_.back().points.push_back(at);
    result_.back().corner.push_back(corner);
  }

  void segment(const Vec2& a, const Vec2& b) {
    const double length = (b - a).norm();
    const Vec2 along = (b - a) / length;
    double done = 0;
    while (done + left_ < length) {
      done += left_;
      const Vec2 at = a + along * done;
      if (inked()) {
        const bool no_length =
            result_.back().points.size() == 1 && (result_.back().points.back() - at).norm() < same_point;
        add(no_length ? Vec2(at + along * dot) : at, true);
      }
      at_ = (at_ + 1) % pattern_.size();
      left_ = pattern_[at_];
      if (inked()) begin(at);
    }
    left_ -= length - done;
  }

  const std::vector<double>& pattern_;
  std::vector<Subpath>& result_;
  std::size_t at_ = 0;
  double left_ = 0;  ///< of the current dash or gap
};

}  // namespace

std::vector<Subpath> dashed(const std::vector<Subpath>& line, const StrokeStyle& style) {
  std::vector<double> pattern = style.dashes;
  if (pattern.size() % 2 != 0) pattern.insert(pattern.end(), style.dashes.begin(), style.dashes.end());
  double whole = 0;
  for (const double part : pattern) whole += part;
  if (!(whole > same_point) || !std::isfinite(whole)) return line;
  std::vector<Subpath> result;
  for (const Subpath& path : line) {
    const Line clean = without_repeats(path);
    if (clean.points.size() < 2) {
      result.push_back(path);
      continue;
    }
    double total = 0;
    for (std::size_t i = 1; i < clean.points.size(); ++i)
      total += (clean.points[i] - clean.points[i - 1]).norm();
    if (total / whole * double(pattern.size()) > double(most_dashes)) {
      throw Malformed("it has more than a million dashes");
    }
    Dasher(pattern, style.dash_offset, result).cut(clean);
  }
  return result;
}

std::vector<Ring> stroke_rings(const std::vector<Subpath>& line, const StrokeStyle& style) {
  std::vector<Ring> rings;
  if (!(style.width > 0)) return rings;
  std::size_t points = 0, counted = 0;
  for (const Subpath& path : line) {
    for (; counted < rings.size(); ++counted) points += rings[counted].size();
    if (points > most_ring_points) throw Malformed("its strokes have more than 2 million points");
    if (path.points.empty()) continue;
    const Line clean = without_repeats(path);
    if (clean.points.size() == 1) {
      add_dot(clean.points.front(), style, rings);
    } else if (clean.closed) {
      add_closed(clean, style, rings);
    } else {
      add_open(clean, style, rings);
    }
  }
  return rings;
}

}  // namespace unicursal::core
