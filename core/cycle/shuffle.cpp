#include "core/cycle/shuffle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/cycle/population.hpp"
#include "core/stopping.hpp"

namespace unicursal::core {
namespace {

constexpr std::size_t fewest_stops = 12;     ///< a smaller tour leaves nothing to choose
constexpr std::size_t looks_at_once = 4096;  ///< without a stop point
constexpr int sweeps_at_once = 8;            ///< between two cuts of windows, and two joins of their sums
constexpr int quench_rounds = 2;             ///< that only accept improvements, after the last temperature
constexpr int quench_sweeps = 4;             ///< in each of these rounds
constexpr double window_stops = 1500;        ///< in a window; its tables fit a processor's cache
constexpr double whole_below = 2;            ///< windows; a smaller tour is not cut
/// Area of the island for each stop, in squares of the mean edge length.
constexpr double area_per_stop = 0.87;

// Algorithm 1.
constexpr double high_threshold = 0.5, low_threshold = 1;

constexpr double hopeless = 40;  ///< temperatures; a greater rise is never accepted

/// One run: a tour, its objective, and the rule by which changes are accepted.
class Run {
 public:
  Run(Tour tour, const DemandAt& demand, const RunCost& run_cost, const ShuffleOptions& options,
      Random& random, Workers& workers)
      : tour_(std::move(tour)),
        objective_(tour_, demand, run_cost, options.weights),
        options_(options),
        random_(random),
        workers_(workers) {
    report_.before = objective_.value();
    windows_.push_back(whole_window(tour_.tour()));
    const double stops = static_cast<double>(windows_.front().sequence.size());
    if (options.rule == ShuffleOptions::Rule::annealing && stops >= whole_below * window_stops)
      side_ = objective_.edge_length() * std::sqrt(area_per_stop * window_stops);
  }

  ShuffleReport go(const MayContinue& may_continue) {
    if (options_.rule == ShuffleOptions::Rule::annealing) {
      anneal(may_continue);
    } else {
      algorithm_1(may_continue);
    }
    for (int k = 0; k < quench_rounds; ++k) {
      if (!round(quench_sweeps, [](double, int, Dice&) { return false; })) break;
    }
    report_.after = objective_.value();
    return report_;
  }

  Tour release() && { return std::move(tour_).release(); }

 private:
  void anneal(const MayContinue& may_continue) {
    const double ratio = options_.cold / options_.hot;
    for (int k = 0; k < options_.sweeps; k += sweeps_at_once) {
      if (may_continue && !may_continue()) break;
      const int count = std::min(sweeps_at_once, options_.sweeps - k);
      std::array<double, sweeps_at_once> temperatures{};
      for (int i = 0; i < count; ++i) {
        const double progress = static_cast<double>(k + i) / options_.sweeps;
        temperatures[static_cast<std::size_t>(i)] =
            objective_.edge_length() * options_.hot * std::pow(ratio, progress);
      }
      round(count, [&](double rise, int sweep, Dice& dice) {
        const double temperature = temperatures[static_cast<std::size_t>(sweep)];
        return rise < hopeless * temperature && rise < -temperature * std::log(1 - dice.uniform());
      });
    }
  }

  void algorithm_1(const MayContinue& may_continue) {
    const auto stops = static_cast<double>(tour_.tour().stop_count());
    // (1) scales the objective to [0, 1]: the squared angle is at most π²/4.
    const double scale = 1 / (objective_.edge_length() * stops * std::numbers::pi * std::numbers::pi / 4);
    for (int k = 0; k < options_.sweeps; ++k) {
      if (may_continue && !may_continue()) break;
      const bool shuffling = k < options_.sweeps / 2;
      round(1, [&](double rise, int, Dice& dice) {
        const double scaled = rise * scale;
        return shuffling && scaled < high_threshold && (1 + stops * scaled) * dice.uniform() < low_threshold;
      });
    }
  }

