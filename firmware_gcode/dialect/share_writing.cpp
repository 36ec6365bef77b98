#include "firmware_gcode/dialect/share_writing.hpp"

namespace unicursal::gcode {

const ShareWriting* share_writing(const Dialect& dialect) {
  return dynamic_cast<const ShareWriting*>(&dialect);
}

std::vector<std::string> choose_extruder(const Dialect& dialect) {
  const ShareWriting* writing = share_writing(dialect);
  return writing ? writing->choose_extruder() : std::vector<std::string>{};
}

std::string begin_mixture(const Dialect& dialect, std::size_t tool, const Mixture& mixture) {
  const ShareWriting* writing = share_writing(dialect);
  return writing ? writing->write_shares(mixture) : dialect.select_tool(tool);
}

}  // namespace unicursal::gcode
