#include "host/engine/source.hpp"

namespace unicursal::host {
namespace {

SpooledChunk record_of(const PlannedLayer& planned, const PreparedJob& prepared) {
  SpooledChunk record;
  record.kind = SpooledChunk::Kind::layer;
  record.layer = placed(prepared, planned);
  for (const core::IslandPlan& plan : planned.plans) record.efforts.push_back(plan.effort);
  return record;
}

}  // namespace

std::vector<NamedMixture> PlannedSource::mixtures() const {
  std::vector<NamedMixture> mixtures;
  for (const MaterialVolume& material : run_.totals().materials)
    mixtures.push_back({material.name, material.intended});
  return mixtures;
}

std::optional<Piece> PlannedSource::next() {
  std::optional<PlannedLayer> layer = lookahead_.wait();
  if (!layer) return std::nullopt;
  Piece piece;
  piece.record = record_of(*layer, run_.prepared());
  piece.ready_at = layer->ready_at;
  piece.chunk = run_.layer(std::move(*layer));
  return piece;
}

}  // namespace unicursal::host
