// Measures what needles do to the cell graph: the share of the length of its inner edges that lies within 0.3
// rad of the field (0.19 if all directions were equally frequent), with points and with needles, and the time
// they cost. With a folder as argument it draws the graphs there.
#include <fmt/core.h>

#include <cmath>
#include <ctime>
#include <numbers>
#include <string>

#include "core/field/make_direction_field.hpp"
#include "core/geometry/region.hpp"
#include "core/graph/cell_graph.hpp"
#include "core/picture/image.hpp"

namespace {

using namespace unicursal;
using namespace unicursal::core;

constexpr double near_the_field = 0.3;  ///< rad
constexpr int runs = 5;

bool inner(const CellGraph& graph, EdgeIndex e) {
  return graph.face(PlanarGraph::forward(e)) != outside && graph.face(PlanarGraph::backward(e)) != outside;
}

struct Sample {
  std::string name;
  Polygon domain;
  DirectionField field;
};

Sample sample_of(const std::string& name, const Ring& outline, const Pattern& pattern) {
  const Polygon domain{outline, {}};
  Zone zone;
  zone.pattern = pattern;
  return {name, domain, make_direction_field({domain, {{0, {domain}}}}, {zone}, 0.25)};
}

Sample disc() {
  Ring ring;
  for (int k = 0; k < 200; ++k) {
    const double turn = 2 * std::numbers::pi * k / 200;
    ring.push_back(20 * Vec2(std::cos(turn), std::sin(turn)));
  }
  Pattern pattern;
  pattern.kind = PatternKind::parallel;
  return sample_of("disc", ring, pattern);
}

Sample square() {
  Pattern pattern;
  pattern.kind = PatternKind::angle;
  pattern.angle = std::numbers::pi / 6;
  return sample_of("square", {{0, 0}, {40, 0}, {40, 40}, {0, 40}}, pattern);
}

/// Share of the length of inner edges near the field, and their mean squared angle to it, rad².
std::pair<double, double> alignment(const CellGraph& graph, const DirectionField& field) {
  double total = 0, near = 0, squared = 0;
  for (const EdgeIndex e : graph.edges()) {
    if (!inner(graph, e)) continue;
    const Ring line = graph.line(PlanarGraph::forward(e));
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const Vec2 u = line[k + 1] - line[k], asked = field.at((line[k] + line[k + 1]) / 2);
      if (asked.norm() < 0.1) continue;
      const double off = std::remainder(std::atan2(u.y(), u.x()) - direction(asked), std::numbers::pi);
      total += u.norm();
      squared += off * off * u.norm();
      if (std::abs(off) <= near_the_field) near += u.norm();
    }
  }
  return {near / total, squared / total};
}

void draw(const CellGraph& graph, const std::string& file) {
  constexpr double scale = 20;
  const Box box = bounds(graph.position.values());
  const Vec2 size = scale * box.size() + Vec2(20, 20);
  picture::Image image(static_cast<std::size_t>(size.x()), static_cast<std::size_t>(size.y()),
                       {255, 255, 255});
  const auto pixel = [&](const Vec2& p) {
    return Vec2(10 + scale * (p.x() - box.min.x()), size.y() - 10 - scale * (p.y() - box.min.y()));
  };
  for (const EdgeIndex e : graph.edges()) {
    const Ring line = graph.line(PlanarGraph::forward(e));
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const Vec2 a = pixel(line[k]), b = pixel(line[k + 1]);
      image.stroke(a.x(), a.y(), b.x(), b.y(), 2, {30, 60, 120});
    }
  }
  picture::write_png(file, image);
}

void measure(const Sample& sample, const std::string& variant, const GraphOptions& options,
             const std::string& folder) {
  double near = 0, squared = 0, nodes = 0, bent = 0;
  int graphs = 0;
  const std::clock_t begin = std::clock();
  for (int run = 0; run < runs; ++run) {
    Random random(static_cast<std::uint64_t>(run));
    const auto graph = make_cell_graph(sample.domain, options, random);
    if (!graph) continue;
    const auto [share, angle] = alignment(*graph, sample.field);
    near += share;
    squared += angle;
    nodes += static_cast<double>(graph->node_count());
    for (const EdgeIndex e : graph->edges()) {
      if (inner(*graph, e) && !graph->via[e].empty()) ++bent;
    }
    ++graphs;
    if (run == 0 && !folder.empty()) draw(*graph, folder + "/" + sample.name + "-" + variant + ".png");
  }
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  fmt::print("{:>8} {:>22} {:>8.0f} {:>8.1f} {:>8.3f} {:>8.3f} {:>8.3f}\n", sample.name, variant,
             nodes / graphs, bent / graphs, near / graphs, squared / graphs, seconds / graphs);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string folder = argc > 1 ? argv[1] : "";
  fmt::print("{:>8} {:>22} {:>8} {:>8} {:>8} {:>8} {:>8}\n", "", "", "nodes", "bent", "near", "rad²",
             "CPU s");
  for (const Sample& sample : {disc(), square()}) {
    GraphOptions options;
    options.seeds.d = 1.2;
    measure(sample, "points", options, folder);
    options.field = &sample.field;
    for (const double length : {1.0, 1.5, 2.0, 3.0}) {
      options.needle_length = length;
      measure(sample, fmt::format("needles-{:.1f}", length), options, folder);
    }
    if (sample.name != "square") continue;
    for (const double turn : {0.0, std::numbers::pi / 6}) {
      for (const double stretch : {1.0, 2.0}) {
        options.seeds = {1.2, std::numbers::pi / 6 + turn, stretch};
        const std::string rows = fmt::format("rows{}-{:.1f}", turn > 0 ? "+30" : "", stretch);
        options.field = nullptr;
        measure(sample, rows + "-points", options, folder);
        options.field = &sample.field;
        options.needle_length = 2;
        measure(sample, rows + "-needles-2.0", options, folder);
      }
    }
  }
}
