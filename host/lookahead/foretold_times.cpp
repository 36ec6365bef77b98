#include "host/lookahead/foretold_times.hpp"

#include <algorithm>
#include <exception>

#include "core/geometry/polygon.hpp"
#include "core/stopping.hpp"
#include "host/lookahead/low_priority.hpp"

namespace unicursal::host {

double foretold_seconds(const core::Layer& layer, double flow) {
  if (flow <= 0) return 0;
  double area = 0;
  for (const core::Island& island : layer.islands) area += core::area(island.outline);
  return area * layer.height / flow;
}

ForetoldTimes::ForetoldTimes(const core::Part& part, std::size_t first, std::size_t count, double flow)
    : behind_(count + 1, 0) {
  thread_ = std::jthread([this, &part, first, flow](const std::stop_token& stop) {
    lower_priority();
    const core::StopScope scope(stop);
    try {
      for (std::size_t i = behind_.size() - 1; i-- > 0 && !stop.stop_requested();)
        behind_[i] = behind_[i + 1] + foretold_seconds(part.layer(first + i), flow);
      known_ = !stop.stop_requested();
    } catch (const std::exception&) {
    }
  });
}

std::optional<double> ForetoldTimes::between(std::size_t begin, std::size_t end) const {
  if (!known_) return std::nullopt;
  const std::size_t last = behind_.size() - 1;
  return behind_[std::min(begin, last)] - behind_[std::clamp(end, std::min(begin, last), last)];
}

}  // namespace unicursal::host
