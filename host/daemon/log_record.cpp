#include "host/daemon/log_record.hpp"

#include <utility>

#include "core/text/printable.hpp"
#include "host/daemon/temperature_record.hpp"

namespace unicursal::host {
namespace {

const char* word_for(LogRecord::From from) {
  switch (from) {
    case LogRecord::From::printer:
      return "printer";
    case LogRecord::From::host:
      return "host";
    case LogRecord::From::notice:
      break;
  }
  return "notice";
}

}  // namespace

void LogRecord::note(From from, const std::string& text) {
  // What the printer says is foreign; this program's own sentences have signs such as °.
  std::string kept = from == From::printer ? core::printable(text, longest_line) : text;
  if (kept.size() > longest_line) kept.resize(longest_line);
  lines_.push_back({next_++, unix_seconds(), from, std::move(kept)});
  if (lines_.size() > most) lines_.pop_front();
}

nlohmann::json LogRecord::since(std::uint64_t id) const {
  nlohmann::json lines = nlohmann::json::array();
  for (const Line& line : lines_) {
    if (line.id < id) continue;
    lines.push_back(
        {{"id", line.id}, {"time", line.time}, {"from", word_for(line.from)}, {"text", line.text}});
  }
  return {{"next", next_}, {"lines", lines}};
}

}  // namespace unicursal::host
