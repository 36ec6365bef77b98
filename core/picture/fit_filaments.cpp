#include "core/picture/fit_filaments.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

namespace unicursal::picture {
namespace {

constexpr std::size_t channels = 3;
constexpr double together = 0.1;  ///< least shares of two filaments that show their loss
constexpr double doubtful = 2.5;  ///< ΔE by which a mixture counts half
/// How far the numbers usually lie from their usual values. Those of one filament or two are alike in all
/// channels; how far they lie from their mean is the second number.
constexpr double lift_range = 0.5;  ///< of its logarithm
constexpr double strength_range = 0.8, strength_spread = 0.4;
constexpr double loss_range = 0.5, loss_spread = 0.3;
constexpr double pure_range = 0.5;
constexpr double least_light = 0.0015;
/// What numbers may become; beyond that the law means nothing.
constexpr double most_lift = 1.5, most_strength = 4;  // logarithms
constexpr double alike = 3;                           ///< ΔE within which all mixtures look the same

/// Steps of lightness, chroma and hue that are alike to the eye, as for ΔE2000, about a measured colour.
class Eye {
 public:
  explicit Eye(const Lab& seen) : seen_(seen), chroma_(std::hypot(seen.a, seen.b)) {
    cosine_ = chroma_ > 0 ? seen.a / chroma_ : 1;
    sine_ = chroma_ > 0 ? seen.b / chroma_ : 0;
  }

  std::array<double, channels> away(const Lab& made) const {
    const double middle = (seen_.lightness - 50) * (seen_.lightness - 50);
    const double l = made.lightness - seen_.lightness, a = made.a - seen_.a, b = made.b - seen_.b;
    return {l / (1 + 0.015 * middle / std::sqrt(20 + middle)),
            (a * cosine_ + b * sine_) / (1 + 0.045 * chroma_),
            (b * cosine_ - a * sine_) / (1 + 0.015 * chroma_)};
  }

 private:
  const Lab seen_;
  const double chroma_;
  double cosine_, sine_;
};

/// The numbers of the law in one vector, 0 where they are usual.
class Numbers {
 public:
  Numbers(std::span<const Light> pure, std::span<const MeasuredMixture> measured, PureColours colours)
      : pure_(pure.begin(), pure.end()), fitted_(colours == PureColours::fitted) {
    for (std::size_t one = 0; one < pure.size(); ++one) {
      for (std::size_t other = one + 1; other < pure.size(); ++other) {
        const auto shows_loss = [&](const MeasuredMixture& mixture) {
          return mixture.shares[one] >= together && mixture.shares[other] >= together;
        };
        if (std::any_of(measured.begin(), measured.end(), shows_loss)) pairs_.emplace_back(one, other);
      }
    }
  }

  Eigen::Index size() const { return pure_at(fitted_ ? pure_.size() : 0); }

  Mixing mixing(const Eigen::VectorXd& numbers) const {
    Mixing mixing;
    mixing.lift = Mixing::usual_lift * std::exp(std::clamp(numbers[0], -most_lift, most_lift));
    for (std::size_t f = 0; f < pure_.size(); ++f) {
      Light& strength = mixing.strengths.emplace_back();
      for (std::size_t c = 0; c < channels; ++c) {
        strength[c] = std::exp(std::clamp(numbers[strength_at(f) + index(c)], -most_strength, most_strength));
      }
    }
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      Mixing::Pair& pair = mixing.pairs.emplace_back();
      pair.one = pairs_[i].first, pair.other = pairs_[i].second;
      for (std::size_t c = 0; c < channels; ++c) pair.loss[c] += numbers[pair_at(i) + index(c)];
    }
    return mixing;
  }

  std::vector<Light> pure(const Eigen::VectorXd& numbers) const {
    std::vector<Light> lights = pure_;
    for (std::size_t f = 0; fitted_ && f < lights.size(); ++f) {
      for (std::size_t c = 0; c < channels; ++c) {
        const double times = std::exp(numbers[pure_at(f) + index(c)]);
        lights[f][c] = std::clamp(std::max(least_light, lights[f][c]) * times, least_light, 1.0);
      }
    }
    return lights;
  }

