// The combinatorial optimiser (paper §3.3.3): random local operations that improve a Hamiltonian cycle.
//
// Departures from the paper. The default acceptance rule is an annealing from the temperature `hot` to
// `cold`, which reaches a better cycle than a population of short runs in a tenth of the looks; the rule of
// the paper's Algorithm 1 is kept for comparison. More looks go to stops where the objective is poor
// (CycleObjective::flaws()) than to others, since in a cycle that is nearly as asked almost all other places
// have nothing to offer.
#pragma once

#include "core/cycle/shuffle_options.hpp"
#include "core/cycle/tour.hpp"
#include "core/numeric/random.hpp"

namespace unicursal::core {

/// Improves the tour; never returns a worse one. Deterministic for equal arguments and equal answers of
/// `may_continue`.
ShuffleReport shuffle(Tour& tour, const DemandAt& demand, const RunCost& run_cost,
                      const ShuffleOptions& options, Random& random);

}  // namespace unicursal::core
