// The printers whose profiles come with the program: the files in host/frames, which the build puts into it.
#pragma once

#include <string_view>
#include <vector>

namespace unicursal::host {

struct ShippedFrame {
  std::string_view name;  ///< of the file, without its ending: "geeetech-a10t"
  std::string_view text;  ///< a profile, in the form that ProfileDraft can change
};

/// In the order of their names.
const std::vector<ShippedFrame>& frames();

/// The frame of that name; nullptr if it does not exist.
const ShippedFrame* frame_named(std::string_view name);

/// The frame whose name has all its words in what a printer calls itself, such as "Geeetech A10M"; nullptr if
/// no frame has.
const ShippedFrame* frame_of_machine(std::string_view machine);

}  // namespace unicursal::host
