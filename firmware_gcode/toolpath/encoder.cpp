#include "firmware_gcode/toolpath/encoder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "firmware_gcode/dialect/number.hpp"
#include "firmware_gcode/mixing/calibration.hpp"
#include "firmware_gcode/toolpath/checks.hpp"
#include "firmware_gcode/toolpath/job_frame.hpp"
#include "firmware_gcode/toolpath/move_writer.hpp"
#include "firmware_gcode/toolpath/pace.hpp"
#include "firmware_gcode/toolpath/prime_line.hpp"
#include "firmware_gcode/toolpath/review.hpp"
#include "firmware_gcode/toolpath/simplify.hpp"
#include "firmware_gcode/toolpath/skirt.hpp"

namespace unicursal::gcode {
namespace {

constexpr double travel_widths = 1.5;       ///< bead widths; a longer move without extruding is a travel
constexpr double width_comment_step = 0.2;  ///< relative change of width that viewers are told about
constexpr double park_lift = 10;            ///< mm above the last layer, where the bed's height allows

using Lines = std::vector<std::string>;

void append(Lines& lines, Lines more) {
  lines.insert(lines.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

/// A vertex of one of the paths that are still to be printed.
struct Entry {
  std::size_t path = 0, vertex = 0;
};

core::Box grown(core::Box box, double by) {
  box.min -= core::Vec2(by, by);
  box.max += core::Vec2(by, by);
  return box;
}

Entry nearest_entry(const std::vector<const core::BeadPath*>& paths, const core::Vec2& from) {
  Entry best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < paths.size(); ++p) {
    for (std::size_t v = 0; v < paths[p]->size(); ++v) {
      const double distance = (paths[p]->start(v) - from).squaredNorm();
      if (distance < least) least = distance, best = {p, v};
    }
  }
  return best;
}

}  // namespace

struct Encoder::State {
  State(const Printer& of, const PrintSettings& with);

  Chunk new_chunk() const;
  void prime(Chunk& chunk, const PlacedLayer& layer, const std::vector<const core::BeadPath*>& paths);
  std::size_t material_at(const core::BeadPath& path, std::size_t bead) const;
  void approach(Chunk& chunk, const core::Vec2& to, double z, double bead_width);
  void draw_back(Chunk& chunk);
  void push_forward(Chunk& chunk);
  void lay_skirt(Chunk& chunk, const PlacedLayer& layer, const std::vector<const core::BeadPath*>& paths);
  void print(Chunk& chunk, const core::BeadPath& path, std::size_t first, const PlacedLayer& layer);
  void tell_width(Chunk& chunk, double width);

