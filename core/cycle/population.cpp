#include "core/cycle/population.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace unicursal::core {
namespace {

/// A copy of a tour, the seed of its run, and the report of the run.
struct Clone {
  Tour tour;
  std::uint64_t seed = 0;
  ShuffleReport report;
};

void evolve_all(std::vector<Clone>& clones, Workers* workers, const Evolve& evolve) {
  Workers serial(1);
  (workers != nullptr ? *workers : serial).each(clones.size(), [&](std::size_t k) {
    Random random(clones[k].seed);
    clones[k].report = evolve(clones[k].tour, random, {});
  });
}

std::uint64_t fresh_seed(Random& random) {
  return static_cast<std::uint64_t>(random.uniform() * 0x1.0p53);
}

double value_of(const ShuffleReport& report) {
  return std::min(report.before, report.after);
}

}  // namespace

std::size_t distance(const Tour& a, const Tour& b) {
  std::size_t different = 0;
  for (const StopIndex s : a.leave.indices()) {
    if (a.visited(s) && a.leave[s] != b.leave[s]) ++different;
  }
  return different;
}

std::vector<std::size_t> diverse(const std::vector<Tour>& tours, const std::vector<double>& values,
                                 std::size_t count) {
  std::vector<std::size_t> chosen{
      static_cast<std::size_t>(std::min_element(values.begin(), values.end()) - values.begin())};
  std::vector<std::size_t> nearest(tours.size(), std::numeric_limits<std::size_t>::max());
  while (chosen.size() < std::min(count, tours.size())) {
    for (std::size_t k = 0; k < tours.size(); ++k) {
      nearest[k] = std::min(nearest[k], distance(tours[k], tours[chosen.back()]));
    }
    for (const std::size_t k : chosen) nearest[k] = 0;
    const auto farthest = std::max_element(nearest.begin(), nearest.end());
    const auto k = static_cast<std::size_t>(farthest - nearest.begin());
    if (std::find(chosen.begin(), chosen.end(), k) != chosen.end())
      break;  // all others are equal to one of these
    chosen.push_back(k);
  }
  return chosen;
}

ShuffleReport evolve_population(Tour& tour, const ShuffleOptions& options, Random& random,
                                const Evolve& evolve) {
  const auto champions = static_cast<std::size_t>(std::max(options.champions, 1));
  const auto candidates = static_cast<std::size_t>(std::max(options.candidates, 1));
  ShuffleReport report;
  const auto run = [&](const std::vector<Tour>& parents) {
    std::vector<Clone> clones;
    for (const Tour& parent : parents) {
      for (std::size_t c = 0; c < candidates; ++c) clones.push_back({parent, fresh_seed(random), {}});
    }
    evolve_all(clones, options.workers, evolve);
    for (const Clone& clone : clones) report.add(clone.report);
    return clones;
  };

  std::vector<Clone> clones = run(std::vector<Tour>(champions, tour));
  report.before = clones.front().report.before;
  std::vector<Tour> tours;
  std::vector<double> values;
  for (Clone& clone : clones) {
    tours.push_back(std::move(clone.tour));
    values.push_back(value_of(clone.report));
  }
  std::vector<Tour> kept;
  std::vector<double> kept_values;
  for (const std::size_t k : diverse(tours, values, champions)) {
    kept.push_back(tours[k]);
    kept_values.push_back(values[k]);
  }
  for (int generation = 1; generation < options.generations; ++generation) {
    if (options.may_continue && !options.may_continue()) break;
    clones = run(kept);
    for (std::size_t k = 0; k < clones.size(); ++k) {
      const std::size_t parent = k / candidates;
      if (value_of(clones[k].report) >= kept_values[parent]) continue;
      kept[parent] = std::move(clones[k].tour);
      kept_values[parent] = value_of(clones[k].report);
    }
  }
  const auto best = std::min_element(kept_values.begin(), kept_values.end()) - kept_values.begin();
  report.after = kept_values[best];
  tour = std::move(kept[best]);
  return report;
}

}  // namespace unicursal::core
