// What the planner is asked for one island, and what it returns: options, curves, measurements, effort. mm,
// s. V, d, L, E_CVT and γ are explained in core/README.md, "Notation".
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
  best,   ///< the weights that measure best over all example jobs
  paper,  ///< the paper's weights (31), (54), its acceptance rule and its population, as far as they have a
          ///< counterpart here
};

/// The number of steps that each stage of one island took, in the order in which the stages ran.
using Effort = std::vector<int>;

struct PlanOptions {
  double bead_width = 0;                 ///< mm; the curve's target length is area ÷ bead_width
  std::optional<double> seed_distance;   ///< the paper's d, mm; derived from the bead width if absent
  double min_bead_width = 0;             ///< mm; narrower beads cannot be laid
  std::optional<double> max_bead_width;  ///< mm; wider beads are reported
  int perimeters = 0;                    ///< contours around the fill, in the same closed curve
  int threads = 1;  ///< threads that share one island's work; they do not change the result. The processor
                    ///< time of the stages is that of the calling thread only
  std::uint64_t seed = 0;  ///< of the random jitter; should differ from layer to layer
  Preset preset = Preset::best;
  double quality = 1;                  ///< scales how long the optimisers run; more is better and slower
  std::function<bool()> budget_spent;  ///< asked between steps; once it returns true, the best curve so far
                                       ///< gets a few last steps of fairing and is returned
  std::optional<Effort>
      recorded;              ///< repeats a plan with the effort that it took; budget_spent is not asked then
  Stages* stages = nullptr;  ///< if not null, receives the results of each stage (stages.hpp)
};

/// Wall and processor time of one stage, s.
struct StageTime {
  double seconds = 0;
  double cpu_seconds = 0;
};

/// Figures of the combinatorial optimiser (paper §3.3.3).
struct LocalOperations {
  std::uint64_t looks = 0;     ///< attempts
  std::uint64_t found = 0;     ///< attempts where an operation fits
  std::uint64_t accepted = 0;  ///< operations carried out
};

/// Values of the objectives at the end, all from the exact diagram (paper §3.1 and Appendix A).
struct CurveObjectives {
  double coverage = 0;             ///< E_CVT (7), mm⁴
  double normalised_coverage = 0;  ///< E_CVT ÷ (A·w²), w = A/L; straight parallel lines give 1/12
  double length = 0;               ///< E_Len (27), mm²
  double smoothness = 0;           ///< E_Lap (29), mm²
  double alignment = 0;   ///< mean squared angle to the asked directions, rad²; 0.82 if the curve ignores
                          ///< them, 0 also if none are asked
  double isotropy = 0;    ///< E_iso (50) of the worst isotropic zone, rad²; 0 is even, 0.82 all alike
  double anisotropy = 0;  ///< E_aniso (52) of the worst anisotropic zone, rad²; 0 is all alike
  double width_variation = 0;  ///< standard deviation ÷ mean of area ÷ length over windows of one bead width
};

/// One closed curve and how it was made.
struct PlannedCurve {
  BeadPath path;
  double area = 0;  ///< of the piece of the island that this curve fills, mm²
  CurveObjectives objectives;
  bool faired = false;  ///< `path` is the result of the geometric optimiser, which was sound
  int perimeters = 0;   ///< contours laid; fewer than asked for where they do not fit or cannot be joined
  std::size_t zone_crossings = 0;  ///< how often the curve passes between material zones
  std::size_t self_intersections =
      0;  ///< pairs of segments without a common vertex that meet; 0 by construction
  std::size_t outside_segments = 0;  ///< segments that touch or cross the island's border; 0 by construction
  std::size_t split_and_reconnect = 0;  ///< paper Table 1
  std::size_t doubled_edges = 0;        ///< paper Table 1
  double farthest = 0;  ///< greatest distance from a point of the opened island to the curve, mm
  double narrow_length =
      0;                   ///< length of the curve whose bead is narrower than can be laid, as in a neck, mm
  double wide_length = 0;  ///< length of the curve whose bead is wider than can be laid, mm
};

/// The plan of one island.
struct IslandPlan {
  std::vector<PlannedCurve>
      curves;                ///< normally one; several if necks are too thin to pass, none if all is too thin
  double unfilled_area = 0;  ///< part of the island that no bead reaches because it is too thin, mm²
  double far_area = 0;  ///< part of the island, opened by a disc of one bead width, that is more than 1.2
                        ///< bead widths away from the curve, mm²
  StageTime graph, cycle, fairing, widths;
  LocalOperations operations;
  Effort effort;  ///< spent on it; the same effort gives the same bytes
};

}  // namespace unicursal::core
