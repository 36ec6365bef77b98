#include "host/tune/joint_fit.hpp"

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <limits>

#include "core/picture/lab.hpp"
#include "host/tune/transition_fit.hpp"

namespace unicursal::host {
namespace {

constexpr double fewest_tanks = 1, largest_tanks = 6;
constexpr double least_mixing_volume = 0.05;  ///< mm³
constexpr double profile_share = 0.95;        ///< where the profile's mixing volume ends
/// Standard deviations of what is fitted besides the nozzle; natural logarithms of light.
constexpr double usual_bend = 0.15, end_usual = 0.3, lane_usual = 0.03, light_usual = 0.2;
constexpr double node_distance = 25;  ///< mm
/// Neighbouring points err alike, so that nine of them say about as much as one.
constexpr double err_alike = 9;
constexpr double far_from_curve = 2;  ///< scatters beyond which a point pulls no more strongly
constexpr std::size_t block_points = 30;
/// 1 ÷ variance (mm³, tanks) of what the points say about one of the nozzle's numbers; less is rounding.
constexpr double least_known = 1e-6;
constexpr double brightest = 1;  ///< logarithm; what is brighter is a step of the fit that goes too far

/// The numbers of a channel: both laws, the bend of the camera, lanes, nodes of the light.
constexpr Eigen::Index law_numbers = 2 + static_cast<Eigen::Index>(ColourLaw::coefficients);
constexpr Eigen::Index fat_law = law_numbers, bend_number = 2 * law_numbers, first_lane = bend_number + 1;

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

FittedNozzle limited(FittedNozzle nozzle) {
  nozzle.dead = std::max(0.0, nozzle.dead);
  nozzle.mixing = std::max(least_mixing_volume, nozzle.mixing);
  nozzle.tanks = std::clamp(nozzle.tanks, fewest_tanks, largest_tanks);
  return nozzle;
}

FittedNozzle sum_of(const FittedNozzle& nozzle, const Eigen::Vector3d& change) {
  return {nozzle.dead + change(0), nozzle.mixing + change(1), nozzle.tanks + change(2)};
}

ColourLaw law_in(const Eigen::VectorXd& numbers, Eigen::Index first) {
  ColourLaw law;
  law.from = numbers(first), law.to = numbers(first + 1);
  for (std::size_t i = 0; i < law.lift.size(); ++i)
    law.lift[i] = numbers(first + 2 + static_cast<Eigen::Index>(i));
  return law;
}

void put(const ColourLaw& law, Eigen::VectorXd& numbers, Eigen::Index first) {
  numbers(first) = law.from, numbers(first + 1) = law.to;
  for (std::size_t i = 0; i < law.lift.size(); ++i)
    numbers(first + 2 + static_cast<Eigen::Index>(i)) = law.lift[i];
}

/// Of an encoded value over the logarithm of its light (IEC 61966-2-1).
double slope_of_encoding(double encoded) {
  return encoded > 0.04045 ? (encoded + 0.055) / 2.4 : encoded;
}

}  // namespace

bool possible(const FittedNozzle& nozzle) {
  return std::isfinite(nozzle.dead) && nozzle.dead >= 0 && std::isfinite(nozzle.mixing) &&
         nozzle.mixing >= least_mixing_volume && nozzle.tanks >= fewest_tanks &&
         nozzle.tanks <= largest_tanks;
}

double share_at(const FittedNozzle& nozzle, const std::vector<MixtureSwitch>& switches, double passed) {
  static const Responses responses;
  double share = 0;
  for (const MixtureSwitch& one : switches) {
    if (one.passed >= passed) break;
    share += one.step * responses(nozzle.tanks, (passed - one.passed - nozzle.dead) / nozzle.mixing);
  }
  return std::clamp(share, 0.0, 1.0);
}

JointFit::JointFit(const std::vector<CurvePoint>& points, const std::vector<MixtureSwitch>& switches,
                   const ColourAnswer& answer, const FittedNozzle& guess, double scatter)
    : points_(points), switches_(switches), answer_(answer), scatter_(scatter) {
  for (const CurvePoint& point : points) lanes_ = std::max(lanes_, static_cast<Eigen::Index>(point.lane) + 1);
  find_nearby();
  numbers_ = first_lane + lanes_ + nodes_;
  state_.nozzle = limited(guess);
  for (std::size_t c = 0; c < 3; ++c) {
    state_.channels[c] = Vector::Zero(numbers_);
    put(answer.thin(c), state_.channels[c], 0);
    put(answer.fat(c), state_.channels[c], fat_law);
    make_priors(c);
  }
  cost_ = cost_of(state_);
}

void JointFit::set_scatter(double scatter) {
  scatter_ = scatter;
  cost_ = cost_of(state_);
}

void JointFit::find_nearby() {
  core::Vec2 least = points_.front().place, most = least;
  for (const CurvePoint& point : points_) {
    least = least.cwiseMin(point.place);
    most = most.cwiseMax(point.place);
  }
  const auto columns =
      1 + static_cast<Eigen::Index>(std::max(1.0, std::ceil((most - least).x() / node_distance)));
  const auto rows =
      1 + static_cast<Eigen::Index>(std::max(1.0, std::ceil((most - least).y() / node_distance)));
  nodes_ = columns * rows;
  for (const CurvePoint& point : points_) {
    const core::Vec2 at = (point.place - least) / node_distance;
    const auto column = std::min(static_cast<Eigen::Index>(at.x()), columns - 2),
               row = std::min(static_cast<Eigen::Index>(at.y()), rows - 2);
    const double u = at.x() - static_cast<double>(column), v = at.y() - static_cast<double>(row);
    const Eigen::Index node = first_lane + lanes_ + row * columns + column;
    nearby_.push_back({{node, node + 1, node + columns, node + columns + 1},
                       {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v}});
  }
}

void JointFit::make_priors(std::size_t channel) {
  std::vector<Prior>& priors = priors_[channel];
  const auto add = [&](std::initializer_list<std::pair<Eigen::Index, double>> terms, double doubt,
                       double wanted = 0) {
    Prior prior;
    for (const auto& [at, slope] : terms) {
      prior.at[prior.count] = at;
      prior.slope[prior.count++] = slope / doubt;
    }
    prior.wanted = wanted / doubt;
    priors.push_back(prior);
  };
  const Vector& start = state_.channels[channel];
  for (const Eigen::Index law : {Eigen::Index{0}, fat_law}) {
    add({{law, 1}}, end_usual, start(law));
    add({{law + 1, 1}}, end_usual, start(law + 1));
    for (Eigen::Index i = law + 2; i < law + law_numbers; ++i) {
      add({{i, 1}}, lift_usual);
      if (i + 2 < law + law_numbers) add({{i, 1}, {i + 1, -2}, {i + 2, 1}}, lift_bend);
      if (i + 3 < law + law_numbers) add({{i, -1}, {i + 1, 3}, {i + 2, -3}, {i + 3, 1}}, lift_jerk);
    }
  }
  for (Eigen::Index i = 2; i + 2 < law_numbers; ++i)
    add({{i, 1}, {i + 1, -2}, {i + 2, 1}, {fat_law + i, -1}, {fat_law + i + 1, 2}, {fat_law + i + 2, -1}},
        lift_width);
  add({{bend_number, 1}}, usual_bend);
  for (Eigen::Index i = first_lane; i < first_lane + lanes_; ++i) add({{i, 1}}, lane_usual);
  for (Eigen::Index i = first_lane + lanes_; i < numbers_; ++i) add({{i, 1}}, light_usual);
}

JointFit::Row JointFit::row(const State& state, std::size_t channel, std::size_t index, double share) const {
  const Vector& numbers = state.channels[channel];
  // A bead is thin or fat, or treated as the one that it is nearer to.
  const Eigen::Index law_at = points_[index].fat < 0.5 ? 0 : fat_law;
  const ColourLaw law = law_in(numbers, law_at);
  const double gone = law.gone(share), way = law.to - law.from;
  Row row;
  row.add(law_at, 1 - gone);
  row.add(law_at + 1, gone);
  if (share > 0 && share < 1) {
    const auto [first, weights] = ColourLaw::weights_at(share);
    const double steep = way * gone * (1 - gone);
    for (std::size_t i = 0; i < weights.size(); ++i)
      row.add(law_at + 2 + static_cast<Eigen::Index>(first + i), steep * weights[i]);
  }
  const double light = law.from + gone * way + disturbed(numbers, channel, index, share, row);
  row.colour = picture::encoded(std::exp(std::min(light, brightest)));
  const double slope = slope_of_encoding(row.colour);
  for (std::size_t i = 0; i < row.count; ++i) row.slope[i] *= slope;
  constexpr double by = 1e-4;
  const double below = std::max(0.0, share - by), above = std::min(1.0, share + by);
  row.by_share = slope * (way * (law.gone(above) - law.gone(below)) / (above - below) +
                          numbers(bend_number) * points_[index].brightness[channel]);
  return row;
}

/// The logarithm of the light that a camera, a lane and the place of a point add.
double JointFit::disturbed(const Vector& numbers, std::size_t channel, std::size_t index, double share,
                           Row& row) const {
  const CurvePoint& point = points_[index];
  const Eigen::Index lane = first_lane + static_cast<Eigen::Index>(point.lane);
  const double bent = share * point.brightness[channel];
  row.add(bend_number, bent);
  row.add(lane, 1);
  double light = numbers(bend_number) * bent + numbers(lane);
  const Nearby& nearby = nearby_[index];
  for (std::size_t i = 0; i < nearby.node.size(); ++i) {
    row.add(nearby.node[i], nearby.weight[i]);
    light += nearby.weight[i] * numbers(nearby.node[i]);
  }
  return light;
}

std::vector<JointFit::Shares> JointFit::shares(const State& state, bool slopes) const {
  constexpr double by = 1e-3;
  std::vector<Shares> all(points_.size());
  std::array<FittedNozzle, 3> others{};
  std::array<double, 3> steps{};
  for (Eigen::Index i = 0; i < 3; ++i) {
    Eigen::Vector3d to = Eigen::Vector3d::Zero();
    to(i) = i == 2 && state.nozzle.tanks + by >= largest_tanks ? -by : by;
    others[static_cast<std::size_t>(i)] = sum_of(state.nozzle, to);
    steps[static_cast<std::size_t>(i)] = to(i);
  }
  for (std::size_t i = 0; i < points_.size(); ++i) {
    all[i].share = share_at(state.nozzle, switches_, points_[i].passed);
    for (std::size_t j = 0; slopes && j < 3; ++j)
      all[i].slopes[j] = (share_at(others[j], switches_, points_[i].passed) - all[i].share) / steps[j];
  }
  return all;
}

JointFit::Pull JointFit::pull(const State& state, std::size_t channel, std::size_t index,
                              const Shares& arrived) const {
  Pull one;
  one.row = row(state, channel, index, arrived.share);
  one.rest = points_[index].colour[channel] - one.row.colour;
  const double far = std::abs(one.rest) / scatter_;
  one.weight = points_[index].trust * (far <= far_from_curve ? 1 : far_from_curve / far) /
               (err_alike * scatter_ * scatter_);
  one.nozzle = one.row.by_share * Eigen::Map<const Eigen::Vector3d>(arrived.slopes.data());
  return one;
}

double JointFit::cost_of(const State& state) const {
  double sum = 0;
  const std::vector<Shares> arrived = shares(state, false);
  for (std::size_t c = 0; c < 3; ++c) {
    if (!answer_.uses(c)) continue;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (points_[i].trust == 0) continue;
      const double far =
          std::abs(row(state, c, i, arrived[i].share).colour - points_[i].colour[c]) / scatter_;
      const double pulled = far <= far_from_curve ? far * far : far_from_curve * (2 * far - far_from_curve);
      sum += points_[i].trust * pulled / err_alike;
    }
    for (const Prior& prior : priors_[c]) {
      const double rest = prior.rest(state.channels[c]);
      sum += rest * rest;
    }
  }
  return sum;
}

