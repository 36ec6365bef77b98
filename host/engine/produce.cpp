#include "host/engine/produce.hpp"

#include <utility>

#include "host/engine/planned_production.hpp"
#include "host/engine/sliced_production.hpp"

namespace unicursal::host {

std::unique_ptr<Production> produce(Job job, const std::optional<LayerRange>& layers,
                                    const std::function<void(const std::string&)>& note,
                                    std::size_t threads) {
  if (job.sliced) return std::make_unique<SlicedProduction>(prepare_sliced(std::move(job), layers, note));
  PreparedJob prepared = prepare(std::move(job), layers, note);
  prepared.threads = threads;
  return std::make_unique<PlannedProduction>(std::move(prepared));
}

}  // namespace unicursal::host
