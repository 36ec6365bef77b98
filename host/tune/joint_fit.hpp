// The least squares behind curve_fit.hpp: a nozzle, three channels, and what each of them is disturbed by.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <vector>

#include "host/tune/colour_answer.hpp"
#include "host/tune/curve_points.hpp"

namespace unicursal::host {

/// mm³; tanks may be fractions.
struct FittedNozzle {
  double dead = 0, mixing = 1, tanks = 2;
};

/// All numbers are finite and within the limits that the fit keeps.
bool possible(const FittedNozzle& nozzle);

/// The share that has arrived when `passed` mm³ have passed since the strip's switch.
double share_at(const FittedNozzle& nozzle, const std::vector<MixtureSwitch>& switches, double passed);

class JointFit {
 public:
  /// `scatter`: how far points usually are from the curve, encoded; those that are twice as far count less.
  JointFit(const std::vector<CurvePoint>& points, const std::vector<MixtureSwitch>& switches,
           const ColourAnswer& answer, const FittedNozzle& guess, double scatter);

  /// At most so many steps of Levenberg's and Marquardt's method.
  void improve(int steps);

  const FittedNozzle& nozzle() const { return state_.nozzle; }
  double cost() const { return cost_; }
  /// Median distance of the points, as a standard deviation.
  double scatter() const;
  void set_scatter(double scatter);
  std::vector<Seen> foretold() const;
  /// Standard deviations. Neighbouring points err alike; so do all that lie in one block of them, whose
  /// pulls on the nozzle are compared (the "sandwich" of cluster-robust statistics). Infinite if the points
  /// do not determine the nozzle.
  FittedNozzle doubts() const;

 private:
  using Vector = Eigen::VectorXd;
  using Matrix = Eigen::MatrixXd;
  struct State {
    FittedNozzle nozzle;
    std::array<Vector, 3> channels;
  };
  /// What the four nearest nodes of the light count at a point.
  struct Nearby {
    std::array<Eigen::Index, 4> node{};
    std::array<double, 4> weight{};
  };
  /// The few numbers of a channel that a point depends on.
  struct Row {
    std::array<Eigen::Index, 12> at{};
    std::array<double, 12> slope{};
    std::size_t count = 0;
    double colour = 0, by_share = 0;  ///< foretold, and its slope over the share

    void add(Eigen::Index index, double value) {
      at[count] = index;
      slope[count++] = value;
    }
  };
  /// How a point pulls on the numbers.
  struct Pull {
    Row row;
    double rest = 0, weight = 0;  ///< seen − foretold, encoded
    Eigen::Vector3d nozzle;       ///< slopes over dead, mixing, tanks
  };
  struct Shares {
    double share = 0;
    std::array<double, 3> slopes{};  ///< over dead, mixing, tanks
  };
  /// Equations of one channel: its own numbers, and how they go together with the nozzle's.
  struct Equations {
    Matrix own, mixed;
    Vector own_right;
  };
  struct Normal {
    std::array<Equations, 3> channels;
    Eigen::Matrix3d nozzle = Eigen::Matrix3d::Zero();
    Eigen::Vector3d nozzle_right = Eigen::Vector3d::Zero();
  };
  /// A sum of numbers is known to be `wanted`, all in standard deviations.
  struct Prior {
    std::array<Eigen::Index, 8> at{};
    std::array<double, 8> slope{};
    std::size_t count = 0;
    double wanted = 0;

    double rest(const Vector& numbers) const {
      double sum = wanted;
      for (std::size_t i = 0; i < count; ++i) sum -= slope[i] * numbers(at[i]);
      return sum;
    }
  };

  void find_nearby();
  void make_priors(std::size_t channel);
  Row row(const State& state, std::size_t channel, std::size_t point, double share) const;
  std::vector<Shares> shares(const State& state, bool slopes) const;
  double cost_of(const State& state) const;
  Pull pull(const State& state, std::size_t channel, std::size_t point, const Shares& arrived) const;
  double disturbed(const Vector& numbers, std::size_t channel, std::size_t point, double share,
                   Row& row) const;
  Normal normal_at(const State& state) const;
  static void add_point(const Pull& one, Equations& equations, Normal& normal);
  static void add_prior(const Prior& prior, const Vector& numbers, Equations& equations);
  static State moved(const State& state, const Normal& normal, double damping);

  const std::vector<CurvePoint>& points_;
  const std::vector<MixtureSwitch>& switches_;
  const ColourAnswer& answer_;
  double scatter_;
  Eigen::Index lanes_ = 0, nodes_ = 0, numbers_ = 0;
  std::vector<Nearby> nearby_;
  std::array<std::vector<Prior>, 3> priors_;
  State state_;
  double cost_ = 0;
};

}  // namespace unicursal::host