  /// How unusual the numbers are, as residuals whose usual size is 1.
  Eigen::VectorXd unusual(const Eigen::VectorXd& numbers) const {
    Eigen::VectorXd result(1 + 4 * ((size() - 1) / 3));
    result[0] = numbers[0] / lift_range;
    for (Eigen::Index at = 1, to = 1; at < size(); at += 3, to += 4) {
      const bool strength = at < pair_at(0), pair = !strength && at < pure_at(0);
      const double range = strength ? strength_range : pair ? loss_range : pure_range;
      const double spread = strength ? strength_spread : pair ? loss_spread : pure_range;
      const double mean = numbers.segment<3>(at).mean();
      result[to] = mean / range;
      for (Eigen::Index c = 0; c < 3; ++c) result[to + 1 + c] = (numbers[at + c] - mean) / spread;
    }
    return result;
  }

 private:
  static Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }
  Eigen::Index strength_at(std::size_t filament) const { return 1 + index(channels * filament); }
  Eigen::Index pair_at(std::size_t pair) const { return strength_at(pure_.size()) + index(channels * pair); }
  Eigen::Index pure_at(std::size_t filament) const {
    return pair_at(pairs_.size()) + index(channels * filament);
  }

  std::vector<Light> pure_;
  bool fitted_;
  std::vector<std::pair<std::size_t, std::size_t>> pairs_;
};

class Fit {
 public:
  Fit(std::span<const Light> pure, std::span<const MeasuredMixture> measured, PureColours colours)
      : measured_(measured), numbers_(pure, measured, colours) {
    for (const MeasuredMixture& mixture : measured) eyes_.emplace_back(lab_of(mixture.light));
  }

  FittedFilaments operator()() {
    Eigen::VectorXd here = Eigen::VectorXd::Zero(numbers_.size());
    double damping = 1e-2;
    for (int round = 0; round < most_rounds; ++round) {
      const double before = cost_of(here);
      if (!step(here, damping) || before - cost_of(here) < settled * before) break;
    }
    return result(here);
  }

 private:
  static constexpr int most_rounds = 200;
  static constexpr double settled = 1e-7, most_damping = 1e9;

  /// Goes where the cost is less. Returns false if no step leads there.
  bool step(Eigen::VectorXd& here, double& damping) const {
    const Eigen::VectorXd away = residuals(here);
    const Eigen::MatrixXd slopes = slopes_at(here, away);
    const Eigen::VectorXd weights = weights_of(away);
    const Eigen::MatrixXd normal = slopes.transpose() * weights.asDiagonal() * slopes;
    const Eigen::VectorXd down = slopes.transpose() * weights.cwiseProduct(away);
    const double cost = cost_of(here);
    for (; damping < most_damping; damping *= 4) {
      Eigen::MatrixXd damped = normal;
      damped.diagonal() *= 1 + damping;
      const Eigen::VectorXd there = here - damped.ldlt().solve(down);
      if (!(cost_of(there) < cost)) continue;  // false for NaN
      here = there;
      damping /= 10;
      return true;
    }
    return false;
  }

  Eigen::Index mixtures() const { return static_cast<Eigen::Index>(measured_.size()); }

  /// A doubtful mixture counts less. These weights make the sum of squares Cauchy's measure, near this place.
  Eigen::VectorXd weights_of(const Eigen::VectorXd& away) const {
    Eigen::VectorXd weights = Eigen::VectorXd::Ones(away.size());
    for (Eigen::Index i = 0; i < mixtures(); ++i)
      weights.segment<3>(3 * i).setConstant(
          1 / (1 + away.segment<3>(3 * i).squaredNorm() / (doubtful * doubtful)));
    return weights;
  }

