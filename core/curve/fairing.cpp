#include "core/curve/fairing.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/curve/alignment.hpp"
#include "core/curve/coverage.hpp"
#include "core/curve/leash.hpp"
#include "core/curve/orientation.hpp"
#include "core/curve/resample.hpp"
#include "core/curve/retraction.hpp"
#include "core/curve/shape_terms.hpp"
#include "core/geometry/lattice.hpp"
#include "core/numeric/parallel.hpp"
#include "core/numeric/quasi_newton.hpp"
#include "core/stopping.hpp"

namespace unicursal::core {
namespace {

using Field = std::vector<Vec2>;  ///< one vector per vertex

constexpr double irrational_turn = 0.5535743589;  ///< angle between the lattice and the island's axes, rad
constexpr double sufficient_decrease = 1e-4;      ///< Armijo
constexpr int most_halvings = 8;
constexpr double slack_in_widths = 0.15;  ///< lists of near segments stay valid for such moves
constexpr double vertex_spacing = 0.75;   ///< bead widths, on the coarse curve
constexpr double final_spacing = 0.4;     ///< bead widths; of vertices nearer than half of it, one is removed
constexpr double length_stiffness = 0.01;  ///< relative length error at which the penalty balances coverage
constexpr double finest_wave = 4;  ///< bead widths; the shortest common move of vertices (long_waves.hpp)
constexpr double wave_strength = 0.04;
constexpr int multiplier_period = 10;  ///< iterations between updates of the length multiplier

Vec2 turned(const Vec2& v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

Ring turned(Ring ring, double angle) {
  for (Vec2& v : ring) v = turned(v, angle);
  return ring;
}

Polygon turned(Polygon polygon, double angle) {
  polygon.outer = turned(std::move(polygon.outer), angle);
  for (Ring& hole : polygon.holes) hole = turned(std::move(hole), angle);
  return polygon;
}

class Fairer {
 public:
  Fairer(const Polygon& island, const FairingOptions& options)
      : options_(options),
        island_(turned(island, irrational_turn)),
        area_(area(island)),
        border_(island_, options.bead_width),
        leash_(border_, options.bead_width, options.workers),
        newton_(options.workers) {
    alignment_weight_ = options.alignment;
    lay_lattice(options.coarse_samples_per_width);
    const double w = options.bead_width;
    multiplier_ = w * w * w / 6;  // −∂E_CVT/∂L of evenly spaced folds, E = A³ ÷ (12 L²)
    if (options.hold_length) stiffness_ = multiplier_ / (2 * length_stiffness * options.target_length);
  }

  Curve run(Curve curve) {
    curve.vertices = turned(std::move(curve.vertices), irrational_turn);
    curve = spread(curve, vertex_spacing);
    curve = descend(std::move(curve), options_.coarse_iterations / 2);
    curve = without_crowding(curve);
    curve = spread(curve, vertex_spacing);
    curve = descend(std::move(curve), options_.coarse_iterations - options_.coarse_iterations / 2);
    curve = without_crowding(curve);
    if (options_.fine_iterations > 0) {
      curve = subdivided(spread(curve, vertex_spacing));
      alignment_weight_ = options_.fine_alignment;
      lay_lattice(options_.samples_per_width);
      curve = descend(std::move(curve), options_.fine_iterations / 2);
      curve = spread(curve, vertex_spacing / 2);
      curve = descend(std::move(curve), options_.fine_iterations - options_.fine_iterations / 2);
    }
    curve = thinned(curve, border_, final_spacing * options_.bead_width, options_.workers);
    curve.vertices = turned(std::move(curve.vertices), -irrational_turn);
    return curve;
  }

  int iterations() const { return iterations_; }

 private:
  void lay_lattice(double samples_per_width) {
    const double pitch = options_.bead_width / samples_per_width;
    if (coverage_ && pitch == lattice_.pitch) return;
    lattice_ = sample(island_, pitch);
    coverage_.emplace(lattice_, slack_in_widths * options_.bead_width, options_.workers);
    if (options_.field != nullptr && !options_.alignment_by_length)
      alignment_ = Alignment(lattice_, *options_.field, irrational_turn);
  }

  Curve spread(const Curve& curve, double spacing) const {
    return respaced(curve, border_, spacing * options_.bead_width, options_.workers);
  }

  /// The curve without the fingers that crowd a place.
  Curve without_crowding(const Curve& curve) {
    if (ended_ || !options_.may_retract) return curve;  // a curve that is not smooth yet only seems crowded
    Field unused(curve.size(), Vec2(0, 0));
    coverage_->evaluate(curve, 1, unused);
    return retracted(curve, coverage_->areas(), border_, options_.bead_width).curve;
  }

  double evaluate(const Curve& curve, Field& gradient) {
    gradient.assign(curve.size(), Vec2(0, 0));
    double value = coverage_->evaluate(curve, 1, gradient);
    // A vertex of the subdivided curve stands for half the length: this scale keeps the cost of bending the
    // same.
    const double per_vertex = area_ / static_cast<double>(curve.size());
    const double coarse = area_ / (vertex_spacing * options_.bead_width * options_.bead_width);
    const double finer = static_cast<double>(curve.size()) / coarse;
    const double smooth = options_.smoothness * per_vertex * finer * finer * finer;
    value += smooth * smoothness_with_gradient(curve, smooth, gradient);
    if (!alignment_.empty())
      value += field_weight() * alignment_.evaluate(curve, coverage_->owners(), field_weight(), gradient);
    value += along_field(curve, field_weight(), gradient);
    value += orientation(curve, gradient);
    const double excess = curve.length() - options_.target_length;
    length_with_gradient(curve, multiplier_ + 2 * stiffness_ * excess, gradient);
    return value + multiplier_ * excess + stiffness_ * excess * excess;
  }

  double field_weight() const { return alignment_weight_ * options_.bead_width * options_.bead_width; }

  double along_field(const Curve& curve, double weight, Field& gradient) const {
    if (asked_.empty()) return 0;
    return weight * alignment_along(curve, asked_, options_.bead_width, weight, gradient);
  }

  /// Looks up the field where the curve is now, which until the next call is taken not to change.
  void look_up_field(const Curve& curve) {
    if (options_.field != nullptr && options_.alignment_by_length)
      asked_ = asked_along(curve, *options_.field, irrational_turn);
  }

  /// Looks up the field again, and puts right what depends on it.
  void follow_field(const Curve& curve, double& value, Field& gradient) {
    if (asked_.empty()) return;
    value += along_field(curve, -field_weight(), gradient);
    look_up_field(curve);
    value += along_field(curve, field_weight(), gradient);
  }

  double orientation(const Curve& curve, Field& gradient) const {
    double value = 0;
    for (std::size_t z = 0; z < members_.size(); ++z) {
      double length = 0;
      for (std::size_t i = 0; i < curve.size(); ++i) {
        if (members_[z][i]) length += (curve.vertices[curve.after(i)] - curve.vertices[i]).norm();
      }
      const double w = options_.bead_width;
      const double weight =
          (options_.zones[z].even ? options_.evenness : -options_.likeness) * length * w * w * w;
      value += weight * isotropy_with_gradient(curve, members_[z], weight, gradient, options_.workers);
    }
    return value;
  }

  /// Assigns each segment to the zone in which its middle lies, until the next call.
  void look_up_zones(const Curve& curve) {
    members_.assign(options_.zones.size(), std::vector<char>(curve.size(), 0));
    for (std::size_t z = 0; z < members_.size(); ++z) {
      for (std::size_t i = 0; i < curve.size(); ++i) {
        const Vec2 middle = (curve.vertices[i] + curve.vertices[curve.after(i)]) / 2;
        members_[z][i] = options_.zones[z].contains(turned(middle, -irrational_turn));
      }
    }
  }

  /// Takes one step along a descent direction. Returns false if no acceptable step was found.
  bool step(Curve& curve, double& value, Field& gradient) {
    Field direction = newton_.direction(gradient);
    double longest = 0;
    for (const Vec2& d : direction) longest = std::max(longest, d.norm());
    if (!(longest > 0)) return false;
    const double w = options_.bead_width;
    double scale = newton_.empty() ? 0.1 * w / longest : std::min(1.0, w / longest);
    for (int halving = 0; halving < most_halvings; ++halving, scale /= 2) {
      Curve trial = curve;
      for (std::size_t i = 0; i < curve.size(); ++i) trial.vertices[i] += scale * direction[i];
      leash_.limit(trial);
      Field move(curve.size());
      for (std::size_t i = 0; i < curve.size(); ++i) move[i] = trial.vertices[i] - curve.vertices[i];
      const double slope = dot(gradient, move, options_.workers);
      if (slope >= 0) return false;
      Field trial_gradient;
      const double trial_value = evaluate(trial, trial_gradient);
      if (trial_value > value + sufficient_decrease * slope) continue;
      Field change = trial_gradient;
      add_scaled(change, -1, gradient, options_.workers);
      newton_.remember(move, change);
      curve = std::move(trial);
      value = trial_value;
      gradient = std::move(trial_gradient);
      follow_field(curve, value, gradient);
      leash_.follow(curve);
      return true;
    }
    return false;
  }

  Curve descend(Curve curve, int iterations) {
    const double w = options_.bead_width;
    newton_.forget({curve.vertices, finest_wave * w, wave_strength});
    leash_.fasten(curve);
    look_up_zones(curve);
    look_up_field(curve);
    Field gradient;
    double value = evaluate(curve, gradient);
    for (int i = 0; i < iterations; ++i) {
      stop_point();
      if (options_.may_continue && !options_.may_continue()) {
        ended_ = true;
        break;
      }
      ++iterations_;
      if (i > 0 && i % multiplier_period == 0) {
        multiplier_ += stiffness_ * (curve.length() - options_.target_length);
        value = evaluate(curve, gradient);  // the curvature has changed little: earlier steps still serve
      }
      if (step(curve, value, gradient)) continue;
      const bool fresh = newton_.empty();
      newton_.forget_steps();
      leash_.fasten(curve);
      if (fresh) break;
    }
    return curve;
  }

  FairingOptions options_;
  Polygon island_;
  double area_;
  BorderIndex border_;
  Lattice lattice_;
  std::optional<Coverage> coverage_;
  Alignment alignment_;
  Field asked_;  ///< per segment, if alignment is by length
  Leash leash_;
  QuasiNewton newton_;
  std::vector<std::vector<char>>
      members_;  ///< [zone][segment]: whether the segment lies in the orientation zone
  double multiplier_ = 0, stiffness_ = 0;
  double alignment_weight_ = 0;
  int iterations_ = 0;
  bool ended_ = false;  ///< the budget was spent
};

}  // namespace

Curve smoothed(const Curve& curve, const Polygon& island, double bead_width, Workers* workers) {
  const BorderIndex border(island, bead_width);
  Leash leash(border, bead_width, workers);
  Curve result = curve;
  for (int pass = 0; pass < 5; ++pass) {
    stop_point();
    leash.fasten(result);
    Curve next = result;
    for (std::size_t i = 0; i < result.size(); ++i) {
      const Vec2 &before = result.vertices[result.before(i)], &after = result.vertices[result.after(i)];
      next.vertices[i] += 0.1 * (before + after - 2 * result.vertices[i]);
    }
    leash.limit(next);
    result = std::move(next);
  }
  return result;
}

FairingResult fair(const Curve& curve, const Polygon& island, const FairingOptions& options) {
  Fairer fairer(island, options);
  Curve result = fairer.run(curve);
  return {std::move(result), fairer.iterations()};
}

}  // namespace unicursal::core
