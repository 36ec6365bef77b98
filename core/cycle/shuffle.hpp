// The combinatorial optimiser (paper §3.3.3): random local operations that turn a Hamiltonian cycle into a
// better one.
//
// Departures from the paper. The acceptance rule of its Algorithm 1 is kept for comparison; the default is an
// annealing from `hot` to `cold`, which reaches a better cycle than a population of short runs in a tenth of
// the looks (tests/bench/cycle). Looks go to places where something is wrong more often than to others, since
// in a cycle that is nearly as asked almost no other place has anything to offer.
#pragma once

#include <cstdint>

#include "core/cycle/cycle_objective.hpp"
#include "core/numeric/step_budget.hpp"

namespace unicursal::core {

struct ShuffleOptions {
  enum class Rule { annealing, algorithm_1 };
  Rule rule = Rule::annealing;
  int sweeps = 400;       ///< a sweep is one look per stop; Algorithm 1: half of them shuffle, half improve
  double hot = 0.5;       ///< first temperature, in mean edge lengths times rad² (the objective's unit)
  double cold = 0.01;     ///< last temperature
  double at_flaws = 0.6;  ///< share of looks at stops where the objective is poor

  // The population of the paper: `champions` (K) different cycles are kept, each is evolved `candidates` (C)
  // times in each of `generations` (I) rounds.
  int champions = 1, candidates = 1, generations = 1;
  unsigned threads = 1;  ///< of the population; the result does not depend on it

  ObjectiveWeights weights;
  MayContinue another;  ///< asked before each sweep; with a population before each generation
};

struct ShuffleReport {
  std::uint64_t looks = 0;       ///< attempts
  std::uint64_t found = 0;       ///< of them, where an operation fits
  std::uint64_t accepted = 0;    ///< of those, carried out
  std::uint64_t labelled = 0;    ///< stops relabelled to keep the order (tour_order.hpp)
  double before = 0, after = 0;  ///< the objective, mm · rad²

  void add(const ShuffleReport& other);
};

/// Improves the tour; never returns a worse one. Deterministic for equal arguments and answers of `another`.
ShuffleReport shuffle(Tour& tour, const DemandAt& demand, const RunCost& run_cost,
                      const ShuffleOptions& options, Random& random);

}  // namespace unicursal::core
