#include "firmware_gcode/toolpath/move_writer.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "firmware_gcode/dialect/number.hpp"
#include "firmware_gcode/dialect/share_writing.hpp"
#include "firmware_gcode/motion/speeds.hpp"
#include "firmware_gcode/print/bounds.hpp"

namespace unicursal::gcode {
namespace {

constexpr int position_decimals = 3;
constexpr double position_unit = 1e-3;  ///< mm
constexpr int extrusion_decimals = 5;
constexpr double extrusion_unit = 1e-5;                  ///< mm of filament
constexpr double feed_tolerance = 0.01;                  ///< relative; too small to show in a bead's width
constexpr double least_feed = 60 * bounds::speed.least;  ///< mm/min

}  // namespace

MoveWriter::MoveWriter(const Printer& printer, const Dialect& dialect)
    : printer_(printer),
      dialect_(dialect),
      filament_area_(std::numbers::pi / 4 * printer.filament_diameter * printer.filament_diameter) {}

std::optional<core::Vec2> MoveWriter::position() const {
  if (!position_) return std::nullopt;
  return core::Vec2(static_cast<double>(position_->x), static_cast<double>(position_->y)) * position_unit;
}

std::optional<double> MoveWriter::height() const {
  if (!height_) return std::nullopt;
  return static_cast<double>(*height_) * position_unit;
}

MoveWriter::GridPoint MoveWriter::on_grid(const core::Vec2& point) {
  return {scaled(point.x(), position_decimals), scaled(point.y(), position_decimals)};
}

void MoveWriter::append_position(std::string& line, const GridPoint& to) {
  if (!position_ || position_->x != to.x) line += " X", append_scaled(line, to.x, position_decimals);
  if (!position_ || position_->y != to.y) line += " Y", append_scaled(line, to.y, position_decimals);
  position_ = to;
}

void MoveWriter::append_feed(std::string& line, double speed) {
  const double wanted = std::max(speed * 60, least_feed);
  if (std::abs(wanted - feed_) <= feed_tolerance * wanted) return;
  feed_ = std::round(wanted);
  line += " F", append_scaled(line, scaled(feed_, 0), 0);
}

void MoveWriter::forget() {
  position_.reset();
  height_.reset();
  tool_.reset();
  feed_ = 0;
  owed_ = 0;
}

void MoveWriter::define_tool(std::size_t tool, std::string name, const CalibratedMixture& mixture) {
  tools_.insert_or_assign(tool, Tool{std::move(name), mixture});
}

double MoveWriter::scale() const {
  return tool_ ? tools_.at(*tool_).mixture.scale : 1.0;
}

void MoveWriter::select_tool(Chunk& chunk, std::size_t tool) {
  if (tool_ == tool) return;
  tool_ = tool;
  const Tool& chosen = tools_.at(tool);
  chunk.mixtures.push_back({chunk.lines.size(), chosen.name});
  chunk.lines.push_back(begin_mixture(dialect_, tool, chosen.mixture.written));
}

void MoveWriter::rise(Chunk& chunk, double z) {
  const std::int64_t to = scaled(z, position_decimals);
  if (height_ == to) return;
  std::string line = "G1 Z";
  append_scaled(line, to, position_decimals);
  append_feed(line, printer_.max_speed[2]);
  chunk.lines.push_back(std::move(line));
  height_ = to;
}

void MoveWriter::travel(Chunk& chunk, const core::Vec2& to) {
  std::string line = "G0";
  append_position(line, on_grid(to));
  if (line.size() == 2) return;
  const double speed = std::min(printer_.max_speed[0], printer_.max_speed[1]);
  append_feed(line, speed);
  chunk.lines.push_back(std::move(line));
}

void MoveWriter::bead(Chunk& chunk, const core::Vec2& to, double volume, double speed) {
  assert(position_);
  const core::Vec2 from = *position();
  const double longest = dialect_.limits().extrusion / 2;  // half, to stay clear of the firmware's rounding
  const double pieces = std::max(1.0, std::ceil((volume / filament_area_ * scale() + owed_) / longest));
  for (double piece = 1; piece <= pieces; ++piece) {
    const core::Vec2 end = piece < pieces ? core::Vec2(from + (to - from) * (piece / pieces)) : to;
    straight_bead(chunk, end, volume / pieces, speed);
  }
}

void MoveWriter::straight_bead(Chunk& chunk, const core::Vec2& to, double volume, double speed) {
  const core::Vec2 from = *position();
  chunk.volume += volume;
  owed_ += volume / filament_area_ * scale();
  std::string line = "G1";
  append_position(line, on_grid(to));
  if (line.size() == 2) return;  // shorter than the grid; the next bead gets its filament
  if (const std::int64_t e = scaled(owed_, extrusion_decimals); e != 0) {
    line += " E", append_scaled(line, e, extrusion_decimals);
    owed_ -= static_cast<double>(e) * extrusion_unit;
  }
  append_feed(line, std::min(speed, axis_limited_speed(*position() - from, printer_.max_speed)));
  chunk.lines.push_back(std::move(line));
}

void MoveWriter::filament(Chunk& chunk, double length, double speed) {
  const std::int64_t e = scaled(length * scale(), extrusion_decimals);
  if (e == 0) return;
  std::string line = "G1 E";
  append_scaled(line, e, extrusion_decimals);
  append_feed(line, speed);
  chunk.lines.push_back(std::move(line));
}

}  // namespace unicursal::gcode