  /// Some sweeps of one look per stop, in each window. `uphill` decides whether a change for the worse is
  /// accepted. Returns false if nothing was changed.
  template <typename Uphill>
  bool round(int sweeps, Uphill uphill) {
    if (side_ > 0) {
      const double y = random_.uniform(), x = random_.uniform();
      windows_ = tour_.divide(side_, side_ * Vec2(x, y));
    }
    std::vector<Dice> dice;
    std::vector<WindowObjective> objectives;
    objectives.reserve(windows_.size());
    for (const TourWindow& window : windows_) {
      dice.emplace_back(static_cast<std::uint64_t>(random_.uniform() * 0x1.0p53));
      objectives.emplace_back(objective_, window);
    }
    std::vector<ShuffleReport> reports(windows_.size());
    workers_.each(windows_.size(), [&](std::size_t k) {
      for (int i = 0; i < sweeps; ++i) {
        sweep(windows_[k], objectives[k], dice[k], reports[k],
              [&](double rise) { return uphill(rise, i, dice[k]); });
      }
    });
    objective_.join(objectives);
    ShuffleReport sum;
    for (const ShuffleReport& report : reports) sum.add(report);
    report_.add(sum);
    for (TourWindow& window : windows_) report_.labelled += std::exchange(window.labelled, 0);
    return sum.accepted > 0;
  }

  template <typename Uphill>
  void sweep(TourWindow& window, WindowObjective& objective, Dice& dice, ShuffleReport& report,
             Uphill uphill) {
    for (std::size_t k = 0; k < window.movable.size(); ++k) {
      if (k % looks_at_once == 0) stop_point();
      ++report.looks;
      const std::optional<LocalChange> change = tour_.look(random_stop(window, objective, dice), dice);
      if (!change) continue;
      ++report.found;
      const double rise = objective.difference(*change);
      if (rise >= 0 && !uphill(rise)) continue;
      if (!tour_.keeps_ends(*change, window)) continue;
      objective.accept();
      tour_.apply(*change, window);
      ++report.accepted;
    }
  }

  /// A flaw or any movable stop.
  StopIndex random_stop(const TourWindow& window, const WindowObjective& objective, Dice& dice) const {
    const std::vector<StopIndex>& flaws = objective.flaws();
    if (!flaws.empty() && dice.uniform() < options_.at_flaws) return flaws[dice.below(flaws.size())];
    return window.movable[dice.below(window.movable.size())];
  }

  EditableTour tour_;
  CycleObjective objective_;
  const ShuffleOptions& options_;
  Random& random_;
  Workers& workers_;
  double side_ = 0;  ///< of a window, mm; 0: the tour is not cut
  std::vector<TourWindow> windows_;
  ShuffleReport report_;
};

}  // namespace

void ShuffleReport::add(const ShuffleReport& other) {
  looks += other.looks;
  found += other.found;
  accepted += other.accepted;
  labelled += other.labelled;
}

ShuffleReport shuffle(Tour& tour, const DemandAt& demand, const RunCost& run_cost,
                      const ShuffleOptions& options, Random& random) {
  const auto free = static_cast<std::size_t>(std::count(tour.free.begin(), tour.free.end(), 1));
  if (free < fewest_stops) return {};
  const bool alone = options.champions <= 1 && options.candidates <= 1 && options.generations <= 1;
  const auto evolve = [&](Tour& one, Random& stream, const MayContinue& may_continue) {
    // The runs of a population share the workers, and must not ask them for help.
    Workers own(1);
    Run run(one, demand, run_cost, options, stream,
            alone && options.workers != nullptr ? *options.workers : own);
    const ShuffleReport report = run.go(may_continue);
    if (report.after <= report.before) one = std::move(run).release();
    return report;
  };
  if (alone) return evolve(tour, random, options.may_continue);
  return evolve_population(tour, options, random, evolve);
}

}  // namespace unicursal::core