JointFit::Normal JointFit::normal_at(const State& state) const {
  Normal normal;
  const std::vector<Shares> arrived = shares(state, true);
  for (std::size_t c = 0; c < 3; ++c) {
    if (!answer_.uses(c)) continue;
    Equations& equations = normal.channels[c];
    equations.own = Matrix::Zero(numbers_, numbers_);
    equations.mixed = Matrix::Zero(numbers_, 3);
    equations.own_right = Vector::Zero(numbers_);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (points_[i].trust > 0) add_point(pull(state, c, i, arrived[i]), equations, normal);
    }
    for (const Prior& prior : priors_[c]) add_prior(prior, state.channels[c], equations);
  }
  return normal;
}

void JointFit::add_point(const Pull& one, Equations& equations, Normal& normal) {
  const Row& row = one.row;
  normal.nozzle += one.weight * one.nozzle * one.nozzle.transpose();
  normal.nozzle_right += one.weight * one.rest * one.nozzle;
  for (std::size_t a = 0; a < row.count; ++a) {
    const double slope = one.weight * row.slope[a];
    equations.own_right(row.at[a]) += slope * one.rest;
    for (std::size_t b = 0; b < row.count; ++b) equations.own(row.at[a], row.at[b]) += slope * row.slope[b];
    equations.mixed.row(row.at[a]) += slope * one.nozzle.transpose();
  }
}

