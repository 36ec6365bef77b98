// The population of the paper's optimisation loop (§3.3.3): champions that differ, their candidates, and
// generations. Each run has a random stream of its own, so that threads change nothing.
#pragma once

#include <functional>

#include "core/cycle/shuffle.hpp"

namespace unicursal::core {

/// Improves a tour in place with one random stream. Called from several threads.
using Evolve = std::function<ShuffleReport(Tour&, Random&, const MayContinue&)>;

/// Edges that one tour has and the other has not (the paper's distance between cycles). Precondition: both
/// are tours of the same graph.
std::size_t distance(const Tour& a, const Tour& b);

/// The `count` tours of `values`/`tours` that the paper keeps: the best, then always the one farthest from
/// those chosen (Hochbaum and Shmoys 1985). Indices, best first.
std::vector<std::size_t> diverse(const std::vector<Tour>& tours, const std::vector<double>& values,
                                 std::size_t count);

/// K · C clones of the tour are evolved, K champions chosen, and in each generation every champion is
/// replaced by the best of its C candidates if that is better. The best champion of all becomes `tour`.
ShuffleReport evolve_population(Tour& tour, const ShuffleOptions& options, Random& random,
                                const Evolve& evolve);

}  // namespace unicursal::core