  double cost_of(const Eigen::VectorXd& numbers) const {
    const Eigen::VectorXd away = residuals(numbers);
    double cost = away.tail(away.size() - 3 * mixtures()).squaredNorm();
    for (Eigen::Index i = 0; i < mixtures(); ++i)
      cost += doubtful * doubtful * std::log1p(away.segment<3>(3 * i).squaredNorm() / (doubtful * doubtful));
    return cost;
  }

  /// Three of each mixture; then how unusual the numbers are.
  Eigen::VectorXd residuals(const Eigen::VectorXd& numbers) const {
    const std::vector<Light> pure = numbers_.pure(numbers);
    const Filaments filaments(std::span<const Light>(pure), numbers_.mixing(numbers));
    const Eigen::VectorXd unusual = numbers_.unusual(numbers);
    Eigen::VectorXd result(3 * mixtures() + unusual.size());
    for (std::size_t i = 0; i < measured_.size(); ++i) {
      const auto away = eyes_[i].away(lab_of(mixed_light(measured_[i].shares, filaments)));
      for (std::size_t c = 0; c < channels; ++c)
        result[static_cast<Eigen::Index>(3 * i + c)] = away[c] / measured_[i].noise;
    }
    result.tail(unusual.size()) = unusual;
    return result;
  }

  Eigen::MatrixXd slopes_at(const Eigen::VectorXd& here, const Eigen::VectorXd& away) const {
    constexpr double by = 1e-5;
    Eigen::MatrixXd slopes(away.size(), here.size());
    for (Eigen::Index i = 0; i < here.size(); ++i) {
      Eigen::VectorXd there = here;
      there[i] += by;
      slopes.col(i) = (residuals(there) - away) / by;
    }
    return slopes;
  }

  FittedFilaments result(const Eigen::VectorXd& here) const {
    FittedFilaments fitted;
    fitted.mixing = numbers_.mixing(here);
    const std::vector<Light> pure = numbers_.pure(here);
    for (const Light& light : pure) fitted.pure.push_back(colour_of(light));
    const Filaments filaments(std::span<const Light>(pure), fitted.mixing);
    for (const MeasuredMixture& mixture : measured_)
      fitted.differences.push_back(
          difference(lab_of(mixture.light), lab_of(mixed_light(mixture.shares, filaments))));
    return fitted;
  }

  std::span<const MeasuredMixture> measured_;
  Numbers numbers_;
  std::vector<Eye> eyes_;
};

bool enough(std::size_t filaments, std::span<const MeasuredMixture> measured) {
  if (measured.size() < filaments + 2) return false;
  for (std::size_t f = 0; f < filaments; ++f) {
    const auto mixed = [f](const MeasuredMixture& mixture) {
      return mixture.shares[f] >= together && mixture.shares[f] <= 1 - together;
    };
    if (std::none_of(measured.begin(), measured.end(), mixed)) return false;
  }
  const Lab first = lab_of(measured.front().light);
  return std::any_of(measured.begin(), measured.end(), [&](const MeasuredMixture& mixture) {
    return difference(first, lab_of(mixture.light)) > alike;
  });
}

FittedFilaments fitted_to(std::span<const Colour> pure, std::span<const MeasuredMixture> measured,
                          PureColours colours) {
  std::vector<Light> lights;
  for (const Colour& colour : pure) lights.push_back(light_of(colour));
  return Fit(lights, measured, colours)();
}

}  // namespace

std::optional<FittedFilaments> fit_filaments(std::span<const Colour> pure,
                                             std::span<const MeasuredMixture> measured, PureColours colours) {
  if (!enough(pure.size(), measured)) return std::nullopt;
  if (colours == PureColours::kept) return fitted_to(pure, measured, PureColours::kept);
  // The colours are rounded to bytes; the other numbers are then those that suit the rounded ones.
  const std::vector<Colour> found = fitted_to(pure, measured, PureColours::fitted).pure;
  return fitted_to(found, measured, PureColours::kept);
}

}  // namespace unicursal::picture