void JointFit::add_prior(const Prior& prior, const Vector& numbers, Equations& equations) {
  const double rest = prior.rest(numbers);
  for (std::size_t a = 0; a < prior.count; ++a) {
    equations.own_right(prior.at[a]) += rest * prior.slope[a];
    for (std::size_t b = 0; b < prior.count; ++b)
      equations.own(prior.at[a], prior.at[b]) += prior.slope[a] * prior.slope[b];
  }
}

JointFit::State JointFit::moved(const State& state, const Normal& normal, double damping) {
  State next = state;
  Eigen::Matrix3d left = normal.nozzle;
  left.diagonal() *= 1 + damping;
  left.diagonal().array() += 1e-9;
  Eigen::Vector3d right = normal.nozzle_right;
  std::array<Matrix, 3> solved;  // the right side, then what the nozzle adds
  for (std::size_t c = 0; c < 3; ++c) {
    const Equations& one = normal.channels[c];
    if (one.own.size() == 0) continue;
    Matrix own = one.own, both(one.own.rows(), 4);
    own.diagonal() *= 1 + damping;
    both << one.own_right, one.mixed;
    solved[c] = own.ldlt().solve(both);
    left -= one.mixed.transpose() * solved[c].rightCols(3);
    right -= one.mixed.transpose() * solved[c].col(0);
  }
  const Eigen::Vector3d change = left.ldlt().solve(right);
  if (!change.allFinite()) return state;
  next.nozzle = limited(sum_of(state.nozzle, change));
  for (std::size_t c = 0; c < 3; ++c) {
    if (solved[c].size() > 0) next.channels[c] += solved[c].col(0) - solved[c].rightCols(3) * change;
  }
  return next;
}

