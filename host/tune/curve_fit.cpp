#include "host/tune/curve_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include "core/error.hpp"

namespace unicursal::host {
namespace {

constexpr double fewest_tanks = 1, largest_tanks = 6;
constexpr double least_mixing_volume = 0.05;  ///< mm³
constexpr double profile_share = 0.95;        ///< where the profile's mixing volume ends
constexpr double smallest_change = 1e-3;      ///< logarithms need more than 0
constexpr int fit_steps = 60;
constexpr int repetitions = 40;
constexpr std::size_t block = 12;  ///< neighbouring points err alike
/// Besides what the points scatter: the places in the photo and the volumes that the printer feeds.
constexpr double volume_doubt = 0.02, volume_doubt_share = 0.01, tank_doubt_share = 0.04;

struct Nozzle {
  double dead = 0, mixing = 1, tanks = 2;
};

/// The share that has arrived, tabulated over tanks and (volume − dead) ÷ mixing.
class Responses {
 public:
  Responses() {
    for (std::size_t k = 0; k < rows; ++k) {
      const double tanks = fewest_tanks + tank_spacing * static_cast<double>(k);
      const double whole = gamma_quantile(tanks, profile_share);
      for (std::size_t i = 0; i < columns; ++i)
        shares_.push_back(boost::math::gamma_p(tanks, whole * volume_spacing * static_cast<double>(i)));
    }
  }

  double operator()(double tanks, double part) const {
    if (part <= 0) return 0;
    const double row =
        std::clamp((tanks - fewest_tanks) / tank_spacing, 0.0, static_cast<double>(rows - 1) - 1e-9);
    const double column = std::min(part / volume_spacing, static_cast<double>(columns - 1) - 1e-9);
    const auto k = static_cast<std::size_t>(row), i = static_cast<std::size_t>(column);
    const double across = row - static_cast<double>(k), along = column - static_cast<double>(i);
    const auto at = [&](std::size_t r, std::size_t c) { return shares_[r * columns + c]; };
    return (1 - across) * ((1 - along) * at(k, i) + along * at(k, i + 1)) +
           across * ((1 - along) * at(k + 1, i) + along * at(k + 1, i + 1));
  }

 private:
  static constexpr double tank_spacing = 0.05, volume_spacing = 0.004;
  static constexpr std::size_t rows = 101, columns = 1001;
  std::vector<double> shares_;
};

double responded(const Nozzle& nozzle, double passed) {
  static const Responses responses;
  return responses(nozzle.tanks, (passed - nozzle.dead) / nozzle.mixing);
}

double logit(double p) {
  const double inside = std::clamp(p, smallest_change, 1 - smallest_change);
  return std::log(inside / (1 - inside));
}

/// How a colour answers to a share.
class Answer {
 public:
  explicit Answer(const std::array<double, 3>& anchors) {
    const double shares[] = {perception.began, perception.half, perception.stopped};
    for (std::size_t i = 0; i < 3; ++i) {
      places_[i] = logit(shares[i]);
      lifts_[i] = logit(anchors[i]) - places_[i];
    }
  }

  double operator()(double share) const {
    if (share <= 0) return 0;
    if (share >= 1) return 1;
    const double z = std::log(share / (1 - share));
    const double inside = std::clamp(z, places_[0], places_[2]);
    // The parabola through the three.
    double lift = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      double part = lifts_[i];
      for (std::size_t j = 0; j < 3; ++j) {
        if (j != i) part *= (inside - places_[j]) / (places_[i] - places_[j]);
      }
      lift += part;
    }
    return 1 / (1 + std::exp(-(z + lift)));
  }

 private:
  std::array<double, 3> places_{}, lifts_{};
};

double median_magnitude(const Eigen::VectorXd& rest, const std::vector<CurvePoint>& points) {
  std::vector<double> sizes;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].trust > 0) sizes.push_back(std::abs(rest(static_cast<Eigen::Index>(i))));
  }
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle;
}

struct Fitted {
  Nozzle nozzle;
  double cost = 0;
  double scatter = 0;
};

/// From a first guess to the nearest best nozzle.
class CurveFitter {
 public:
  CurveFitter(const std::vector<CurvePoint>& points, const Answer& answer, double scatter)
      : points_(points), answer_(answer), scatter_(scatter) {}

