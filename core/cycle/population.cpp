#include "core/cycle/population.hpp"

#include <algorithm>
#include <atomic>
#include <limits>
#include <numeric>
#include <thread>

namespace unicursal::core {
namespace {

/// One clone on its way, with what its run found out.
struct Clone {
  Tour tour;
  std::uint64_t seed = 0;
  ShuffleReport report;
};

void evolve_all(std::vector<Clone>& clones, unsigned threads, const Evolve& evolve) {
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t k = next++; k < clones.size(); k = next++) {
      Random random(clones[k].seed);
      clones[k].report = evolve(clones[k].tour, random, {});
    }
  };
  std::vector<std::thread> others;
  for (unsigned t = 1; t < std::min<std::size_t>(threads, clones.size()); ++t) others.emplace_back(work);
  work();
  for (std::thread& other : others) other.join();
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
  for (std::size_t s = 0; s < a.stop_count(); ++s) {
    if (a.leave[s] >= 0 && a.leave[s] != b.leave[s]) ++different;
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
    if (std::find(chosen.begin(), chosen.end(), k) != chosen.end()) break;  // the rest are equal to these
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
    evolve_all(clones, options.threads, evolve);
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
    if (options.another && !options.another()) break;
    clones = run(kept);
    for (std::size_t k = 0; k < clones.size(); ++k) {
      const std::size_t parent = k / candidates;
      if (value_of(clones[k].report) >= kept_values[parent]) continue;
      kept[parent] = std::move(clones[k].tour);
      kept_values[parent] = value_of(clones[k].report);
    }
  }
  const auto best = std::min_element(kept_values.begin(), kept_values.end()) - kept_values.begin();
  report.after = kept_values[static_cast<std::size_t>(best)];
  tour = std::move(kept[static_cast<std::size_t>(best)]);
  return report;
}

}  // namespace unicursal::core
