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
#include "firmware_gcode/toolpath/checks.hpp"
#include "firmware_gcode/toolpath/job_frame.hpp"
#include "firmware_gcode/toolpath/move_writer.hpp"
#include "firmware_gcode/toolpath/prime_line.hpp"
#include "firmware_gcode/toolpath/speeds.hpp"

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
  void print(Chunk& chunk, const core::BeadPath& path, std::size_t first, double layer_height);
  void tell_width(Chunk& chunk, double width);

  const Printer printer;
  const PrintSettings settings;
  const Dialect& dialect;
  Lines start_lines, end_lines;
  std::vector<Mixture> mixtures;               ///< as intended, by material
  std::optional<std::size_t> retraction_tool;  ///< of equal shares
  MoveWriter writer;
  bool drawn_back = true;
  bool primed = false;
  double told_width = 0;  ///< mm, of the last ;WIDTH: comment
};

Encoder::State::State(const Printer& of, const PrintSettings& with)
    : printer(of), settings(with), dialect(dialect_named(of.firmware)), writer(printer, dialect) {
  check_printer(printer);
  check_settings(settings, printer, dialect);
  start_lines = user_commands(printer.start_gcode, "start_gcode");
  end_lines = user_commands(printer.end_gcode, "end_gcode");
  for (const Material& material : settings.materials) {
    mixtures.push_back(dialect.as_written(material.mixture.with_floor(printer.floor_share)));
  }
  if (mixtures.size() < dialect.limits().virtual_tools) retraction_tool = mixtures.size();
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
  writer.rise(chunk, z);
  writer.travel(chunk, to);
  push_forward(chunk);
}

void Encoder::State::prime(Chunk& chunk, const PlacedLayer& layer,
                           const std::vector<const core::BeadPath*>& paths) {
  const auto line = prime_line(printer, settings.extent, layer.height);
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
  writer.bead(chunk, line->to, line->volume, bead_speed(step, line->volume, settings.flow, printer));
  chunk.prime_volume += line->volume;
}

void Encoder::State::tell_width(Chunk& chunk, double width) {
  if (std::abs(width - told_width) <= width_comment_step * told_width) return;
  told_width = width;
  chunk.lines.push_back(";WIDTH:" + short_number(width, 3));
}

void Encoder::State::print(Chunk& chunk, const core::BeadPath& path, std::size_t first, double layer_height) {
  for (std::size_t k = 0; k < path.size(); ++k) {
    const std::size_t i = (first + k) % path.size();
    const core::Vec2 step = path.end(i) - path.start(i);
    const double volume = path.beads[i].area * layer_height;
    if (step.squaredNorm() > 0) tell_width(chunk, path.width(i));
    writer.select_tool(chunk, material_at(path, i));
    const double speed =
        step.squaredNorm() > 0 ? bead_speed(step, volume, settings.flow, printer) : printer.max_speed[0];
    writer.bead(chunk, path.end(i), volume, speed);
  }
}

Encoder::Encoder(const Printer& printer, const PrintSettings& settings)
    : state_(std::make_unique<State>(printer, settings)) {}
Encoder::~Encoder() = default;
Encoder::Encoder(Encoder&&) noexcept = default;

Mixture Encoder::intended(std::size_t material) const {
  return state_->mixtures.at(material);
}

Chunk Encoder::start() {
  State& s = *state_;
  Chunk chunk = s.new_chunk();
  append(chunk.lines, job_comments(s.printer, s.settings));
  append(chunk.lines, warm_up(s.printer));
  append(chunk.lines, s.start_lines);
  append(chunk.lines, after_user_start());
  for (std::size_t i = 0; i < s.mixtures.size(); ++i) {
    append(chunk.lines, s.dialect.define_tool(i, s.mixtures[i]));
  }
  if (s.retraction_tool) {
    append(chunk.lines, s.dialect.define_tool(*s.retraction_tool, Mixture({1, 1, 1})));
  }
  s.writer.select_tool(chunk, 0);
  return chunk;
}

Chunk Encoder::layer(const PlacedLayer& layer) {
  State& s = *state_;
  check_layer(layer, s.settings, s.printer);
  Chunk chunk = s.new_chunk();
  append(chunk.lines,
         {";LAYER_CHANGE", ";Z:" + short_number(layer.top, 3), ";HEIGHT:" + short_number(layer.height, 3)});
  std::vector<const core::BeadPath*> left;
  for (const core::BeadPath& path : layer.paths) {
    if (path.size() >= 2 && path.total_length() > 0) left.push_back(&path);
  }
  if (!left.empty() && !s.primed) {
    check_on_bed(layer);
    s.primed = true;
    s.prime(chunk, layer, left);
  }
  if (!left.empty()) chunk.lines.push_back(";TYPE:Solid infill");
  while (!left.empty()) {
    const Entry entry = nearest_entry(left, s.writer.position().value_or(core::Vec2(0, 0)));
    const core::BeadPath& path = *left[entry.path];
    s.approach(chunk, path.start(entry.vertex), layer.top, path.total_area() / path.total_length());
    s.print(chunk, path, entry.vertex, layer.height);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(entry.path));
  }
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
  return chunk;
}

}  // namespace unicursal::gcode
