#include "host/tune/curve_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <random>

#include "core/error.hpp"
#include "core/picture/lab.hpp"

namespace unicursal::host {
namespace {

constexpr double fewest_tanks = 1, largest_tanks = 6;
constexpr double least_mixing_volume = 0.05;  ///< mm³
constexpr double profile_share = 0.95;        ///< where the profile's mixing volume ends
constexpr double smallest_change = 1e-3;      ///< logarithms need more than 0
constexpr double darkest_light = 0.003;       ///< linear; below it a camera's noise is larger than the light
constexpr double first_traces = 0.015;        ///< share beyond which lifts are constant
constexpr double least_channel_step = 0.3;    ///< of the step of the channel that changes most
constexpr double end_doubt = 0.03;            ///< of a pure colour, encoded
constexpr double lane_doubt = 0.006;          ///< of the second pure colour on one lane, encoded
constexpr double usual_bend = 0.15;           ///< standard deviation of `bent`
/// How much these are believed: neighbouring points err alike, so that a thousand of them say no more than
/// some hundred.
constexpr double believed = 3;
constexpr int fit_steps = 60;
constexpr int repetitions = 40;
constexpr std::size_t block = 30;  ///< neighbouring points err alike
/// Besides what the points scatter: the places in the photo and the volumes that the printer feeds.
constexpr double volume_doubt = 0.02, volume_doubt_share = 0.01, tank_doubt_share = 0.2;

/// What is fitted: the nozzle, and by how much both pure colours of the strip differ from those of the lines.
struct Nozzle {
  double dead = 0, mixing = 1, tanks = 2;
  Seen low{}, bent{};
  Seen high{};
  std::array<Seen, CurveFit::most_lanes> lanes{};
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

std::array<double, 3> known_shares() {
  return {perception.began, perception.half, perception.stopped};
}

double log_light(double encoded) {
  return std::log(std::max(darkest_light, picture::decoded(encoded)));
}

/// Where a line can hardly be distinguished from a pure colour, the other two lines say more about it. After
/// the law of Kubelka and Munk, for pigments of 5 to 80 % reflectance and scattering of 1 : 2 to 2 : 1, the
/// lift at that end goes on by 0.15 to 0.35 of what it has gone on the other side, mostly 0.2.
void steady(std::array<double, 3>& lifts, const std::array<double, 3>& doubts, std::size_t weak) {
  constexpr double goes_on = 0.22, rule_doubt = 0.3;
  const double ruled = lifts[1] + goes_on * (lifts[1] - lifts[2 - weak]);
  const double trust = 1 / (doubts[weak] * doubts[weak]), rule_trust = 1 / (rule_doubt * rule_doubt);
  lifts[weak] = (trust * lifts[weak] + rule_trust * ruled) / (trust + rule_trust);
}

Seen foretold(const Nozzle& nozzle, const ColourAnswer& answer, const CurvePoint& point) {
  const double share = responded(nozzle, point.passed);
  Seen colour = answer(share, point.fat);
  const Seen& lane = nozzle.lanes[std::min(point.lane, CurveFit::most_lanes - 1)];
  for (std::size_t c = 0; c < 3; ++c) {
    const double bent = share * nozzle.bent[c] * point.brightness[c];
    if (bent != 0) colour[c] = picture::encoded(picture::decoded(std::max(0.0, colour[c])) * std::exp(bent));
    colour[c] += (1 - share) * nozzle.low[c] + share * (nozzle.high[c] + lane[c]);
  }
  return colour;
}

/// The median of the magnitudes, of what is not left out.
double median_magnitude(const Eigen::VectorXd& rest, const Eigen::VectorXd& trust) {
  std::vector<double> sizes;
  for (Eigen::Index i = 0; i < trust.size(); ++i) {
    if (trust(i) > 0) sizes.push_back(std::abs(rest(i)));
  }
  if (sizes.empty()) return 1;
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
  CurveFitter(const std::vector<CurvePoint>& points, const ColourAnswer& answer, double scatter)
      : points_(points),
        answer_(answer),
        scatter_(scatter),
        count_(static_cast<Eigen::Index>(3 * points.size())),
        trust_(Eigen::VectorXd::Ones(count_ + ends)) {
    for (Eigen::Index i = 0; i < count_; ++i) {
      const CurvePoint& point = points_[static_cast<std::size_t>(i / 3)];
      trust_(i) = answer_.uses(static_cast<std::size_t>(i % 3)) ? point.trust : 0;
    }
  }

  Fitted from(const Nozzle& guess) const {
    Nozzle nozzle = guess;
    Eigen::VectorXd rest = rests(nozzle);
    double cost = cost_of(rest), damping = 1e-2;
    for (int step = 0; step < fit_steps && damping < 1e8; ++step) {
      const Eigen::VectorXd weights = weights_of(rest);
      const Eigen::MatrixXd slopes = slopes_at(nozzle, rest);
      Eigen::MatrixXd normal = slopes.transpose() * weights.asDiagonal() * slopes;
      normal.diagonal() *= 1 + damping;
      normal.diagonal().array() += 1e-12;
      const Eigen::VectorXd change = normal.ldlt().solve(-slopes.transpose() * weights.asDiagonal() * rest);
      const Nozzle moved = limited(sum_of(nozzle, change));
      const Eigen::VectorXd new_rest = rests(moved);
      const double new_cost = cost_of(new_rest);
      if (!(new_cost < cost)) {
        damping *= 8;
        continue;
      }
      const bool settled = cost - new_cost < 1e-7 * cost;
      nozzle = moved, rest = new_rest, cost = new_cost, damping = std::max(1e-9, damping / 5);
      if (settled) break;
    }
    return {nozzle, cost, median_magnitude(rest, trust_.head(count_)) * 1.4826};
  }

 private:
  static constexpr double bend = 2;  ///< scatters beyond which a point pulls no more strongly
  static constexpr std::size_t loose_colours = 3 + CurveFit::most_lanes;
  static constexpr Eigen::Index ends = 3 * loose_colours, freedoms = 3 + ends;

  static Nozzle sum_of(const Nozzle& nozzle, const Eigen::VectorXd& change) {
    Nozzle sum = nozzle;
    sum.dead += change(0), sum.mixing += change(1), sum.tanks += change(2);
    Eigen::Index at = 3;
    for (Seen* seen : loose(sum)) {
      for (double& channel : *seen) channel += change(at++);
    }
    return sum;
  }
  /// What is fitted besides the nozzle.
  static std::array<Seen*, loose_colours> loose(Nozzle& nozzle) {
    std::array<Seen*, loose_colours> all{&nozzle.bent, &nozzle.low, &nozzle.high};
    for (std::size_t lane = 0; lane < CurveFit::most_lanes; ++lane) all[3 + lane] = &nozzle.lanes[lane];
    return all;
  }
  static Nozzle limited(Nozzle nozzle) {
    nozzle.dead = std::max(0.0, nozzle.dead);
    nozzle.mixing = std::max(least_mixing_volume, nozzle.mixing);
    nozzle.tanks = std::clamp(nozzle.tanks, fewest_tanks, largest_tanks);
    return nozzle;
  }

  /// By small steps for the nozzle and for what the camera bends; the other colours are simply added. A
  /// colour's channel changes the same channel of the points only, so that one step serves all three.
  Eigen::MatrixXd slopes_at(const Nozzle& nozzle, const Eigen::VectorXd& rest) const {
    constexpr double by = 1e-3;
    Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(rest.size(), freedoms);
    for (Eigen::Index i = 0; i < 3; ++i) {
      Eigen::VectorXd to = Eigen::VectorXd::Zero(freedoms);
      to(i) = i == 2 && nozzle.tanks + by >= largest_tanks ? -by : by;
      slopes.col(i) = (rests(sum_of(nozzle, to)) - rest) / to(i);
    }
    Nozzle bent = nozzle;
    for (double& channel : bent.bent) channel += by;
    const Eigen::VectorXd bending = (rests(bent) - rest) / by;
    for (Eigen::Index row = 0; row < count_; ++row) {
      const CurvePoint& point = points_[static_cast<std::size_t>(row / 3)];
      const double share = responded(nozzle, point.passed);
      const auto lane = static_cast<Eigen::Index>(std::min(point.lane, CurveFit::most_lanes - 1));
      const Eigen::Index channel = row % 3, first = 3 + channel;
      slopes(row, first) = bending(row);
      slopes(row, first + 3) = 1 - share;
      slopes(row, first + 6) = share;
      slopes(row, first + 9 + 3 * lane) = share;
    }
    for (Eigen::Index i = 0; i < ends; ++i) slopes(count_ + i, 3 + i) = belief(i);
    return slopes;
  }

  /// What a prior's row of the rests is for a colour of 1.
  double belief(Eigen::Index i) const {
    const double doubt = i < 3 ? usual_bend : i < 9 ? end_doubt : lane_doubt;
    return believed * scatter_ / doubt;
  }

  /// The last ones say how much cameras usually bend, and that the pure colours are known to `end_doubt`.
  Eigen::VectorXd rests(const Nozzle& nozzle) const {
    Eigen::VectorXd rest(count_ + ends);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const CurvePoint& point = points_[i];
      const Seen colour = foretold(nozzle, answer_, point);
      for (std::size_t c = 0; c < 3; ++c)
        rest(static_cast<Eigen::Index>(3 * i + c)) = colour[c] - point.colour[c];
    }
    Eigen::Index at = 0;
    Nozzle copy = nozzle;
    for (const Seen* seen : loose(copy)) {
      for (const double channel : *seen) {
        rest(count_ + at) = belief(at) * channel;
        ++at;
      }
    }
    return rest;
  }
  double cost_of(const Eigen::VectorXd& rest) const {
    double sum = 0;
    for (Eigen::Index i = 0; i < rest.size(); ++i) {
      const double r = std::abs(rest(i)) / scatter_;
      sum += trust_(i) * (r <= bend ? r * r : bend * (2 * r - bend));
    }
    return sum;
  }
  Eigen::VectorXd weights_of(const Eigen::VectorXd& rest) const {
    Eigen::VectorXd weights(rest.size());
    for (Eigen::Index i = 0; i < rest.size(); ++i) {
      const double r = std::abs(rest(i)) / scatter_;
      weights(i) = trust_(i) * (r <= bend ? 1 : bend / r);
    }
    return weights;
  }

