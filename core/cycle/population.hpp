// The population of the paper's optimisation loop (§3.3.3): champions that differ from one another, their
// candidates, and generations. Each run has its own random stream, so that the result does not depend on the
// number of threads.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "core/cycle/shuffle_options.hpp"
#include "core/cycle/tour.hpp"
#include "core/numeric/random.hpp"

namespace unicursal::core {

/// Improves a tour in place with one random stream. Called from several threads.
using Evolve = std::function<ShuffleReport(Tour&, Random&, const MayContinue&)>;

/// The number of edges that one tour has and the other has not (the paper's distance between cycles).
/// Precondition: both are tours of the same graph.
std::size_t distance(const Tour& a, const Tour& b);

/// The indices of the tours that the paper keeps as champions, at most `count`: first the one of least value,
/// then always the one farthest from those already chosen (Hochbaum and Shmoys 1985).
std::vector<std::size_t> diverse(const std::vector<Tour>& tours, const std::vector<double>& values,
                                 std::size_t count);

/// Evolves K · C clones of the tour and chooses K champions among them. In each generation every champion is
/// replaced by the best of its C candidates if that is better. The best champion of all becomes `tour`.
ShuffleReport evolve_population(Tour& tour, const ShuffleOptions& options, Random& random,
                                const Evolve& evolve);

}  // namespace unicursal::core
