#include "tests/bench/paper/parts.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/geometry/region.hpp"
#include "host/engine/prepared_job.hpp"
#include "host/job/load_job.hpp"

namespace unicursal::bench {
namespace {

using core::Polygon;
using core::Vec2;

constexpr double layer_height = 0.2;
constexpr double least_share_of_width = 0.55;  ///< of a bead width that can be laid
constexpr std::size_t layers_alike = 20;       ///< a job with more layers than this shows three of them

core::PlanOptions options_for_width(double w) {
  core::PlanOptions options;
  options.bead_width = w;
  options.min_bead_width = least_share_of_width * w;
  return options;
}

core::Layer layer_of(const core::Island& island) {
  return {0, layer_height / 2, layer_height, layer_height, {island}};
}

Polygon box(const Vec2& low, const Vec2& high) {
  return {{low, {high.x(), low.y()}, high, {low.x(), high.y()}}, {}};
}

}  // namespace

double Part::area() const {
  double sum = 0;
  for (const core::Island& island : layer.islands) sum += core::area(island.outline);
  return sum;
}

Part square_part(const std::string& name, const std::string& title, core::PatternKind pattern) {
  const Polygon square = box({0, 0}, {40, 40});
  std::vector<core::Zone> zones(1);
  zones[0].pattern.kind = pattern;
  return {name, title, layer_of({square, {{0, {square}}}}), zones, options_for_width(1.077)};
}

Part narrow_part() {
  constexpr double w = 0.8, room = 14, pitch = 20, passage = 2.6 * w;
  core::Region region;
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 3; ++column) {
      const Vec2 low(pitch * column, pitch * row), middle = low + Vec2::Constant(room / 2);
      region = core::unite(region, {box(low, low + Vec2::Constant(room))});
      const double half = passage / 2;
      if (column < 2)
        region = core::unite(region, {box(middle + Vec2(0, -half), middle + Vec2(pitch, half))});
      if (row < 1 && column != 1)
        region = core::unite(region, {box(middle + Vec2(-half, 0), middle + Vec2(half, pitch))});
    }
  }
  return {"narrow", "Rooms and narrow passages", layer_of({region.front(), {{0, {region.front()}}}}),
          std::vector<core::Zone>(1), options_for_width(w)};
}

std::vector<Part> parts_of_job(const std::filesystem::path& file) {
  const host::PreparedJob job = host::prepare(host::load_job(file));
  const std::string name = file.stem().string();
  std::vector<std::size_t> layers{job.first};
  if (job.count > layers_alike)
    layers = {job.first + job.count / 10, job.first + job.count / 2, job.first + 9 * job.count / 10};
  std::vector<Part> parts;
  for (const std::size_t index : layers) {
    Part part;
    part.name = layers.size() > 1 ? fmt::format("{}-{}", name, index) : name;
    part.title = layers.size() > 1 ? fmt::format("{}, layer {}", name, index) : name;
    part.layer = job.part->layer(index);
    part.zones = job.part->zones();
    part.plan = host::lookahead_options(job).plan;
    part.plan.perimeters = 0;  // the methods are compared in isolation, as in the paper's Figure 22
    if (!part.layer.islands.empty()) parts.push_back(std::move(part));
  }
  return parts;
}

Part with_pattern(Part part, const std::string& name, core::PatternKind pattern) {
  part.name += "-" + name;
  part.title += ", " + name;
  part.zones.assign(1, core::Zone{});
  part.zones[0].pattern.kind = pattern;
  for (core::Island& island : part.layer.islands) island.zones = {{0, {island.outline}}};
  return part;
}

}  // namespace unicursal::bench
