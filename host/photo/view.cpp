#include "host/photo/view.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace unicursal::host {
namespace {

using core::Vec2;

constexpr double far_off = 2;   ///< doubts beyond which a sighting pulls no more strongly
constexpr double mistaken = 8;  ///< doubts; a sighting that is farther off than this is of something else
constexpr int most_view_steps = 40;

Vec2 projected(const std::array<double, 8>& plane, const Vec2& place) {
  const double x = place.x(), y = place.y();
  const double depth = plane[6] * x + plane[7] * y + 1;
  return {(plane[0] * x + plane[1] * y + plane[2]) / depth, (plane[3] * x + plane[4] * y + plane[5]) / depth};
}

/// What remains of each sighting, in doubts.
Eigen::VectorXd rests(const View& view, const std::vector<Sighting>& sightings) {
  std::vector<double> rest;
  for (const Sighting& seen : sightings) {
    const Vec2 off = (view.pixel_of(seen.place) - seen.pixel) / seen.doubt;
    if (seen.normal.squaredNorm() > 0) {
      rest.push_back(off.dot(seen.normal));
    } else {
      rest.push_back(off.x());
      rest.push_back(off.y());
    }
  }
  return Eigen::Map<Eigen::VectorXd>(rest.data(), static_cast<Eigen::Index>(rest.size()));
}

double robust_sum(const Eigen::VectorXd& rest) {
  double sum = 0;
  for (const double r : rest) sum += std::abs(r) <= far_off ? r * r : far_off * (2 * std::abs(r) - far_off);
  return sum;
}

/// Moves the view to where the robust sum is least. Returns what remains there.
Eigen::VectorXd settle(View& view, const std::vector<Sighting>& sightings, std::size_t lens) {
  const auto free = static_cast<Eigen::Index>(View::freedoms - 2 + lens);
  Eigen::VectorXd rest = rests(view, sightings);
  double sum = robust_sum(rest), damping = 1e-3;
  for (int step = 0; step < most_view_steps && damping < 1e6; ++step) {
    Eigen::MatrixXd slopes(rest.size(), free);
    for (Eigen::Index i = 0; i < free; ++i) {
      View::Numbers moved = view.numbers();
      const double by = i < 8 ? 0.01 : 1e-5;
      moved[static_cast<std::size_t>(i)] += by;
      View other = view;
      other.set(moved);
      slopes.col(i) = (rests(other, sightings) - rest) / by;
    }
    const Eigen::VectorXd weights =
        rest.unaryExpr([](double r) { return std::abs(r) <= far_off ? 1.0 : far_off / std::abs(r); });
    const Eigen::MatrixXd weighted = weights.asDiagonal() * slopes;
    Eigen::MatrixXd normal = slopes.transpose() * weighted;
    normal.diagonal() *= 1 + damping;
    normal.diagonal().array() += 1e-12;
    const Eigen::VectorXd change = normal.ldlt().solve(-weighted.transpose() * rest);
    View::Numbers moved = view.numbers();
    for (Eigen::Index i = 0; i < free; ++i) moved[static_cast<std::size_t>(i)] += change(i);
    View other = view;
    other.set(moved);
    const Eigen::VectorXd new_rest = rests(other, sightings);
    const double new_sum = robust_sum(new_rest);
    if (!(new_sum < sum)) {
      damping *= 10;
      continue;
    }
    const bool settled = sum - new_sum < 1e-7 * sum;
    view = other, rest = new_rest, sum = new_sum, damping = std::max(1e-9, damping / 5);
    if (settled) break;
  }
  return rest;
}

}  // namespace

View::View(const core::Box& box, const std::array<Vec2, 4>& corners, const Vec2& size)
    : box_(box), middle_(size / 2), half_diagonal_(size.norm() / 2) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    numbers_[2 * i] = corners[i].x();
    numbers_[2 * i + 1] = corners[i].y();
  }
  solve();
}

void View::set(const Numbers& numbers) {
  numbers_ = numbers;
  solve();
}

void View::solve() {
  // The bed's box is mapped as the square from -1 to 1, which keeps the numbers of one size.
  const Vec2 corners[4] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  Eigen::Matrix<double, 8, 8> matrix = Eigen::Matrix<double, 8, 8>::Zero();
  Eigen::Matrix<double, 8, 1> right;
  for (int i = 0; i < 4; ++i) {
    const double x = corners[i].x(), y = corners[i].y(), u = numbers_[static_cast<std::size_t>(2 * i)],
                 v = numbers_[static_cast<std::size_t>(2 * i + 1)];
    matrix.row(2 * i) << x, y, 1, 0, 0, 0, -u * x, -u * y;
    matrix.row(2 * i + 1) << 0, 0, 0, x, y, 1, -v * x, -v * y;
    right(2 * i) = u;
    right(2 * i + 1) = v;
  }
  const Eigen::Matrix<double, 8, 1> solved = matrix.partialPivLu().solve(right);
  std::copy(solved.begin(), solved.end(), plane_.begin());
}

Vec2 View::pixel_of(const Vec2& place) const {
  const Vec2 in_box = 2 * (place - box_.center()).cwiseQuotient(box_.size());
  const Vec2 off = projected(plane_, in_box) - middle_;
  const double squared = off.squaredNorm() / (half_diagonal_ * half_diagonal_);
  return middle_ + off * (1 + numbers_[8] * squared + numbers_[9] * squared * squared);
}

std::array<Vec2, 2> View::steps_at(const Vec2& place) const {
  constexpr double step = 0.01;  // mm
  const Vec2 x(step / 2, 0), y(0, step / 2);
  return {(pixel_of(place + x) - pixel_of(place - x)) / step,
          (pixel_of(place + y) - pixel_of(place - y)) / step};
}

double View::scale_at(const Vec2& place) const {
  const auto [x, y] = steps_at(place);
  Eigen::Matrix2d steps;
  steps << x.x(), y.x(), x.y(), y.y();
  return steps.jacobiSvd().singularValues()(1);
}

bool View::possible() const {
  const Vec2 low = box_.min, high = box_.max;
  for (const Vec2& corner : {low, Vec2(high.x(), low.y()), high, Vec2(low.x(), high.y())}) {
    const Vec2 in_box = 2 * (corner - box_.center()).cwiseQuotient(box_.size());
    if (plane_[6] * in_box.x() + plane_[7] * in_box.y() + 1 < 0.1) return false;
    const auto [x, y] = steps_at(corner);
    // The bed's y goes up and the photo's goes down, so what is seen from above turns the other way.
    if (!(x.x() * y.y() - x.y() * y.x() < 0)) return false;
  }
  return true;
}

double fit_view(View& view, const std::vector<Sighting>& sightings, std::size_t lens) {
  settle(view, sightings, lens);
  // Mistaken sightings pull a little, however far off they are; so they are left out in the end.
  std::vector<Sighting> kept;
  for (const Sighting& one : sightings) {
    if (rests(view, {one}).norm() <= mistaken) kept.push_back(one);
  }
  if (2 * kept.size() < sightings.size()) kept = sightings;
  const Eigen::VectorXd rest = settle(view, kept, lens);
  return rest.size() > 0 ? std::sqrt(rest.squaredNorm() / static_cast<double>(rest.size())) : 0;
}

}  // namespace unicursal::host
