#include "host/tune/colour_answer.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/picture/lab.hpp"

namespace unicursal::host {
namespace {

constexpr double smallest_change = 1e-3;    ///< logarithms need more than 0
constexpr double darkest_light = 0.003;     ///< linear; below it a camera's noise is larger than the light
constexpr double least_channel_step = 0.3;  ///< of the step of the channel that changes most
constexpr double knot_distance = 1.4;  ///< of logits; the knots lie near 1.5, 6, 20, 50, 80, 94 and 98.5 %
constexpr double outermost_knot = 3 * knot_distance;

double logit(double p) {
  const double inside = std::clamp(p, smallest_change, 1 - smallest_change);
  return std::log(inside / (1 - inside));
}

double log_light(double encoded) {
  return std::log(std::max(darkest_light, picture::decoded(encoded)));
}

/// The smoothest law that agrees with the lines, as far as they are certain.
ColourLaw law_of(const ReferenceColours::Lines& lines, std::size_t channel) {
  constexpr auto n = static_cast<Eigen::Index>(ColourLaw::coefficients);
  ColourLaw law;
  law.from = log_light(lines.colour.front()[channel]);
  law.to = log_light(lines.colour.back()[channel]);
  const double way = law.to - law.from;
  const double encoded_way = std::abs(lines.colour.back()[channel] - lines.colour.front()[channel]);
  if (std::abs(way) < 1e-9 || encoded_way < 1e-9) return law;
  Eigen::MatrixXd normal = Eigen::MatrixXd::Identity(n, n) / (lift_usual * lift_usual);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  const auto add = [&](Eigen::Index first, const auto& row, double wanted, double doubt) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const Eigen::Index a = first + static_cast<Eigen::Index>(i);
      right(a) += row[i] * wanted / (doubt * doubt);
      for (std::size_t j = 0; j < row.size(); ++j)
        normal(a, first + static_cast<Eigen::Index>(j)) += row[i] * row[j] / (doubt * doubt);
    }
  };
  for (std::size_t i = 1; i + 1 < shade_count; ++i) {
    const double part = (log_light(lines.colour[i][channel]) - law.from) / way;
    // Near an end the doubt of a part is larger than its distance from the end.
    const double doubt =
        std::hypot(lines.doubt[i], lines.doubt[2 * i < shade_count ? 0 : shade_count - 1]) / encoded_way;
    const double inside = std::clamp(part, smallest_change, 1 - smallest_change);
    const auto [first, weights] = ColourLaw::weights_at(shade_shares[i]);
    add(static_cast<Eigen::Index>(first), weights, logit(part) - logit(shade_shares[i]),
        std::max(1e-3, doubt / std::max(doubt, inside * (1 - inside))));
  }
  for (Eigen::Index i = 0; i + 2 < n; ++i) add(i, std::array{1.0, -2.0, 1.0}, 0, lift_bend);
  for (Eigen::Index i = 0; i + 3 < n; ++i) add(i, std::array{-1.0, 3.0, -3.0, 1.0}, 0, lift_jerk);
  const Eigen::VectorXd solved = normal.ldlt().solve(right);
  std::copy(solved.begin(), solved.end(), law.lift.begin());
  return law;
}

}  // namespace

ColourLaw::Weights ColourLaw::weights_at(double share) {
  const double least = 1 / (1 + std::exp(outermost_knot));
  const double z = logit(std::clamp(share, least, 1 - least));
  const double at = std::clamp((z + outermost_knot) / knot_distance, 0.0, 6 - 1e-9);
  Weights weights;
  weights.first = static_cast<std::size_t>(at);
  const double t = at - static_cast<double>(weights.first), u = 1 - t;
  weights.of = {u * u * u / 6, (3 * t * t * t - 6 * t * t + 4) / 6, (3 * u * u * u - 6 * u * u + 4) / 6,
                t * t * t / 6};
  return weights;
}

double ColourLaw::gone(double share) const {
  if (share <= 0) return 0;
  if (share >= 1) return 1;
  const auto [first, weights] = weights_at(share);
  double z = std::log(share / (1 - share));
  for (std::size_t i = 0; i < weights.size(); ++i) z += weights[i] * lift[first + i];
  return 1 / (1 + std::exp(-z));
}

ColourAnswer::ColourAnswer(const ReferenceColours& references) {
  std::array<double, 3> steps{};
  for (std::size_t c = 0; c < 3; ++c) {
    thin_[c] = law_of(references.thin, c);
    fat_[c] = law_of(references.fat, c);
    const auto step = [&](const ReferenceColours::Lines& lines) {
      return lines.colour.back()[c] - lines.colour.front()[c];
    };
    // A channel whose direction depends on the width is of no use.
    const double thin = step(references.thin), fat = step(references.fat);
    steps[c] = thin * fat > 0 ? std::min(std::abs(thin), std::abs(fat)) : 0;
  }
  const double most = *std::max_element(steps.begin(), steps.end());
  for (std::size_t c = 0; c < 3; ++c) used_[c] = steps[c] > 0 && steps[c] >= least_channel_step * most;
}

Seen ColourAnswer::operator()(double share, double fat) const {
  Seen colour{};
  for (std::size_t c = 0; c < 3; ++c)
    colour[c] =
        picture::encoded(std::exp((1 - fat) * thin_[c].log_light(share) + fat * fat_[c].log_light(share)));
  return colour;
}

double ColourAnswer::change(const Seen& colour, double fat) const {
  const Seen from = (*this)(0, fat), to = (*this)(1, fat);
  double along = 0, whole = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    if (!used_[c]) continue;
    along += (colour[c] - from[c]) * (to[c] - from[c]);
    whole += (to[c] - from[c]) * (to[c] - from[c]);
  }
  return whole > 0 ? along / whole : 0;
}

}  // namespace unicursal::host
