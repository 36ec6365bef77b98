#include "core/picture/reflectance.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace unicursal::picture {
namespace {

using Triple = Eigen::Vector3d;
using Slopes = Eigen::Matrix<double, bands, 3>;
using PerBand = Eigen::Matrix<double, bands, 1>;

constexpr double small_curve = 1e-9;  ///< weight of the parabola's numbers, so that white has finite ones
constexpr double settled = 1e-4;      ///< part by which a step has to lessen what is left

const Eigen::Map<const Eigen::Matrix<double, 3, bands, Eigen::RowMajor>> seen(seen_of_band[0].data());

/// Differences of these are about alike to the eye.
Triple to_eye(const Triple& light) {
  return light.unaryExpr([](double v) { return std::cbrt(v); });
}

/// The parabola a t² + b t + c, with t from −1 to 1 across the spectrum, and its sigmoid.
class Curve {
 public:
  explicit Curve(const Triple& numbers) : numbers_(numbers) {
    for (std::size_t k = 0; k < bands; ++k) {
      const double t = place(k), x = (numbers[0] * t + numbers[1]) * t + numbers[2];
      reflected_[index(k)] = 0.5 + 0.5 * x / std::sqrt(1 + x * x);
    }
  }

  const PerBand& reflected() const { return reflected_; }

  Slopes slopes() const {
    Slopes slopes;
    for (std::size_t k = 0; k < bands; ++k) {
      const double t = place(k), x = (numbers_[0] * t + numbers_[1]) * t + numbers_[2];
      slopes.row(index(k)) = 0.5 * std::pow(1 + x * x, -1.5) * Eigen::RowVector3d(t * t, t, 1);
    }
    return slopes;
  }

 private:
  static Eigen::Index index(std::size_t k) { return static_cast<Eigen::Index>(k); }
  static double place(std::size_t k) { return 2 * double(k) / double(bands - 1) - 1; }

  Triple numbers_;
  PerBand reflected_;
};

/// A grey of the same brightness.
Triple first_guess(const Triple& wanted) {
  const double grey = std::clamp(wanted.dot(Triple(0.2127, 0.7152, 0.0722)), 0.01, 0.98);
  const double sine = 2 * grey - 1;
  return {0, 0, sine / std::sqrt(1 - sine * sine)};
}

}  // namespace

Reflectance reflectance_of(const Light& light) {
  constexpr int most_rounds = 60;
  const Triple linear(light[0], light[1], light[2]), wanted = to_eye(linear);
  const auto cost_of = [&](const Triple& numbers) {
    return (to_eye(seen * Curve(numbers).reflected()) - wanted).squaredNorm() +
           small_curve * numbers.squaredNorm();
  };
  Triple here = first_guess(linear);
  double cost = cost_of(here), damping = 1e-4;
  for (int round = 0; round < most_rounds; ++round) {
    const Curve curve(here);
    const Triple made = seen * curve.reflected(), away = to_eye(made) - wanted;
    Eigen::Matrix3d slopes = seen * curve.slopes();
    for (Eigen::Index c = 0; c < 3; ++c)
      slopes.row(c) /= 3 * std::max(std::pow(std::abs(made[c]), 2.0 / 3), 1e-4);
    Eigen::Matrix3d normal = slopes.transpose() * slopes;
    normal.diagonal().array() += small_curve;
    normal.diagonal() *= 1 + damping;
    const Triple there = here - normal.ldlt().solve(slopes.transpose() * away + small_curve * here);
    const double reached = cost_of(there);
    damping *= reached < cost ? 0.3 : 5;
    if (!(reached < cost)) continue;
    const bool done = cost - reached < settled * cost;
    here = there;
    cost = reached;
    if (done) break;
  }
  Reflectance result{};
  const Curve curve(here);
  for (std::size_t k = 0; k < bands; ++k) result[k] = curve.reflected()[static_cast<Eigen::Index>(k)];
  return result;
}

Light light_of(const Reflectance& reflectance) {
  Light light{};
  for (std::size_t c = 0; c < light.size(); ++c)
    for (std::size_t k = 0; k < bands; ++k) light[c] += seen_of_band[c][k] * reflectance[k];
  return light;
}

}  // namespace unicursal::picture
