#include "core/curve/orientation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace unicursal::core {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::size_t strokes_at_once = 4096;  ///< in one piece of work

/// The same angle modulo π, in [0, π).
double modulo_pi(double angle) {
  const double wrapped = angle - pi * std::floor(angle / pi);
  return wrapped < pi ? wrapped : 0.0;
}

/// Sorts pairs of an angle in [0, π) and a number. Angles of a curve are spread so evenly that few of them
/// share one of as many drawers as there are angles: it takes a few steps for each, instead of as many as the
/// logarithm of all.
void sort_by_angle(std::vector<std::pair<double, std::size_t>>& order) {
  const std::size_t n = order.size();
  const auto drawer = [&](double angle) {
    return std::min(static_cast<std::size_t>(angle / pi * static_cast<double>(n)), n - 1);
  };
  std::vector<std::uint32_t> begin(n + 1, 0);
  for (const auto& [angle, i] : order) ++begin[drawer(angle) + 1];
  for (std::size_t k = 0; k < n; ++k) begin[k + 1] += begin[k];
  std::vector<std::pair<double, std::size_t>> sorted(n);
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (const auto& one : order) sorted[next[drawer(one.first)]++] = one;
  for (std::size_t k = 0; k < n; ++k) {
    if (begin[k + 1] - begin[k] > 1) std::sort(sorted.begin() + begin[k], sorted.begin() + begin[k + 1]);
  }
  order.swap(sorted);
}

/// The strokes in order of angle, and the map from their directions to the uniform distribution (Figure 30).
struct Transport {
  std::vector<Stroke> sorted;
  double length = 0;
  double shift = 0;  ///< π α₀ (47)

  explicit Transport(std::vector<Stroke> strokes) : sorted(std::move(strokes)) {
    double mean = 0;
    for (const Stroke& s : sorted) length += s.length, mean += s.length * s.angle;
    shift = length > 0 ? mean / length - pi / 2 : 0;
  }

  /// E_iso (50); `visit(k, from, to)` receives Θ⁰ − θ and Θ¹ − θ of stroke k.
  template <typename Visit>
  double walk(Visit visit) const {
    double value = 0, done = 0;
    for (std::size_t k = 0; k < sorted.size(); ++k) {
      const double from = pi * done / length + shift - sorted[k].angle;
      done += sorted[k].length;
      const double to = pi * done / length + shift - sorted[k].angle;
      value += (to - from) * (to * to + to * from + from * from) / (3 * pi);
      visit(k, from, to);
    }
    return value;
  }
};

/// The derivatives of E_iso by the angle and by the length of a stroke.
struct Slope {
  double turn = 0, stretch = 0;
};

}  // namespace

double isotropy_distance(std::vector<Stroke> strokes) {
  for (Stroke& s : strokes) s.angle = modulo_pi(s.angle);
  std::sort(strokes.begin(), strokes.end(),
            [](const Stroke& a, const Stroke& b) { return a.angle < b.angle; });
  const Transport transport(std::move(strokes));
  return transport.length > 0 ? transport.walk([](std::size_t, double, double) {}) : 0.0;
}

double isotropy_with_gradient(const Curve& curve, const std::vector<char>& counts, double weight,
                              std::vector<Vec2>& gradient, Workers* workers) {
  Workers serial(1);
  Workers& all = workers != nullptr ? *workers : serial;
  std::vector<Stroke> strokes(curve.size());  // per segment; of length 0 if it does not count
  all.ranges(curve.size(), strokes_at_once, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      if (!counts[i]) continue;
      const Vec2 u = curve.vertices[curve.after(i)] - curve.vertices[i];
      strokes[i] = {modulo_pi(std::atan2(u.y(), u.x())), u.norm()};
    }
  });
  std::vector<std::pair<double, std::size_t>> order;  // angle and segment
  order.reserve(curve.size());
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (strokes[i].length > 0) order.emplace_back(strokes[i].angle, i);
  }
  sort_by_angle(order);
  std::vector<Stroke> sorted;
  sorted.reserve(order.size());
  for (const auto& [angle, i] : order) sorted.push_back(strokes[i]);
  const Transport transport(std::move(sorted));
  if (!(transport.length > 0)) return 0;

  // ∂E/∂θ depends on each stroke's own share, ∂E/∂l on the ends T (46) of all shares after it.
  const std::size_t n = order.size();
  std::vector<Slope> slopes(curve.size());
  std::vector<double> jump(n, 0.0);
  double before = 0;
  const double value = transport.walk([&](std::size_t k, double from, double to) {
    slopes[order[k].second].turn = -(to * to - from * from) / pi;
    if (k > 0) jump[k - 1] = before * before - from * from;
    before = to;
  });
  double weighted = 0, done = 0;
  for (std::size_t k = 0; k + 1 < n; ++k) {
    done += transport.sorted[k].length;
    weighted += jump[k] * done / transport.length;
  }
  double after = 0;
  for (std::size_t k = n; k-- > 0;) {
    after += jump[k];
    slopes[order[k].second].stretch = (after - weighted) / transport.length;
  }
  const auto pull = [&](std::size_t i) -> Vec2 {
    const double l = strokes[i].length;
    if (!(l > 0)) return {0, 0};
    const Vec2 u = curve.vertices[curve.after(i)] - curve.vertices[i];
    return weight * (slopes[i].turn / (l * l) * perpendicular(u) + slopes[i].stretch / l * u);
  };
  all.ranges(curve.size(), strokes_at_once, [&](std::size_t from, std::size_t to) {
    Vec2 arriving = pull(curve.before(from));
    for (std::size_t i = from; i < to; ++i) {
      const Vec2 leaving = pull(i);
      gradient[i] += arriving - leaving;
      arriving = leaving;
    }
  });
  return value;
}

}  // namespace unicursal::core
