#include "host/photo/even_light.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace unicursal::host {
namespace {

constexpr double noise_floor = 0.002;   ///< linear; below it a camera's noise is larger than the light
constexpr double trusted_light = 0.05;  ///< linear; darker places have noisier logarithms
constexpr double expected_scatter = 0.03;
constexpr double stiffness = 1e-3;  ///< keeps the polynomial flat where nothing is known
constexpr int light_rounds = 8;
constexpr double nearby = 12;      ///< mm; standard deviation of the weights of known places
constexpr double believed_at = 4;  ///< known places at which half of what they have in common is believed
/// Least numbers of places for polynomials of the first, second and third degree.
constexpr std::size_t for_degree[] = {3, 12, 40};
constexpr std::size_t terms_of_degree[] = {2, 5, 9};

double logarithm(double light) {
  return std::log(std::max(noise_floor, light));
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

EvenLight::EvenLight(const std::vector<KnownPlace>& known, const core::Box& box) : box_(box) {
  for (std::size_t degree = 0; degree < std::size(for_degree); ++degree) {
    if (known.size() >= for_degree[degree]) terms_ = terms_of_degree[degree];
  }
  std::size_t materials = 0;
  for (const KnownPlace& one : known) materials = std::max(materials, one.material + 1);
  const auto rows = static_cast<Eigen::Index>(known.size());
  const auto terms = static_cast<Eigen::Index>(terms_),
             columns = terms + static_cast<Eigen::Index>(materials);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(rows, columns);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const KnownPlace& one = known[static_cast<std::size_t>(i)];
    const std::vector<double> values = terms_of(one.place);
    for (Eigen::Index t = 0; t < terms; ++t) matrix(i, t) = values[static_cast<std::size_t>(t)];
    matrix(i, terms + static_cast<Eigen::Index>(one.material)) = 1;
  }
  for (std::size_t channel = 0; channel < 3; ++channel) {
    Eigen::VectorXd light(rows), trust(rows);
    for (Eigen::Index i = 0; i < rows; ++i) {
      const double seen = known[static_cast<std::size_t>(i)].light[channel];
      light(i) = logarithm(seen);
      trust(i) = std::clamp(seen / trusted_light, 0.05, 1.0);
    }
    Eigen::VectorXd weights = trust, solved;
    for (int round = 0; round < light_rounds; ++round) {
      Eigen::MatrixXd normal = matrix.transpose() * weights.asDiagonal() * matrix;
      normal.diagonal().head(terms).array() += stiffness * static_cast<double>(rows);
      normal.diagonal().array() += 1e-9;
      solved = normal.ldlt().solve(matrix.transpose() * weights.asDiagonal() * light);
      const Eigen::VectorXd rest = (light - matrix * solved).cwiseProduct(trust).cwiseAbs();
      const double scatter =
          std::max(expected_scatter / 4, 1.5 * median_of(std::vector<double>(rest.begin(), rest.end())));
      for (Eigen::Index i = 0; i < rows; ++i) {
        const double far = rest(i) / (4 * scatter);
        weights(i) = far < 1 ? trust(i) * (1 - far * far) * (1 - far * far) : 0;
      }
    }
    polynomials_[channel].assign(solved.begin(), solved.begin() + terms);
    const Eigen::VectorXd rest = light - matrix * solved;
    rests_.resize(known.size());
    for (std::size_t i = 0; i < known.size(); ++i) {
      rests_[i].place = known[i].place;
      rests_[i].logarithm[channel] = rest(static_cast<Eigen::Index>(i));
      rests_[i].weight[channel] = weights(static_cast<Eigen::Index>(i));
    }
  }
}

std::vector<double> EvenLight::terms_of(const core::Vec2& place) const {
  const core::Vec2 at = 2 * (place - box_.center()).cwiseQuotient(box_.size());
  const double x = at.x(), y = at.y();
  std::vector<double> terms{x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y};
  terms.resize(terms_);
  return terms;
}

picture::Light EvenLight::brightness(const core::Vec2& place) const {
  const std::vector<double> terms = terms_of(place);
  picture::Light logarithms{};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    for (std::size_t t = 0; t < terms.size(); ++t) logarithms[channel] += polynomials_[channel][t] * terms[t];
    double common = 0, weights = believed_at;
    for (const Rest& rest : rests_) {
      const double weight =
          rest.weight[channel] * std::exp(-(rest.place - place).squaredNorm() / (2 * nearby * nearby));
      common += weight * rest.logarithm[channel];
      weights += weight;
    }
    logarithms[channel] += common / weights;
  }
  return logarithms;
}

picture::Light EvenLight::evened(const core::Vec2& place, const picture::Light& seen) const {
  const picture::Light logarithms = brightness(place);
  picture::Light light{};
  for (std::size_t channel = 0; channel < 3; ++channel)
    light[channel] = seen[channel] / std::exp(logarithms[channel]);
  return light;
}

}  // namespace unicursal::host
