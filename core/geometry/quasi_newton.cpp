#include "core/geometry/quasi_newton.hpp"

namespace unicursal::core {
namespace {

constexpr std::size_t memory = 7;          ///< pairs, as in the paper
constexpr double least_curvature = 1e-12;  ///< relative, of a pair worth keeping

}  // namespace

double dot(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

void add_scaled(std::vector<Vec2>& a, double factor, const std::vector<Vec2>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += factor * b[i];
}

void QuasiNewton::remember(std::vector<Vec2> step, std::vector<Vec2> change) {
  const double curvature = dot(step, change);
  if (!(curvature > least_curvature * dot(change, change))) return;
  if (pairs_.size() == memory) pairs_.pop_front();
  pairs_.push_back({std::move(step), std::move(change), 1 / curvature});
}

std::vector<Vec2> QuasiNewton::direction(const std::vector<Vec2>& gradient) const {
  std::vector<Vec2> q = gradient;
  std::vector<double> alpha(pairs_.size());
  for (std::size_t k = pairs_.size(); k-- > 0;) {
    alpha[k] = pairs_[k].inverse * dot(pairs_[k].step, q);
    add_scaled(q, -alpha[k], pairs_[k].change);
  }
  if (!pairs_.empty()) {
    const Pair& last = pairs_.back();
    const double scale = 1 / (last.inverse * dot(last.change, last.change));
    for (Vec2& v : q) v *= scale;
  }
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const double beta = pairs_[k].inverse * dot(pairs_[k].change, q);
    add_scaled(q, alpha[k] - beta, pairs_[k].step);
  }
  for (Vec2& v : q) v = -v;
  return q;
}

}  // namespace unicursal::core
