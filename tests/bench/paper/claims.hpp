// What is said about the curves, in the paper, in README.md, core/README.md and tests/README.md, as
// conditions on the measured figures. Each holds or does not; the page shows which.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tests/bench/paper/figures.hpp"
#include "tests/bench/paper/series.hpp"

namespace unicursal::bench {

/// All methods on one part; methods that were left out are absent.
struct PartReport {
  Part part;
  std::map<std::string, Figures> methods;
  Joining joining;
  core::LocalOperations operations;          ///< of our curve
  double graph = 0, cycle = 0, fairing = 0;  ///< processor time of our stages
};

/// One objective on one part (Figure 14).
struct ObjectiveReport {
  std::string name;
  Figures figures;
};

/// Growth against fairing (Figure 26).
struct Convergence {
  std::string part;
  std::size_t fairing_steps = 0, growth_steps = 0;
  bool growth_finished = true;
  std::string published;
};

struct Report {
  std::vector<PartReport> parts;
  std::vector<SpacingAgainstD> spacing;
  std::optional<HeldSpacing> held;
  double held_width = 0;
  std::vector<CostAtD> costs;
  std::string cost_part;
  std::vector<ObjectiveReport> objectives;
  std::optional<Smoothing> smoothing;
  Figures smooth, unsmooth;
  std::vector<Convergence> convergence;
  double seconds = 0;
};

struct Claim {
  std::string said;                  ///< the claim, as a sentence
  std::string source;                ///< who says so
  std::vector<std::string> against;  ///< where it does not hold, with the figures
  std::size_t cases = 0;             ///< in how many cases it was put to the test

  bool holds() const { return against.empty(); }
};

/// Only those that the report has figures for.
std::vector<Claim> claims(const Report& report);

}  // namespace unicursal::bench
