// The figures of one method on one part, measured alike for all methods. mm, radians, s.
//
// Spacing is that of the bead width, area ÷ length over windows of one bead width along the lines, where each
// point of the island belongs to the nearest line. Points are those of a fine lattice (core/geometry), which
// takes open lines, too; for single closed curves the exact diagram gives E and CV as well.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/planner/island_plan.hpp"
#include "tests/bench/paper/method.hpp"
#include "tests/bench/paper/parts.hpp"

namespace unicursal::bench {

/// One method on one part: a filling for each island.
struct Run {
  std::string method;
  std::vector<Filling> islands;
  double seconds = 0;  ///< processor time
  // Of our curves: processor time of the stages, and figures of the combinatorial optimiser.
  double graph = 0, cycle = 0, fairing = 0;
  core::LocalOperations operations;
};

/// Shares of the length by spacing; the last bin holds all wider ones.
struct Spread {
  static constexpr std::size_t bins = 40;
  static constexpr double bin = 0.05;  ///< bead widths

  std::vector<double> shares = std::vector<double>(bins, 0.0);
  double mean = 0;       ///< mm
  double variation = 0;  ///< standard deviation ÷ mean (CV)
};

/// What the simulator's bed gets, in shares of the part's area.
struct Bed {
  double gaps = 0, overfill = 0;
};

struct Figures {
  std::string method;
  std::size_t iterations = 0;
  bool finished = true;
  double seconds = 0;
  double length = 0;
  Spread spacing;
  double coverage = 0;                                    ///< E = E_CVT ÷ (A w²)
  std::optional<double> exact_coverage, exact_variation;  ///< by the exact diagram
  double bare = 0;  ///< share of the area that is farther than 0.75 bead widths from the lines
  std::size_t lines = 0, travels = 0;
  double travel_length = 0;
  std::size_t crossings = 0;                ///< of borders of materials, travels not counted
  std::size_t meetings = 0, outside = 0;    ///< of lines with each other and themselves; segments outside
  std::optional<double> alignment;          ///< mean squared angle to the asked directions, rad²
  std::optional<double> isotropy;           ///< E_iso of the isotropic zones together, rad²
  Bed constant, own;                        ///< one bead width everywhere; each segment's own area
  std::string lines_picture, gaps_picture;  ///< files beside the page
};

/// Measures, and draws the pictures into `folder`.
Figures figures(const Part& part, const Run& run, const std::filesystem::path& folder);

/// The areas of the segments of all lines, mm², in their order; `moment` receives ∫ distance², mm⁴, and
/// `bare` the area that is farther than 0.75 bead widths away.
std::vector<double> areas_of(const std::vector<Line>& lines, const core::Polygon& island, double bead_width,
                             double& moment, double& bare);

/// The spacing over windows of one bead width, all islands together.
class SpreadMeter {
 public:
  explicit SpreadMeter(double bead_width) : w_(bead_width) {}
  void add(const Line& line, const double* areas);
  Spread spread() const;

 private:
  double w_;
  std::vector<double> widths_;
};

/// The number of pairs of segments without a common point that meet.
std::size_t meetings(const std::vector<Line>& lines);

}  // namespace unicursal::bench
