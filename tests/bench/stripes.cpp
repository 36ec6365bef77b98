// Figures of curves along directions that are asked for everywhere: bench_stripes [SEEDS]. A square of 40 mm
// and a bead of 1.077 mm, at several angles, with an anisotropic zone, and with fields that have
// singularities, a jump or noise; the mean over seeds, the worst, and the spread of the alignment.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "core/numeric/random.hpp"
#include "core/planner/plan_island.hpp"

namespace {

using namespace unicursal::core;

constexpr double side = 40, bead_width = 1.077, pi = std::numbers::pi;

struct Sample {
  std::string name;
  Pattern pattern;
};

/// A field in a file of its own, in a folder that is removed at the end.
Sample field(const std::filesystem::path& folder, const std::string& name,
             const std::function<double(const Vec2&)>& angle) {
  const std::filesystem::path path = folder / (name + ".csv");
  std::ofstream file(path);
  for (double x = 0.25; x < side; x += 0.5) {
    for (double y = 0.25; y < side; y += 0.5)
      file << x << ',' << y << ',' << angle({x, y}) * 180 / pi << '\n';
  }
  return {name, {PatternKind::field, 0, path, false}};
}

double turn(const Vec2& p, const Vec2& center) {
  return std::atan2(p.y() - center.y(), p.x() - center.x());
}

std::vector<Sample> samples(const std::filesystem::path& folder) {
  std::vector<Sample> result{{"anisotropic", {PatternKind::anisotropic, 0, {}, false}},
                             {"parallel", {PatternKind::parallel, 0, {}, false}},
                             {"orthogonal", {PatternKind::orthogonal, 0, {}, false}}};
  for (const int degrees : {0, 10, 30, 45})
    result.push_back(
        {fmt::format("{} degrees", degrees), {PatternKind::angle, degrees * pi / 180, {}, false}});
  Random random(1);
  result.push_back(field(folder, "source", [](const Vec2& p) { return turn(p, {19, 22}); }));
  result.push_back(field(folder, "vortex", [](const Vec2& p) { return turn(p, {19, 22}) + pi / 2; }));
  result.push_back(field(folder, "saddle", [](const Vec2& p) { return -turn(p, {19, 22}); }));
  result.push_back(field(folder, "half turns", [](const Vec2& p) {
    return (turn(p, {12, 21}) + turn(p, {27, 18}) - turn(p, {20, 33})) / 2;
  }));
  result.push_back(field(folder, "jump", [](const Vec2& p) { return p.x() < 20 ? 0.1 : 1.4; }));
  result.push_back(field(folder, "noise", [&](const Vec2& p) {
    return 0.3 + 0.03 * p.x() + 20 * pi / 180 * std::sqrt(3) * random.uniform(-1, 1);
  }));
  return result;
}

void measure(const Sample& sample, int seeds) {
  const Polygon square{{{0, 0}, {side, 0}, {side, side}, {0, side}}, {}};
  const Island island{square, {{0, {square}}}};
  std::vector<Zone> zones(1);
  zones[0].pattern = sample.pattern;
  const IslandPlanner planner(zones);
  double ali = 0, squares = 0, worst_ali = 0, coverage = 0, worst_coverage = 0, anisotropy = 0, variation = 0;
  std::size_t broken = 0;
  const std::clock_t start = std::clock();
  for (int seed = 1; seed <= seeds; ++seed) {
    PlanOptions options;
    options.bead_width = bead_width;
    options.min_bead_width = 0.55 * bead_width;
    options.seed = static_cast<std::uint64_t>(seed);
    const IslandPlan plan = planner.plan(island, 0, options);
    if (plan.curves.size() != 1) ++broken;
    if (plan.curves.empty()) continue;
    const PlannedCurve& curve = plan.curves.front();
    broken += curve.self_intersections + curve.outside_segments;
    const CurveObjectives& o = curve.objectives;
    ali += o.alignment / seeds;
    squares += o.alignment * o.alignment / seeds;
    worst_ali = std::max(worst_ali, o.alignment);
    coverage += o.normalised_coverage / seeds;
    worst_coverage = std::max(worst_coverage, o.normalised_coverage);
    anisotropy = std::max(anisotropy, o.anisotropy);
    variation += o.width_variation / seeds;
  }
  const double spread = ali > 0 ? std::sqrt(std::max(0.0, squares - ali * ali)) / ali : 0;
  fmt::print("{:12} {:.3f} / {:.3f} {:6.1f} %   {:.4f} / {:.4f}   {:.3f}   {:.3f}   {}   {:.2f}\n",
             sample.name, ali, worst_ali, 100 * spread, coverage, worst_coverage, anisotropy, variation,
             broken, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / seeds);
}

}  // namespace

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 9;
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "unicursal-bench-stripes";
  std::filesystem::create_directories(folder);
  fmt::print("{} seeds; rad², mean / worst\n", seeds);
  fmt::print("directions   ali           spread     E                 E_aniso CV      broken CPU s\n");
  for (const Sample& sample : samples(folder)) measure(sample, seeds);
  std::filesystem::remove_all(folder);
  return 0;
}
