// What a dialect needs besides if its firmware stores no mixtures: virtual tools then exist in this program
// only, and the shares themselves are written at each change. The functions serve all dialects alike.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "firmware_gcode/dialect/dialect.hpp"

namespace unicursal::gcode {

class ShareWriting : public Dialect {
 public:
  /// The lines that choose the extruder that mixes, before anything is heated or extruded.
  virtual std::vector<std::string> choose_extruder() const = 0;
  /// From here on moves feed this mixture.
  virtual std::string write_shares(const Mixture& mixture) const = 0;

  std::vector<std::string> define_tool(std::size_t, const Mixture&) const override { return {}; }
};

/// nullptr for a firmware that stores mixtures in virtual tools.
const ShareWriting* share_writing(const Dialect& dialect);

/// The lines that choose the extruder that mixes; most firmwares need none.
std::vector<std::string> choose_extruder(const Dialect& dialect);

/// The line from which on moves feed the mixture that define_tool() has stored in `tool`, which is `mixture`.
std::string begin_mixture(const Dialect& dialect, std::size_t tool, const Mixture& mixture);

}  // namespace unicursal::gcode
