#include "firmware_gcode/remix/line_writer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "firmware_gcode/dialect/number.hpp"
#include "firmware_gcode/dialect/share_writing.hpp"

namespace unicursal::gcode {
namespace {

constexpr int position_decimals = 5;  // as many as any slicer writes
constexpr int extrusion_decimals = 5;
constexpr double extrusion_unit = 1e-5;
constexpr int feed_decimals = 1;
constexpr std::array<char, 3> axes{'X', 'Y', 'Z'};

}  // namespace

void LineWriter::define_tool(std::size_t tool, std::string name, const CalibratedMixture& mixture) {
  tools_.insert_or_assign(tool, Tool{std::move(name), mixture});
}

double LineWriter::scale() const {
  return tool_ ? tools_.at(*tool_).mixture.scale : 1.0;
}

void LineWriter::select_tool(Chunk& chunk, std::size_t tool) {
  if (tool_ == tool) return;
  tool_ = tool;
  const Tool& chosen = tools_.at(tool);
  chunk.mixtures.push_back({chunk.lines.size(), chosen.name});
  chunk.lines.push_back(begin_mixture(dialect_, tool, chosen.mixture.written));
}

void LineWriter::forget() {
  written_ = {};
  tool_.reset();
  feed_ = 0;
  owed_ = 0;
}

void LineWriter::pass(Chunk& chunk, const std::string& line) {
  chunk.lines.push_back(line);
  if (line.front() != 'G') return;
  if (!line.starts_with("G4")) written_ = place_ = {}, feed_ = 0;
}

void LineWriter::move(Chunk& chunk, const Place& to, double filament, double feed) {
  const double longest = dialect_.limits().extrusion / 2;  // half, to stay clear of the firmware's rounding
  const int pieces = std::max(1, static_cast<int>(std::ceil(std::abs(filament) * scale() / longest)));
  const Place from = place_;
  for (int piece = 1; piece <= pieces; ++piece) {
    Place next = to;
    for (std::size_t i = 0; i < axes.size() && piece < pieces; ++i) {
      if (to[i]) next[i] = from[i] ? *from[i] + (*to[i] - *from[i]) * piece / pieces : *to[i];
    }
    line(chunk, next, filament / pieces, feed);
  }
}

void LineWriter::line(Chunk& chunk, const Place& to, double filament, double feed) {
  std::string words = "G1";
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (!to[i]) continue;
    place_[i] = to[i];
    const std::int64_t value = scaled(*to[i], position_decimals);
    if (written_[i] && scaled(*written_[i], position_decimals) == value) continue;
    written_[i] = to[i];
    words += ' ', words += axes[i], append_scaled(words, value, position_decimals);
  }
  owed_ += filament * scale();
  if (const std::int64_t e = scaled(owed_, extrusion_decimals); e != 0) {
    words += " E", append_scaled(words, e, extrusion_decimals);
    owed_ -= static_cast<double>(e) * extrusion_unit;
  }
  if (words.size() == 2) return;
  if (feed > 0 && scaled(feed, feed_decimals) != scaled(feed_, feed_decimals)) {
    feed_ = feed;
    words += " F",
        append_scaled(words, std::max<std::int64_t>(scaled(feed, feed_decimals), 1), feed_decimals);
  }
  chunk.lines.push_back(std::move(words));
}

}  // namespace unicursal::gcode
