// Turns a job into the production of its print.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "host/engine/production.hpp"

namespace unicursal::host {

/// As prepare() (host/engine/prepared_job.hpp). `threads`: for planning; 0: one for each core.
std::unique_ptr<Production> produce(Job job, const std::optional<LayerRange>& layers = {},
                                    const std::function<void(const std::string&)>& note = {},
                                    std::size_t threads = 0);

}  // namespace unicursal::host
