#include "host/job/frames.hpp"

#include <algorithm>
#include <string>

#include "core/text/wording.hpp"

namespace unicursal::host {

const ShippedFrame* frame_named(std::string_view name) {
  const auto found = std::find_if(frames().begin(), frames().end(),
                                  [&](const ShippedFrame& frame) { return frame.name == name; });
  return found == frames().end() ? nullptr : &*found;
}

const ShippedFrame* frame_of_machine(std::string_view machine) {
  const std::string said = core::lower(machine);
  const auto names_it = [&](const ShippedFrame& frame) {
    std::string_view rest = frame.name;
    for (;;) {
      const std::size_t dash = rest.find('-');
      if (said.find(rest.substr(0, dash)) == std::string::npos) return false;
      if (dash == std::string_view::npos) return true;
      rest.remove_prefix(dash + 1);
    }
  };
  const auto found = std::find_if(frames().begin(), frames().end(), names_it);
  return found == frames().end() ? nullptr : &*found;
}

}  // namespace unicursal::host