  Fitted from(const Nozzle& guess) const {
    Nozzle nozzle = guess;
    Eigen::VectorXd rest = rests(nozzle);
    double cost = cost_of(rest), damping = 1e-2;
    for (int step = 0; step < fit_steps && damping < 1e8; ++step) {
      const Eigen::VectorXd weights = weights_of(rest);
      Eigen::MatrixXd slopes(rest.size(), 3);
      constexpr double by = 1e-3;
      slopes.col(0) = (rests({nozzle.dead + by, nozzle.mixing, nozzle.tanks}) - rest) / by;
      slopes.col(1) = (rests({nozzle.dead, nozzle.mixing + by, nozzle.tanks}) - rest) / by;
      const double side = nozzle.tanks + by < largest_tanks ? by : -by;
      slopes.col(2) = (rests({nozzle.dead, nozzle.mixing, nozzle.tanks + side}) - rest) / side;
      Eigen::Matrix3d normal = slopes.transpose() * weights.asDiagonal() * slopes;
      normal.diagonal() *= 1 + damping;
      normal.diagonal().array() += 1e-12;
      const Eigen::Vector3d change = normal.ldlt().solve(-slopes.transpose() * weights.asDiagonal() * rest);
      const Nozzle moved{std::max(0.0, nozzle.dead + change(0)),
                         std::max(least_mixing_volume, nozzle.mixing + change(1)),
                         std::clamp(nozzle.tanks + change(2), fewest_tanks, largest_tanks)};
      const Eigen::VectorXd new_rest = rests(moved);
      const double new_cost = cost_of(new_rest);
      if (!(new_cost < cost)) {
        damping *= 8;
        continue;
      }
      const bool settled = cost - new_cost < 1e-8 * cost;
      nozzle = moved, rest = new_rest, cost = new_cost, damping = std::max(1e-9, damping / 5);
      if (settled) break;
    }
    return {nozzle, cost, median_magnitude(rest, points_) * 1.4826};
  }

 private:
  static constexpr double bend = 2;  ///< scatters beyond which a point pulls no more strongly

  Eigen::VectorXd rests(const Nozzle& nozzle) const {
    Eigen::VectorXd rest(static_cast<Eigen::Index>(points_.size()));
    for (std::size_t i = 0; i < points_.size(); ++i)
      rest(static_cast<Eigen::Index>(i)) = answer_(responded(nozzle, points_[i].passed)) - points_[i].change;
    return rest;
  }
  double cost_of(const Eigen::VectorXd& rest) const {
    double sum = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const double r = std::abs(rest(static_cast<Eigen::Index>(i))) / scatter_;
      sum += points_[i].trust * (r <= bend ? r * r : bend * (2 * r - bend));
    }
    return sum;
  }
  Eigen::VectorXd weights_of(const Eigen::VectorXd& rest) const {
    Eigen::VectorXd weights(rest.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const double r = std::abs(rest(static_cast<Eigen::Index>(i))) / scatter_;
      weights(static_cast<Eigen::Index>(i)) = points_[i].trust * (r <= bend ? 1 : bend / r);
    }
    return weights;
  }

  const std::vector<CurvePoint>& points_;
  const Answer& answer_;
  const double scatter_;
};

/// Where the change of colour first reaches `level` for good: most of the points around are beyond it.
std::optional<double> first_beyond(const std::vector<CurvePoint>& points, double level) {
  constexpr std::size_t around = 4;
  for (std::size_t i = 0; i + around < points.size(); ++i) {
    std::size_t beyond = 0;
    for (std::size_t j = i; j <= i + around; ++j) beyond += points[j].change >= level ? 1 : 0;
    if (beyond > around / 2) return points[i].passed;
  }
  return std::nullopt;
}

Fitted best_fit(const std::vector<CurvePoint>& points, const Answer& answer, double scatter,
                const std::vector<Nozzle>& guesses) {
  std::optional<Fitted> best;
  for (const Nozzle& guess : guesses) {
    const Fitted fitted = CurveFitter(points, answer, scatter).from(guess);
    if (!best || fitted.cost < best->cost) best = fitted;
  }
  return *best;
}

