// What the planner is asked for one island, and what it returns: options, curves, measures, effort. mm, s.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/curve/bead_path.hpp"

namespace unicursal::core {

struct Stages;

/// Weights of the optimisers, by name.
enum class Preset {
  best,   ///< what measures best over all example jobs
  paper,  ///< the paper's weights (31), (54), its acceptance rule and its population, as far as they have a
          ///< counterpart here
};

/// The steps that each stage of one island took, in the order in which the stages ran.
using Effort = std::vector<int>;

struct PlanOptions {
  double bead_width = 0;                 ///< mm; the curve's length aims at area ÷ bead_width
  std::optional<double> seed_distance;   ///< mm, the paper's d; follows from the bead width when absent
  double min_bead_width = 0;             ///< mm; what is narrower than this cannot be laid
  std::optional<double> max_bead_width;  ///< mm; what is wider is told
  int perimeters = 0;                    ///< contours around the fill, in the same closed curve
  int threads = 1;  ///< that share one island's work; the result is the same for any number, and the stages'
                    ///< processor time is that of the calling one
  std::uint64_t seed = 0;  ///< of the random jitter; differ it from layer to layer
  Preset preset = Preset::best;
  double quality = 1;              ///< how long the optimisers run; more is better and slower
  std::function<bool()> enough;    ///< asked between steps; once true, what there is gets a few last steps of
                                   ///< fairing and is returned
  std::optional<Effort> recorded;  ///< repeat a plan with the effort that it took; `enough` is not asked then
  Stages* stages = nullptr;        ///< receives what each stage leaves behind (stages.hpp), if wanted
};

/// Wall and processor time of one stage, s.
struct StageTime {
  double seconds = 0;
  double cpu_seconds = 0;
};

/// What the combinatorial optimiser did (paper §3.3.3).
struct LocalOperations {
  std::uint64_t looks = 0;     ///< places looked at: attempts
  std::uint64_t found = 0;     ///< of them, where an operation fits
  std::uint64_t accepted = 0;  ///< of those, carried out
};

/// Values of the objectives at the end, all from the exact diagram (paper §3.1 and Appendix A).
struct CurveObjectives {
  double coverage = 0;             ///< E_CVT (7), mm⁴
  double normalised_coverage = 0;  ///< E_CVT ÷ (A·w²), w = A/L; straight parallel lines give 1/12
  double length = 0;               ///< E_Len (27), mm²
  double smoothness = 0;           ///< E_Lap (29), mm²
  double alignment =
      0;  ///< mean squared angle to the asked directions, rad²; 0.82 is none, 0 also if none is asked
  double isotropy = 0;         ///< E_iso (50), rad², of the worst isotropic zone; 0 is even, 0.82 all alike
  double anisotropy = 0;       ///< E_aniso (52), rad², of the worst anisotropic zone; 0 is all alike
  double width_variation = 0;  ///< standard deviation ÷ mean of area ÷ length over windows of one bead width
};

/// One closed curve and how it came about.
struct PlannedCurve {
  BeadPath path;
  double area = 0;  ///< mm², of the piece of the island that this curve fills
  CurveObjectives objectives;
  bool faired = false;  ///< the geometric optimiser's result was sound and is what `path` is
  int perimeters =
      0;  ///< contours really laid; fewer than asked for where they do not fit or cannot be joined
  std::size_t zone_crossings = 0;      ///< times the curve passes between material zones
  std::size_t self_intersections = 0;  ///< pairs of non-neighbouring segments that meet; 0 by construction
  std::size_t outside_segments = 0;  ///< segments that touch or cross the island's border; 0 by construction
  std::size_t split_and_reconnect = 0;  ///< paper Table 1
  std::size_t doubled_edges = 0;        ///< paper Table 1
  double farthest = 0;                  ///< mm, greatest distance from the opened island to the curve
  double narrow_length = 0;  ///< mm of the curve whose bead is narrower than can be laid, as in a neck
  double wide_length = 0;    ///< mm of the curve whose bead is wider than can be laid
};

/// All that became of one island.
struct IslandPlan {
  std::vector<PlannedCurve>
      curves;                ///< normally one; more where necks are too thin to pass, none if too thin
  double unfilled_area = 0;  ///< mm², of the island that no bead reaches because it is too thin
  double far_area =
      0;  ///< mm², of the island opened by a disc of one bead width, over 1.2 widths from the curve
  StageTime graph, cycle, fairing, widths;
  LocalOperations operations;
  Effort effort;  ///< to be recorded; the same again gives the same bytes
};

}  // namespace unicursal::core