  const std::vector<CurvePoint>& points_;
  const ColourAnswer& answer_;
  const double scatter_;
  const Eigen::Index count_;
  Eigen::VectorXd trust_;
};

/// The volume after which the colour has gone `share` of its change for good: most of the points around it
/// have.
std::optional<double> first_beyond(const std::vector<CurvePoint>& points, const ColourAnswer& answer,
                                   double share) {
  constexpr std::size_t around = 4;
  const auto has = [&](const CurvePoint& point) {
    return answer.change(point.colour, point.fat) >= answer.change(answer(share, point.fat), point.fat);
  };
  for (std::size_t i = 0; i + around < points.size(); ++i) {
    std::size_t beyond = 0, usable = 0;
    for (std::size_t j = i; j <= i + around; ++j) {
      if (points[j].trust == 0) continue;
      ++usable;
      beyond += has(points[j]) ? 1 : 0;
    }
    if (2 * beyond > usable) return points[i].passed;
  }
  return std::nullopt;
}

Fitted best_fit(const std::vector<CurvePoint>& points, const ColourAnswer& answer, double scatter,
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
std::array<double, 3> doubts_of(const std::vector<CurvePoint>& points, const ReferenceColours& references,
                                const ColourAnswer& answer, const Fitted& found) {
  Chance chance;
  std::vector<double> dead, mixing, tanks;
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    ReferenceColours moved = references;
    for (ReferenceColours::Lines* lines : {&moved.thin, &moved.fat}) {
      for (std::size_t i = 0; i < shade_count; ++i) {
        for (double& channel : lines->colour[i]) channel += lines->doubt[i] * chance.normal();
      }
    }
    std::vector<CurvePoint> again = points;
    for (std::size_t first = 0; first < points.size(); first += block) {
      const auto from = static_cast<std::size_t>(chance.uniform() * static_cast<double>(points.size()));
      for (std::size_t i = first; i < std::min(first + block, points.size()); ++i) {
        const CurvePoint& other = points[(from + i - first) % points.size()];
        if (other.trust == 0) continue;
        const Seen expected = foretold(found.nozzle, answer, other);
        again[i].colour = foretold(found.nozzle, answer, points[i]);
        for (std::size_t c = 0; c < 3; ++c)
          again[i].colour[c] +=
              std::clamp(other.colour[c] - expected[c], -4 * found.scatter, 4 * found.scatter);
      }
    }
    const Nozzle nozzle = best_fit(again, ColourAnswer(moved), found.scatter, {found.nozzle}).nozzle;
    dead.push_back(nozzle.dead), mixing.push_back(nozzle.mixing), tanks.push_back(nozzle.tanks);
  }
  return {deviation(dead, found.nozzle.dead), deviation(mixing, found.nozzle.mixing),
          deviation(tanks, found.nozzle.tanks)};
}

/// How far a colour is from all colours of the change: glare and dirt are not on the way from one mixture to
/// the other, whatever the nozzle.
double beside_the_way(const CurvePoint& point, const std::vector<Seen>& way, const ColourAnswer& answer) {
  double least = std::numeric_limits<double>::infinity();
  for (const Seen& colour : way) {
    double squares = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      if (answer.uses(c)) squares += (point.colour[c] - colour[c]) * (point.colour[c] - colour[c]);
    }
    least = std::min(least, squares);
  }
  return std::sqrt(least);
}

/// The points without those that lie beside the way of the colours.
std::vector<CurvePoint> on_the_way(std::vector<CurvePoint> points, const ColourAnswer& answer) {
  constexpr int steps = 100;
  constexpr double allowed = 0.03, usual_times = 4;
  std::array<std::vector<Seen>, 2> ways;
  for (int i = 0; i <= steps; ++i) {
    for (std::size_t fat = 0; fat < 2; ++fat)
      ways[fat].push_back(answer(static_cast<double>(i) / steps, static_cast<double>(fat)));
  }
  std::vector<double> distances;
  for (const CurvePoint& point : points)
    distances.push_back(beside_the_way(point, ways[point.fat < 0.5 ? 0 : 1], answer));
  std::vector<double> sorted;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].trust > 0) sorted.push_back(distances[i]);
  }
  if (sorted.empty()) return points;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (distances[i] > allowed + usual_times * *middle) points[i].trust = 0;
  }
  return points;
}

