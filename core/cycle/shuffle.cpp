#include "core/cycle/shuffle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/cycle/population.hpp"
#include "core/stopping.hpp"

namespace unicursal::core {
namespace {

constexpr std::size_t fewest_stops = 12;     ///< a smaller tour leaves nothing to choose
constexpr std::size_t looks_at_once = 4096;  ///< without a stop point
constexpr int quench_sweeps = 4;  ///< sweeps that only accept improvements, after the last temperature

// Algorithm 1.
constexpr double high_threshold = 0.5, low_threshold = 1;

/// One run: a tour, its objective, and the rule by which changes are accepted.
class Run {
 public:
  Run(Tour tour, const DemandAt& demand, const RunCost& run_cost, const ShuffleOptions& options,
      Random& random)
      : tour_(std::move(tour)),
        objective_(tour_, demand, run_cost, options.weights),
        options_(options),
        random_(random) {
    report_.before = objective_.value();
  }

  ShuffleReport go(const MayContinue& may_continue) {
    if (options_.rule == ShuffleOptions::Rule::annealing) {
      anneal(may_continue);
    } else {
      algorithm_1(may_continue);
    }
    report_.after = objective_.value();
    report_.labelled = tour_.labelled();
    return report_;
  }

  Tour release() && { return std::move(tour_).release(); }

 private:
  void anneal(const MayContinue& may_continue) {
    const double ratio = options_.cold / options_.hot;
    for (int k = 0; k < options_.sweeps; ++k) {
      if (may_continue && !may_continue()) break;
      const double progress = static_cast<double>(k) / options_.sweeps;
      const double temperature = objective_.edge_length() * options_.hot * std::pow(ratio, progress);
      sweep([&](double rise) { return rise < -temperature * std::log(1 - random_.uniform()); });
    }
    quench();
  }

  void algorithm_1(const MayContinue& may_continue) {
    const auto stops = static_cast<double>(tour_.tour().stop_count());
    // (1) scales the objective to [0, 1]: the squared angle is at most π²/4.
    const double scale = 1 / (objective_.edge_length() * stops * std::numbers::pi * std::numbers::pi / 4);
    for (int k = 0; k < options_.sweeps; ++k) {
      if (may_continue && !may_continue()) break;
      const bool shuffling = k < options_.sweeps / 2;
      sweep([&](double rise) {
        const double scaled = rise * scale;
        return shuffling && scaled < high_threshold &&
               (1 + stops * scaled) * random_.uniform() < low_threshold;
      });
    }
    quench();
  }

  void quench() {
    for (int k = 0; k < quench_sweeps; ++k) {
      if (!sweep([](double) { return false; })) return;
    }
  }

  /// One look per stop; `uphill` decides whether a change for the worse is accepted. Returns false if nothing
  /// was changed.
  template <typename Uphill>
  bool sweep(Uphill uphill) {
    const std::uint64_t before = report_.accepted;
    for (std::size_t k = 0; k < tour_.tour().stop_count(); ++k) {
      if (k % looks_at_once == 0) stop_point();
      ++report_.looks;
      const std::optional<LocalChange> change = tour_.look(random_stop(), random_);
      if (!change) continue;
      ++report_.found;
      const double rise = objective_.difference(*change);
      if (rise > 0 && !uphill(rise)) continue;
      if (rise == 0 && !uphill(0)) continue;
      objective_.accept();
      tour_.apply(*change);
      ++report_.accepted;
    }
    return report_.accepted > before;
  }

  /// A flaw or any free stop.
  StopIndex random_stop() {
    const std::vector<StopIndex>& flaws = objective_.flaws();
    if (!flaws.empty() && random_.uniform() < options_.at_flaws) return flaws[random_.below(flaws.size())];
    return tour_.random_stop(random_);
  }

  EditableTour tour_;
  CycleObjective objective_;
  const ShuffleOptions& options_;
  Random& random_;
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
  const auto evolve = [&](Tour& one, Random& stream, const MayContinue& may_continue) {
    Run run(one, demand, run_cost, options, stream);
    const ShuffleReport report = run.go(may_continue);
    if (report.after <= report.before) one = std::move(run).release();
    return report;
  };
  if (options.champions <= 1 && options.candidates <= 1 && options.generations <= 1) {
    return evolve(tour, random, options.may_continue);
  }
  return evolve_population(tour, options, random, evolve);
}

}  // namespace unicursal::core
