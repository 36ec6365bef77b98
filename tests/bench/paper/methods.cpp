#include "tests/bench/paper/methods.hpp"

#include <ctime>
#include <numeric>

#include "core/planner/plan_island.hpp"
#include "host/lookahead/lookahead.hpp"
#include "tests/bench/paper/fermat_spirals.hpp"
#include "tests/bench/paper/growth.hpp"
#include "tests/bench/paper/zigzag.hpp"

namespace unicursal::bench {
namespace {

Filling ours(const core::IslandPlanner& planner, const Part& part, std::size_t island, Run& run) {
  core::PlanOptions options = part.plan;
  options.seed = host::island_seed(1, part.layer.index, island);
  options.threads = 1;
  const core::IslandPlan plan = planner.plan(part.layer.islands[island], part.layer.z, options);
  Filling filling;
  for (const core::PlannedCurve& curve : plan.curves) {
    Line line;
    for (const core::Bead& bead : curve.path.beads) line.points.push_back(bead.position);
    filling.lines.push_back(std::move(line));
  }
  filling.iterations = static_cast<std::size_t>(std::accumulate(plan.effort.begin(), plan.effort.end(), 0));
  run.graph += plan.graph.cpu_seconds;
  run.cycle += plan.cycle.cpu_seconds;
  run.fairing += plan.fairing.cpu_seconds;
  run.operations.looks += plan.operations.looks;
  run.operations.found += plan.operations.found;
  run.operations.accepted += plan.operations.accepted;
  return filling;
}

}  // namespace

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

std::string title_of(std::string_view method) {
  if (method == "ours") return "this project";
  if (method == "fermat") return "Fermat spirals [ZGH*16]";
  if (method == "growth") return "growth [PS06]";
  return std::string(method);
}

Run run_method(std::string_view method, const Part& part) {
  Run run;
  run.method = method;
  const core::IslandPlanner planner(part.zones);
  const double start = processor_seconds();
  for (std::size_t k = 0; k < part.layer.islands.size(); ++k) {
    const core::Polygon& outline = part.layer.islands[k].outline;
    const double w = part.width();
    run.islands.push_back(method == "ours"     ? ours(planner, part, k, run)
                          : method == "zigzag" ? zigzag(outline, w)
                          : method == "fermat" ? fermat_spirals(outline, w)
                                               : growth(outline, w));
  }
  run.seconds = processor_seconds() - start;
  return run;
}

}  // namespace unicursal::bench