void JointFit::improve(int steps) {
  double damping = 1e-2;
  for (int step = 0; step < steps && damping < 1e8;) {
    const Normal normal = normal_at(state_);
    bool better = false, settled = false;
    while (!better && damping < 1e8) {
      const State next = moved(state_, normal, damping);
      const double cost = cost_of(next);
      better = cost < cost_;
      if (!better) {
        damping *= 8;
        continue;
      }
      settled = cost_ - cost < 1e-6 * cost_;
      state_ = next, cost_ = cost, damping = std::max(1e-9, damping / 5);
    }
    ++step;
    if (settled) break;
  }
}

double JointFit::scatter() const {
  std::vector<double> sizes;
  const std::vector<Shares> arrived = shares(state_, false);
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; answer_.uses(c) && i < points_.size(); ++i) {
      if (points_[i].trust > 0)
        sizes.push_back(std::abs(row(state_, c, i, arrived[i].share).colour - points_[i].colour[c]));
    }
  }
  if (sizes.empty()) return 1;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return 1.4826 * *middle;
}

std::vector<Seen> JointFit::foretold() const {
  const std::vector<Shares> arrived = shares(state_, false);
  std::vector<Seen> all(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) all[i][c] = row(state_, c, i, arrived[i].share).colour;
  }
  return all;
}

FittedNozzle JointFit::doubts() const {
  const Normal normal = normal_at(state_);
  const std::vector<Shares> arrived = shares(state_, true);
  Eigen::Matrix3d left = normal.nozzle, pulls = Eigen::Matrix3d::Zero();
  left.diagonal().array() += 1e-9;
  std::vector<Eigen::Vector3d> blocks(points_.size() / block_points + 1, Eigen::Vector3d::Zero());
  for (std::size_t c = 0; c < 3; ++c) {
    const Equations& one = normal.channels[c];
    if (one.own.size() == 0) continue;
    // What a pull on a number of this channel does to the nozzle.
    const Matrix solved = one.own.ldlt().solve(one.mixed);
    left -= one.mixed.transpose() * solved;
    const auto through = [&](const auto& row) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (std::size_t a = 0; a < row.count; ++a) sum += row.slope[a] * solved.row(row.at[a]).transpose();
      return sum;
    };
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (points_[i].trust == 0) continue;
      const Pull point = pull(state_, c, i, arrived[i]);
      blocks[i / block_points] += point.weight * point.rest * (point.nozzle - through(point.row));
    }
    for (const Prior& prior : priors_[c]) pulls += through(prior) * through(prior).transpose();
  }
  for (const Eigen::Vector3d& block : blocks) pulls += block * block.transpose();
  // Conditions that NaN does not meet.
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const FittedNozzle unknown{infinity, infinity, infinity};
  if (!left.allFinite() || !(left.ldlt().vectorD().minCoeff() >= least_known)) return unknown;
  const Eigen::Matrix3d inverse = left.inverse();
  const Eigen::Vector3d variances = (inverse * pulls * inverse).diagonal();
  if (!variances.allFinite() || !(variances.minCoeff() > 0)) return unknown;
  return {std::sqrt(variances(0)), std::sqrt(variances(1)), std::sqrt(variances(2))};
}

}  // namespace unicursal::host
