// Options and report of the combinatorial optimiser (shuffle.hpp).
#pragma once

#include <cstdint>

#include "core/cycle/cycle_objective.hpp"
#include "core/numeric/parallel.hpp"
#include "core/numeric/step_budget.hpp"

namespace unicursal::core {

struct ShuffleOptions {
  enum class Rule { annealing, algorithm_1 };
  Rule rule = Rule::annealing;
  int sweeps = 400;       ///< a sweep is one look per stop that can move; in Algorithm 1 half of the sweeps
                          ///< shuffle, half improve
  double hot = 0.5;       ///< first temperature, mean edge lengths · rad² (the objective's unit)
  double cold = 0.01;     ///< last temperature, in the same unit
  double at_flaws = 0.6;  ///< share of the looks that go to flaws

  // The population of the paper: `champions` (K) different cycles are kept, and each is evolved `candidates`
  // (C) times in each of `generations` (I) rounds.
  int champions = 1, candidates = 1, generations = 1;
  Workers* workers =
      nullptr;  ///< share a tour's windows, or a population's runs; the result does not depend on them

  ObjectiveWeights weights;
  MayContinue may_continue;  ///< asked before every eighth sweep, in Algorithm 1 before each; with a
                             ///< population, before each generation
};

struct ShuffleReport {
  std::uint64_t looks = 0;     ///< attempts
  std::uint64_t found = 0;     ///< attempts where an operation fits
  std::uint64_t accepted = 0;  ///< operations carried out
  std::uint64_t labelled = 0;  ///< stops relabelled to keep the order (tour_order.hpp)
  double before = 0;           ///< the objective at first, mm · rad²
  double after = 0;            ///< the objective in the end

  void add(const ShuffleReport& other);
};

}  // namespace unicursal::core
