// Finds out from the place of the nozzle whether a printer has executed a line that it has not acknowledged.
// RepRapFirmware needs this: it drops a damaged line without a word and does not compare line numbers
// (sim/README.md, "RepRapFirmware"), so that only one line is in flight and this one is either done or lost.
// mm, as M114 reports them behind everything that was read.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace unicursal::host {

class Whereabouts {
 public:
  /// The printer has executed this line (no number, no checksum).
  void done(std::string_view command);

  enum class Verdict {
    done,
    repeatable,  ///< It is not done, or does the same when it is done twice.
    unknown      ///< Filament may have moved alone, or the line is not one that this program writes.
  };
  /// What became of the line after the last one that is done, if the nozzle is at `place` now.
  Verdict judge(std::string_view command, const std::array<double, 3>& place) const;

 private:
  bool relative_ = false;                       ///< G91
  std::array<std::optional<double>, 3> place_;  ///< after the last line that is done, as far as it is known
};

}  // namespace unicursal::host