  const Printer printer;
  const PrintSettings settings;
  const Dialect& dialect;
  Lines start_lines, end_lines;
  std::vector<WrittenTool> tools;              ///< by material, and the retraction tool
  std::optional<std::size_t> retraction_tool;  ///< of equal shares
  MoveWriter writer;
  Pace pace;
  Review review;
  bool drawn_back = true;
  bool primed = false;
  double told_width = 0;  ///< mm, of the last ;WIDTH: comment
};

Encoder::State::State(const Printer& of, const PrintSettings& with)
    : printer(of),
      settings(with),
      dialect(dialect_named(of.firmware)),
      writer(printer, dialect),
      pace(printer, settings),
      review(printer, dialect) {
  check_printer(printer);
  check_settings(settings, printer, dialect);
  start_lines = script_lines(printer.start_gcode, "gcode.start", printer, settings);
  end_lines = script_lines(printer.end_gcode, "gcode.end", printer, settings);
  for (const Material& material : settings.materials) {
    tools.push_back(
        calibrated(material.mixture.with_floor(printer.floor_share), printer.flow_factors, dialect));
  }
  if (tools.size() < dialect.limits().virtual_tools) {
    retraction_tool = tools.size();
    tools.push_back(calibrated(Mixture({1, 1, 1}), printer.flow_factors, dialect));
  }
  for (std::size_t i = 0; i < tools.size(); ++i) writer.calibrate(i, tools[i].scale);
}

Chunk Encoder::State::new_chunk() const {
  Chunk chunk;
  chunk.material_volumes.resize(settings.materials.size());
  return chunk;
}

std::size_t Encoder::State::material_at(const core::BeadPath& path, std::size_t bead) const {
  return settings.zone_materials[path.beads[bead].zone];
}

void Encoder::State::draw_back(Chunk& chunk) {
  if (std::exchange(drawn_back, true)) return;
  if (retraction_tool) writer.select_tool(chunk, *retraction_tool);
  writer.filament(chunk, -printer.retraction_length, printer.retraction_speed);
}

void Encoder::State::push_forward(Chunk& chunk) {
  if (!std::exchange(drawn_back, false)) return;
  if (retraction_tool) writer.select_tool(chunk, *retraction_tool);
  writer.filament(chunk, printer.retraction_length, printer.retraction_speed);
}

void Encoder::State::approach(Chunk& chunk, const core::Vec2& to, double z, double bead_width) {
  const auto here = writer.position();
  if (!here || (to - *here).norm() > travel_widths * bead_width) draw_back(chunk);
  // Rise first: at the old height the nozzle would plough through what it has just laid.
  writer.rise(chunk, drawn_back ? std::min(z + printer.z_hop, printer.bed[2]) : z);
  writer.travel(chunk, to);
  writer.rise(chunk, z);
  push_forward(chunk);
}

void Encoder::State::prime(Chunk& chunk, const PlacedLayer& layer,
                           const std::vector<const core::BeadPath*>& paths) {
  const auto line =
      prime_line(printer, grown(settings.extent, skirt_reach(settings.skirt, printer)), layer.height);
  if (!line) {
    const std::string reason = "no prime line: the part leaves no edge of the bed free";
    chunk.lines.push_back("; " + reason);
    chunk.warnings.push_back(reason + "; the first beads may come out thin or in a former colour");
    return;
  }
  chunk.lines.push_back(";TYPE:Custom");
  tell_width(chunk, line->width);
  approach(chunk, line->from, layer.top, line->width);
  const Entry next = nearest_entry(paths, line->to);  // what is primed with is what is needed next
  writer.select_tool(chunk, material_at(*paths[next.path], next.vertex));
  const core::Vec2 step = line->to - line->from;
  writer.bead(chunk, line->to, line->volume, pace.speed(step, line->volume, layer.index, layer.height));
  chunk.prime_volume += line->volume;
}

void Encoder::State::lay_skirt(Chunk& chunk, const PlacedLayer& layer,
                               const std::vector<const core::BeadPath*>& paths) {
  const std::vector<core::BeadPath> rings = skirt(layer, settings.skirt, printer);
  if (rings.empty() && settings.skirt.loops > 0) {
    chunk.warnings.push_back("no skirt: the part leaves too little room round it on the bed");
  }
  if (!rings.empty()) chunk.lines.push_back(";TYPE:Skirt");
  for (core::BeadPath ring : rings) {
    const Entry first = nearest_entry({&ring}, writer.position().value_or(core::Vec2(0, 0)));
    const Entry next = nearest_entry(paths, ring.start(first.vertex));
    for (core::Bead& bead : ring.beads) bead.zone = paths[next.path]->beads[next.vertex].zone;
    approach(chunk, ring.start(first.vertex), layer.top, ring.width(0));
    print(chunk, ring, first.vertex, layer);
    chunk.prime_volume += ring.total_area() * layer.height;
  }
}

void Encoder::State::tell_width(Chunk& chunk, double width) {
  if (std::abs(width - told_width) <= width_comment_step * told_width) return;
  told_width = width;
  chunk.lines.push_back(";WIDTH:" + short_number(width, 3));
}

void Encoder::State::print(Chunk& chunk, const core::BeadPath& path, std::size_t first,
                           const PlacedLayer& layer) {
  for (std::size_t k = 0; k < path.size(); ++k) {
    const std::size_t i = (first + k) % path.size();
    const core::Vec2 step = path.end(i) - path.start(i);
    const double volume = path.beads[i].area * layer.height;
    if (step.squaredNorm() > 0) tell_width(chunk, path.width(i));
    writer.select_tool(chunk, material_at(path, i));
    const double speed =
        step.squaredNorm() > 0 ? pace.speed(step, volume, layer.index, layer.height) : printer.max_speed[0];
    writer.bead(chunk, path.end(i), volume, speed);
  }
}

Encoder::Encoder(const Printer& printer, const PrintSettings& settings)
    : state_(std::make_unique<State>(printer, settings)) {}
Encoder::~Encoder() = default;
Encoder::Encoder(Encoder&&) noexcept = default;

Mixture Encoder::intended(std::size_t material) const {
  return state_->tools.at(material).delivered;
}

double Encoder::flow() const {
  return state_->pace.flow();
}

double Encoder::laying_seconds() const {
  return state_->review.laying_seconds();
}

Chunk Encoder::start() {
  State& s = *state_;
  Chunk chunk = s.new_chunk();
  append(chunk.lines, job_comments(s.printer, s.settings, s.dialect));
  append(chunk.lines, warm_up(s.printer, s.settings));
  append(chunk.lines, framed(s.start_lines));
  append(chunk.lines, after_user_start());
  append(chunk.lines, calibration(s.printer));
  for (std::size_t i = 0; i < s.tools.size(); ++i) {
    append(chunk.lines, s.dialect.define_tool(i, s.tools[i].written));
  }
  s.writer.select_tool(chunk, 0);
  s.review(chunk, "the start");
  return chunk;
}

Chunk Encoder::layer(const PlacedLayer& given) {
  State& s = *state_;
  check_layer(given, s.settings, s.printer);
  const PlacedLayer layer = simplified(given);
  Chunk chunk = s.new_chunk();
  append(chunk.lines,
         {";LAYER_CHANGE", ";Z:" + short_number(layer.top, 3), ";HEIGHT:" + short_number(layer.height, 3)});
  append(chunk.lines, layer_events(layer.index, s.settings));
  std::vector<const core::BeadPath*> left;
  for (const core::BeadPath& path : layer.paths) {
    if (path.size() >= 2 && path.total_length() > 0) left.push_back(&path);
  }
  if (!left.empty() && !s.primed) {
    check_on_bed(layer);
    s.primed = true;
    if (s.pace.open()) s.pace.settle({layer});
    s.prime(chunk, layer, left);
    s.lay_skirt(chunk, layer, left);
  }
  if (!left.empty()) chunk.lines.push_back(";TYPE:Solid infill");
  while (!left.empty()) {
    const Entry entry = nearest_entry(left, s.writer.position().value_or(core::Vec2(0, 0)));
    const core::BeadPath& path = *left[entry.path];
    s.approach(chunk, path.start(entry.vertex), layer.top, path.total_area() / path.total_length());
    s.print(chunk, path, entry.vertex, layer);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(entry.path));
  }
  s.review(chunk, fmt::format("layer {}", layer.index));
  return chunk;
}

Chunk Encoder::finish() {
  State& s = *state_;
  Chunk chunk = s.new_chunk();
  if (const auto height = s.writer.height()) {
    // The print may have been cut anywhere in what has been encoded, so that nothing is taken for granted.
    s.writer.forget();
    append(chunk.lines, modes());
    s.writer.select_tool(chunk, s.retraction_tool.value_or(0));
    s.draw_back(chunk);
    s.writer.rise(chunk, std::min(std::max(*height, s.settings.part_height) + park_lift, s.printer.bed[2]));
    s.writer.travel(chunk, {0, s.printer.bed[1]});
  }
  append(chunk.lines, shut_down(s.end_lines));
  s.review(chunk, "the end");
  return chunk;
}

}  // namespace unicursal::gcode
