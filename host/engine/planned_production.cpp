#include "host/engine/planned_production.hpp"

#include <algorithm>
#include <utility>

#include "host/engine/session.hpp"

namespace unicursal::host {
namespace {

LookaheadOptions behind(LookaheadOptions options, const SpoolExtent& kept) {
  const std::size_t done = std::min(options.count, kept.layers);
  options.first += done;
  options.count -= done;
  return options;
}

}  // namespace

PlannedProduction::PlannedProduction(PreparedJob prepared)
    : prepared_(std::move(prepared)), maker_(prepared_) {}

void PlannedProduction::begin(const std::shared_ptr<Clock>& clock, const SpoolExtent& kept) {
  plan(paced(behind(lookahead_options(prepared_), kept), clock));
}

KeptSource& PlannedProduction::open(const SpoolExtent& kept) {
  return source_.emplace(*lookahead_, maker_, kept.rest);
}

void PlannedProduction::catch_up(const Spool& spool) {
  ChunkReader reader(spool.chunks());
  while (const auto chunk = reader.next()) {
    switch (chunk->kind) {
      case SpooledChunk::Kind::start:
        check_same(maker_.start(), *chunk, spool);
        break;
      case SpooledChunk::Kind::layer:
        check_same(maker_.replay(chunk->layer), *chunk, spool);
        break;
      case SpooledChunk::Kind::rest:
        check_same(maker_.rest(), *chunk, spool);
        break;
      case SpooledChunk::Kind::finish:
        check_same(maker_.finish(), *chunk, spool);
        break;
      case SpooledChunk::Kind::stretch:
        check_same({}, *chunk, spool);  // of another kind of print
    }
  }
}

void PlannedProduction::on_planned(std::function<void(const gcode::PlacedLayer&)> viewer) {
  if (!viewer) return lookahead_->on_planned({});
  lookahead_->on_planned(
      [this, viewer = std::move(viewer)](const PlannedLayer& layer) { viewer(placed(prepared_, layer)); });
}

AskedMaterials PlannedProduction::asked() const {
  AskedMaterials asked{print_settings(prepared_).materials, prepared_.frame.zone_materials};
  for (std::size_t i = 0; i < asked.materials.size(); ++i) {
    gcode::Material& material = asked.materials[i];
    material.mixture = maker_.encoder().intended(i, 0);
    if (material.gradient) material.gradient->to = maker_.encoder().intended(i, 1);
  }
  return asked;
}

std::optional<Planning> PlannedProduction::planning() const {
  if (!lookahead_) return std::nullopt;
  return Planning{lookahead_->effort(), lookahead_->threads()};
}

}  // namespace unicursal::host
