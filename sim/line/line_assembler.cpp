#include "sim/line/line_assembler.hpp"

#include <utility>

namespace unicursal::sim {

std::optional<std::string> LineAssembler::push(char byte) {
  if (byte == '\n' || byte == '\r' || byte == '\0') return finish();
  if (comment_ || cut_) return std::nullopt;
  if (!escaped_ && (byte == ';' || (repetier_ && byte == '('))) {
    comment_ = true;
  } else if (!escaped_ && byte == '\\') {
    escaped_ = true;
  } else if (repetier_ && line_.size() + 1 == repetier_room) {
    reset();
    threw_away_ = true;
    ++too_long_;
  } else if (line_.size() == longest && !repetier_) {
    cut_ = true;
    ++too_long_;
  } else {
    line_ += byte;
    escaped_ = false;
  }
  return std::nullopt;
}

std::optional<std::string> LineAssembler::finish() {
  std::string line = std::exchange(line_, {});
  reset();
  const std::size_t first = line.find_first_not_of(' ');
  if (first == std::string::npos) return std::nullopt;
  line.erase(0, first);
  return line;
}

void LineAssembler::reset() {
  line_.clear();
  comment_ = escaped_ = cut_ = false;
}

}  // namespace unicursal::sim
