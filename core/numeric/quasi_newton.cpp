#include "core/numeric/quasi_newton.hpp"

#include <algorithm>

namespace unicursal::core {
namespace {

constexpr std::size_t memory = 7;          ///< pairs of step and change; the paper's M
constexpr double least_curvature = 1e-12;  ///< least relative curvature of a pair that is kept
constexpr std::size_t range = 4096;        ///< vectors in one piece of a sum

/// Four sums side by side, so that no addition waits for the one before it.
template <typename Vector>
double dot_of_range(const Vec2* a, const Vector* b, std::size_t count) {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  std::size_t i = 0;
  for (; i + 1 < count; i += 2) {
    x0 += a[i][0] * static_cast<double>(b[i][0]);
    y0 += a[i][1] * static_cast<double>(b[i][1]);
    x1 += a[i + 1][0] * static_cast<double>(b[i + 1][0]);
    y1 += a[i + 1][1] * static_cast<double>(b[i + 1][1]);
  }
  if (i < count) {
    x0 += a[i][0] * static_cast<double>(b[i][0]);
    y0 += a[i][1] * static_cast<double>(b[i][1]);
  }
  return (x0 + x1) + (y0 + y1);
}

template <typename Vector>
void add_to_range(Vec2* a, double factor, const Vector* b, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    a[i][0] += factor * static_cast<double>(b[i][0]);
    a[i][1] += factor * static_cast<double>(b[i][1]);
  }
}

/// Calls work(first, count) for every range and adds up the results in order.
template <typename Work>
double sum_of_ranges(std::size_t count, Workers* workers, Work work) {
  const std::size_t pieces = (count + range - 1) / range;
  const auto piece = [&](std::size_t k) { return work(k * range, std::min(range, count - k * range)); };
  double sum = 0;
  if (workers == nullptr || pieces < 2) {
    for (std::size_t k = 0; k < pieces; ++k) sum += piece(k);
    return sum;
  }
  std::vector<double> sums(pieces);
  workers->each(pieces, [&](std::size_t k) { sums[k] = piece(k); });
  for (const double s : sums) sum += s;
  return sum;
}

using Floats = std::vector<std::array<float, 2>>;

/// a += factor · b; returns a · c.
double add_and_dot(std::vector<Vec2>& a, double factor, const Floats& b, const Floats& c, Workers* workers) {
  return sum_of_ranges(a.size(), workers, [&](std::size_t first, std::size_t count) {
    add_to_range(a.data() + first, factor, b.data() + first, count);
    return dot_of_range(a.data() + first, c.data() + first, count);
  });
}

Floats in_floats(const std::vector<Vec2>& vectors) {
  Floats result;
  result.reserve(vectors.size());
  for (const Vec2& v : vectors) result.push_back({static_cast<float>(v.x()), static_cast<float>(v.y())});
  return result;
}

}  // namespace

double dot(const std::vector<Vec2>& a, const std::vector<Vec2>& b, Workers* workers) {
  return sum_of_ranges(a.size(), workers, [&](std::size_t first, std::size_t count) {
    return dot_of_range(a.data() + first, b.data() + first, count);
  });
}

void add_scaled(std::vector<Vec2>& a, double factor, const std::vector<Vec2>& b, Workers* workers) {
  sum_of_ranges(a.size(), workers, [&](std::size_t first, std::size_t count) {
    add_to_range(a.data() + first, factor, b.data() + first, count);
    return 0.0;
  });
}

void QuasiNewton::remember(const std::vector<Vec2>& step, const std::vector<Vec2>& change) {
  const double product = dot(step, change, workers_), square = dot(change, change, workers_);
  if (!(product > least_curvature * square)) return;
  if (pairs_.size() == memory) pairs_.pop_front();
  double length = square;
  if (!waves_.empty()) {
    std::vector<Vec2> spread = change;
    waves_.apply(spread, workers_);
    length = dot(change, spread, workers_);
  }
  pairs_.push_back({in_floats(step), in_floats(change), 1 / product, product / length});
}

std::vector<Vec2> QuasiNewton::direction(const std::vector<Vec2>& gradient) const {
  std::vector<Vec2> q = gradient;
  const std::size_t count = pairs_.size();
  if (count > 0) {
    std::vector<double> alpha(count);
    double product = add_and_dot(q, 0, pairs_.back().change, pairs_.back().step, workers_);
    for (std::size_t k = count; k-- > 0;) {
      alpha[k] = pairs_[k].inverse * product;
      const Floats& next = k > 0 ? pairs_[k - 1].step : pairs_[0].change;
      product = add_and_dot(q, -alpha[k], pairs_[k].change, next, workers_);
    }
    if (!waves_.empty()) {
      waves_.apply(q, workers_);
      product = add_and_dot(q, 0, pairs_[0].change, pairs_[0].change, workers_);
    }
    // q is scaled only at the end; until then its products are scaled instead.
    const double scale = pairs_.back().curvature;
    for (std::size_t k = 0; k < count; ++k) {
      const double beta = pairs_[k].inverse * scale * product;
      const double factor = (alpha[k] - beta) / scale;
      if (k + 1 < count) {
        product = add_and_dot(q, factor, pairs_[k].step, pairs_[k + 1].change, workers_);
      } else {
        add_and_dot(q, factor, pairs_[k].step, pairs_[k].step, workers_);
      }
    }
    for (Vec2& v : q) v *= -scale;
  } else {
    waves_.apply(q, workers_);
    for (Vec2& v : q) v = -v;
  }
  return q;
}

}  // namespace unicursal::core