Estimate estimate(double value, double deviation, double floor) {
  return {value, 2 * std::hypot(deviation, floor)};
}

}  // namespace

ColourAnswer::ColourAnswer(const ReferenceColours& references) {
  std::array<double, 3> steps{};
  for (std::size_t c = 0; c < 3; ++c) {
    thin_[c] = channel_of(references.thin, c);
    fat_[c] = channel_of(references.fat, c);
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

ColourAnswer::Channel ColourAnswer::channel_of(const ReferenceColours::Lines& lines, std::size_t channel) {
  Channel result;
  result.from = log_light(lines.colour.front()[channel]);
  result.to = log_light(lines.colour.back()[channel]);
  const double way = result.to - result.from;
  const double encoded_way = std::abs(lines.colour.back()[channel] - lines.colour.front()[channel]);
  if (std::abs(way) < 1e-9 || encoded_way < 1e-9) return result;
  std::array<double, 3> doubts{};
  const std::array<double, 3> shares = known_shares();
  for (std::size_t i = 0; i < 3; ++i) {
    const double part = (log_light(lines.colour[i + 1][channel]) - result.from) / way;
    result.lifts[i] = logit(part) - logit(shares[i]);
    // Near an end the doubt of a part is larger than its distance from the end.
    const double doubt =
        std::hypot(lines.doubt[i + 1], lines.doubt[i == 0 ? 0 : shade_count - 1]) / encoded_way;
    const double inside = std::clamp(part, smallest_change, 1 - smallest_change);
    doubts[i] = std::max(1e-3, doubt / std::max(doubt, inside * (1 - inside)));
  }
  const std::size_t weak = doubts[0] > doubts[2] ? 0 : 2;
  steady(result.lifts, doubts, weak);
  return result;
}

Seen ColourAnswer::operator()(double share, double fat) const {
  const std::array<double, 3> shares = known_shares();
  const double least = logit(first_traces), most = logit(1 - first_traces);
  const bool pure = share <= 0 || share >= 1;
  const double z = pure ? 0 : std::log(share / (1 - share)), inside = std::clamp(z, least, most);
  // Of the parabola through the three lines.
  std::array<double, 3> parts{};
  for (std::size_t i = 0; i < 3; ++i) {
    parts[i] = 1;
    for (std::size_t j = 0; j < 3; ++j) {
      if (j != i) parts[i] *= (inside - logit(shares[j])) / (logit(shares[i]) - logit(shares[j]));
    }
  }
  Seen colour{};
  for (std::size_t c = 0; c < 3; ++c) {
    const Channel &a = thin_[c], &b = fat_[c];
    double gone = share;
    if (!pure) {
      double lift = 0;
      for (std::size_t i = 0; i < 3; ++i) lift += parts[i] * ((1 - fat) * a.lifts[i] + fat * b.lifts[i]);
      gone = 1 / (1 + std::exp(-(z + lift)));
    }
    const double from = (1 - fat) * a.from + fat * b.from, to = (1 - fat) * a.to + fat * b.to;
    colour[c] = picture::encoded(std::exp(from + gone * (to - from)));
  }
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

CurveFit fit_curve(const std::vector<CurvePoint>& seen, const ReferenceColours& references,
                   const std::filesystem::path& file) {
  const ColourAnswer answer(references);
  const std::vector<CurvePoint> points = on_the_way(seen, answer);
  const auto began = first_beyond(points, answer, perception.began);
  const auto stopped = first_beyond(points, answer, 0.9);
  if (!began)
    throw core::DataError(file.string(), "", "shows a strip that does not change its colour",
                          "print the strip with two feeders of different colours");
  if (!stopped)
    throw core::DataError(file.string(), "", "shows a strip that still changes its colour at its end",
                          "print again with a larger --range");
  const double way = std::max(0.2, 1.2 * (*stopped - *began));
  std::vector<Nozzle> guesses;
  for (const double tanks : {1.2, 2.0, 3.5, 5.5})
    guesses.push_back({std::max(0.0, *began - 0.1 * way), way, tanks, {}, {}, {}, {}});
  // The first fit finds the scatter, the second uses it.
  const Fitted first = best_fit(points, answer, 0.01, guesses);
  const double scatter = std::max(1e-3, first.scatter);
  const Fitted found = best_fit(points, answer, scatter, guesses);
  constexpr double most_scatter = 0.06;
  if (found.scatter > most_scatter)
    throw core::DataError(file.string(), "",
                          "shows a strip that does not change its colour as behind a mixing nozzle",
                          "take the photo again in even light, without glare on the bead");
  const auto [dead, mixing, tanks] = doubts_of(points, references, answer, found);
  const Nozzle& nozzle = found.nozzle;
  const double floor = volume_doubt + volume_doubt_share * (nozzle.dead + nozzle.mixing);
  CurveFit fit;
  fit.dead = estimate(nozzle.dead, dead, floor);
  fit.mixing = estimate(nozzle.mixing, mixing, floor);
  fit.tanks = estimate(nozzle.tanks, tanks, tank_doubt_share * nozzle.tanks);
  fit.scatter = found.scatter;
  fit.low = nozzle.low, fit.high = nozzle.high, fit.bent = nozzle.bent, fit.lanes = nozzle.lanes;
  return fit;
}

Seen CurveFit::colour_at(const CurvePoint& point, const ColourAnswer& answer) const {
  return foretold({dead.value, mixing.value, tanks.value, low, bent, high, lanes}, answer, point);
}

}  // namespace unicursal::host
