#include "host/engine/production.hpp"

#include "host/spool/spool_error.hpp"

namespace unicursal::host {

void check_same(const gcode::Chunk& made, const SpooledChunk& kept, const Spool& spool) {
  std::vector<std::string> lines = made.lines;
  gcode::keep_commands(lines);
  if (lines == kept.lines) return;
  throw SpoolError(spool.folder().string(), "",
                   "holds lines that this version of the program would not write",
                   "resume with the version that the print was begun with");
}

}  // namespace unicursal::host