/// Distributions of the standard library differ between its makers; its generators do not.
class Chance {
 public:
  double uniform() { return (static_cast<double>(bits_()) + 0.5) / 4294967296.0; }
  double normal() { return std::sqrt(-2 * std::log(uniform())) * std::cos(2 * std::numbers::pi * uniform()); }

 private:
  std::mt19937 bits_{20};
};

double deviation(const std::vector<double>& values, double middle) {
  double squares = 0;
  for (const double value : values) squares += (value - middle) * (value - middle);
  return std::sqrt(squares / static_cast<double>(values.size()));
}

/// Fits again and again with errors of the size that was seen, in blocks.
std::array<double, 3> doubts_of(const std::vector<CurvePoint>& points, const CurveAnchors& anchors,
                                const Answer& answer, const Fitted& found) {
  Chance chance;
  std::vector<double> dead, mixing, tanks;
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    std::array<double, 3> moved = anchors.change;
    for (std::size_t i = 0; i < 3; ++i) moved[i] += anchors.doubt[i] * chance.normal();
    std::vector<CurvePoint> again = points;
    for (std::size_t first = 0; first < points.size(); first += block) {
      const auto from = static_cast<std::size_t>(chance.uniform() * static_cast<double>(points.size()));
      for (std::size_t i = first; i < std::min(first + block, points.size()); ++i) {
        const CurvePoint& other = points[(from + i - first) % points.size()];
        const double rest = other.change - answer(responded(found.nozzle, other.passed));
        again[i].change = answer(responded(found.nozzle, points[i].passed)) +
                          std::clamp(rest, -4 * found.scatter, 4 * found.scatter);
      }
    }
    const Nozzle nozzle = best_fit(again, Answer(moved), found.scatter, {found.nozzle}).nozzle;
    dead.push_back(nozzle.dead), mixing.push_back(nozzle.mixing), tanks.push_back(nozzle.tanks);
  }
  return {deviation(dead, found.nozzle.dead), deviation(mixing, found.nozzle.mixing),
          deviation(tanks, found.nozzle.tanks)};
}

Estimate estimate(double value, double deviation, double floor) {
  return {value, 2 * std::hypot(deviation, floor)};
}

}  // namespace

CurveFit fit_curve(const std::vector<CurvePoint>& points, const CurveAnchors& anchors) {
  const auto began = first_beyond(points, anchors.change[0]);
  const auto stopped = first_beyond(points, anchors.change[2]);
  if (!began || !stopped)
    throw core::DataError("", "the strip", "still changes colour at its end",
                          "print again with a larger --range");
  const Answer answer(anchors.change);
  const double way = std::max(0.2, *stopped - *began);
  std::vector<Nozzle> guesses;
  for (const double tanks : {1.2, 2.0, 3.5, 5.5})
    guesses.push_back({std::max(0.0, *began - 0.1 * way), way, tanks});
  // The first fit finds the scatter, the second uses it.
  const double first_scatter = best_fit(points, answer, 0.02, guesses).scatter;
  const double scatter = std::max(2e-3, first_scatter);
  const Fitted found = best_fit(points, answer, scatter, guesses);
  constexpr double most_scatter = 0.12;
  if (found.scatter > most_scatter)
    throw core::DataError("", "the strip", "does not change colour as a mixing nozzle does",
                          "take the photo again in even light, without glare on the bead");
  const auto [dead, mixing, tanks] = doubts_of(points, anchors, answer, found);
  const Nozzle& nozzle = found.nozzle;
  const double floor = volume_doubt + volume_doubt_share * (nozzle.dead + nozzle.mixing);
  CurveFit fit;
  fit.dead = estimate(nozzle.dead, dead, floor);
  fit.mixing = estimate(nozzle.mixing, mixing, floor);
  fit.tanks = estimate(nozzle.tanks, tanks, tank_doubt_share * nozzle.tanks);
  fit.scatter = found.scatter;
  fit.anchors = anchors;
  return fit;
}

double CurveFit::change_after(double passed) const {
  return Answer(anchors.change)(responded({dead.value, mixing.value, tanks.value}, passed));
}

}  // namespace unicursal::host
