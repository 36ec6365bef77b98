#include "firmware_gcode/toolpath/encoder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <deque>
#include <iterator>
#include <optional>
#include <utility>

#include "firmware_gcode/dialect/dialect_named.hpp"
#include "firmware_gcode/dialect/number.hpp"
#include "firmware_gcode/mixing/calibration.hpp"
#include "firmware_gcode/mixing/change_cost.hpp"
#include "firmware_gcode/mixing/forecast.hpp"
#include "firmware_gcode/mixing/overshoot.hpp"
#include "firmware_gcode/mixing/print_mixtures.hpp"
#include "firmware_gcode/mixing/schedule.hpp"
#include "firmware_gcode/mixing/tool_table.hpp"
#include "firmware_gcode/motion/held_flow.hpp"
#include "firmware_gcode/motion/laying_speed.hpp"
#include "firmware_gcode/review/review.hpp"
#include "firmware_gcode/route/detour.hpp"
#include "firmware_gcode/route/route.hpp"
#include "firmware_gcode/route/simplify.hpp"
#include "firmware_gcode/toolpath/checks.hpp"
#include "firmware_gcode/toolpath/job_frame.hpp"
#include "firmware_gcode/toolpath/move_writer.hpp"
#include "firmware_gcode/toolpath/prime_line.hpp"
#include "firmware_gcode/toolpath/skirt.hpp"
#include "firmware_gcode/toolpath/steps.hpp"

namespace unicursal::gcode {
namespace {

constexpr double width_comment_step = 0.2;  ///< relative change of width that gets a new comment for viewers
constexpr double park_lift = 10;            ///< mm above the last layer, if the printer's height allows

constexpr double unseen = 0.02;  ///< weight of plastic whose mixture hardly matters (prime, transitions)
constexpr double gradient_piece = 0.5;  ///< mm of path that count as one mixture
constexpr double least_piece = 1e-3;    ///< mm³; beads are not cut nearer to their ends

using Lines = std::vector<std::string>;

void append(Lines& lines, Lines more) {
  lines.insert(lines.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

core::Box grown(core::Box box, double by) {
  box.min -= core::Vec2(by, by);
  box.max += core::Vec2(by, by);
  return box;
}

/// The path from the start of its traversal, in the direction of the traversal.
core::BeadPath turned(const core::BeadPath& path, const Traversal& leg) {
  core::BeadPath result;
  core::Vec2 from = path.start(leg.start);
  for (std::size_t k = 0; k < path.size(); ++k) {
    const core::Bead& bead = path.beads[bead_of(path, leg, k)];
    result.beads.push_back({from, bead.area, bead.zone});
    from = bead_end(path, leg, k);
  }
  return result;
}

bool prints_anything(const PlacedLayer& layer) {
  return std::any_of(layer.paths.begin(), layer.paths.end(), is_printable);
}

/// By material: false for materials of transition zones.
std::vector<bool> matters(const PrintSettings& settings) {
  std::vector<bool> result;
  for (const Material& material : settings.materials) result.push_back(!material.transition);
  return result;
}

RouteOptions route_options(const PrintSettings& settings, const ChangeCosts& costs) {
  RouteOptions options;
  options.horizon = settings.horizon;
  options.growing = !settings.automatic_flow;  // an automatic flow is chosen over the whole window
  options.seam = settings.seam;
  options.change_cost = [costs, zones = settings.zone_materials](std::size_t from, std::size_t to) {
    return costs.of(zones.at(from), zones.at(to));
  };
  return options;
}

}  // namespace

struct Encoder::State {
  /// Precondition: printer and settings are checked.
  State(const Printer& of, const PrintSettings& with, const Dialect& speaks, PrintMixtures mixtures);

  std::size_t material_at(const core::BeadPath& path, std::size_t bead) const;

  void plan_decided();
  void plan(const RoutedLayer& routed);
  double flow_for(const RoutedLayer& routed);
  void plan_prime(const RoutedLayer& routed);
  void plan_skirt(const RoutedLayer& routed);
  void plan_path(const PlacedLayer& layer, const core::BeadPath& path, const LayerMaterials& layer_materials);
  void warn(const std::string& reason, const std::string& consequence);
  void want(const WantedBead& piece);

  Chunk write_certain();
  void warn_of_crossings(Chunk& chunk);
  void finish_part(Chunk& part, Chunk& chunk);
  bool is_certain() const;
  void write(Chunk& chunk, const BeginLayer& step);
  void write(Chunk& chunk, const EndLayer& step);
  void write(Chunk& chunk, const Remark& step);
  void write(Chunk& chunk, const Warning& step);
  void write(Chunk& chunk, const Approach& step);
  void write(Chunk& chunk, const Purge& step);
  void write(Chunk& chunk, const Lay& step);
  void give_back(Chunk& chunk, std::size_t tool);
  std::string name_of(const Mixture& delivered) const;
  void define_tool(std::size_t tool);
  void switch_mixture(Chunk& chunk);
  void leave_part(Chunk& chunk);
  void draw_back(Chunk& chunk);
  void push_forward(Chunk& chunk);
  void write_width(Chunk& chunk, double width);

  const Printer printer;
  const PrintSettings settings;
  const Dialect& dialect;
  Palette palette;
  const Overshoots overshoots;
  Lines start_lines, end_lines;
  ToolTable tools;
  MoveWriter writer;
  LayingSpeed pace;
  Review review;
  Route route;
  Schedule schedule;
  Forecast forecast;
  std::deque<Step> steps;  ///< planned, not written yet
  std::deque<Switch> switches;
  std::optional<Shade> shade;            ///< in use
  std::size_t shade_tool = 0;            ///< the virtual tool that holds it
  std::optional<core::Vec2> planned_to;  ///< end of the last planned path
  double laid = 0;                       ///< mm³ along beads that are written
  bool ended = false;
  std::size_t layer = 0;              ///< being written
  std::size_t level = 0;              ///< of this layer in its part
  double highest = 0;                 ///< mm, top of all layers that are written
  std::optional<double> above_parts;  ///< height of the way to the next part
  bool layer_ends = false;            ///< its end is being written
  double layer_height = 0;
  std::size_t prime_material = 0;
  std::optional<std::size_t> asked_material;  ///< of the last bead that is written
  bool drawn_back = true;
  bool begun = false;  ///< a layer with beads has been accepted
  bool primed = false;
  bool warned_of_crossings = false;
  bool warned_of_flow = false;
  double written_width = 0;  ///< mm, of the last ;WIDTH: comment
};

Encoder::State::State(const Printer& of, const PrintSettings& with, const Dialect& speaks,
                      PrintMixtures mixtures)
    : printer(of),
      settings(with),
      dialect(speaks),
      palette(std::move(mixtures.palette)),
      overshoots(std::move(mixtures.overshoots)),
      start_lines(script_lines(of.start_gcode, "gcode.start", of, with)),
      end_lines(script_lines(of.end_gcode, "gcode.end", of, with)),
      tools(std::move(mixtures.tools)),
      writer(printer, speaks),
      pace(of, with),
      review(of, speaks),
      route(route_options(with, ChangeCosts(palette, chamber_of(of), matters(with), overshoots))),
      schedule(palette, {chamber_of(of), with.change_before_border, with.look_ahead, &overshoots}),
      forecast(palette, chamber_of(of)) {
  for (std::size_t i = 0; i < tools.size(); ++i) define_tool(i);
}

/// The name of the material, also for the beginning of a gradient; else the shares.
std::string Encoder::State::name_of(const Mixture& delivered) const {
  for (std::size_t i = 0; i < settings.materials.size(); ++i) {
    if (palette.mixture(Shade{i, 0}) == delivered) return settings.materials[i].name;
  }
  return shares_text(delivered);
}

void Encoder::State::define_tool(std::size_t which) {
  const CalibratedMixture& mixture = tools.mixture(which);
  writer.define_tool(which, name_of(mixture.delivered), mixture);
}

std::size_t Encoder::State::material_at(const core::BeadPath& path, std::size_t bead) const {
  return settings.zone_materials[path.beads[bead].zone];
}

void Encoder::State::want(const WantedBead& piece) {
  schedule.add(piece);
  forecast.add(piece);
}

void Encoder::State::plan_decided() {
  while (const auto routed = route.take()) plan(*routed);
  for (const Switch& next : schedule.take()) {
    forecast.add(next);
    switches.push_back(next);
  }
}

void Encoder::State::plan(const RoutedLayer& routed) {
  const PlacedLayer& of = routed.layer;
  if (rests_on_bed(of)) planned_to.reset();  // the way to another part leads above all parts
  steps.push_back(BeginLayer{of.index, of.top, of.height, rests_on_bed(of), flow_for(routed)});
  std::vector<std::size_t> materials;
  for (const Traversal& leg : routed.traversals) {
    const core::BeadPath& path = of.paths[leg.path];
    for (std::size_t i = 0; i < path.size(); ++i) materials.push_back(material_at(path, i));
  }
  std::sort(materials.begin(), materials.end());
  materials.erase(std::unique(materials.begin(), materials.end()), materials.end());
  const auto layer_materials = std::make_shared<const std::vector<std::size_t>>(std::move(materials));
  if (!routed.traversals.empty()) {
    if (!std::exchange(primed, true)) {
      plan_prime(routed);
      plan_skirt(routed);
    }
    steps.push_back(Remark{";TYPE:Solid infill"});
  }
  for (const Traversal& leg : routed.traversals)
    plan_path(of, turned(of.paths[leg.path], leg), layer_materials);
  steps.push_back(EndLayer{});
}

/// An automatic flow is chosen at the first layer with beads, from all layers that are known by then.
double Encoder::State::flow_for(const RoutedLayer& routed) {
  if (!settings.automatic_flow || settings.speed || routed.traversals.empty()) return pace.flow();
  const PlacedLayer fill = simplified(routed.layer);
  if (pace.open()) {
    std::vector<PlacedLayer> window{fill};
    for (const PlacedLayer* next : route.waiting()) window.push_back(simplified(*next));
    pace.settle(window);
  }
  const double flow = pace.flow_of(fill);
  if (flow < (1 - flow_tolerance) * pace.flow() && !std::exchange(warned_of_flow, true)) {
    steps.push_back(
        Warning{fmt::format("layer {}: its hairpins sustain a flow of {:.2f} mm³/s and not {:.2f} mm³/s; it "
                            "is printed at that flow, and "
                            "later layers at what they sustain",
                            routed.layer.index, flow, pace.flow())});
  }
  return flow;
}

/// Purges the inlets, then primes with the first material of the part.
void Encoder::State::plan_prime(const RoutedLayer& routed) {
  const Traversal& first = routed.traversals.front();
  const core::BeadPath& path = routed.layer.paths[first.path];
  prime_material = material_at(path, bead_of(path, first, 0));
  const auto line =
      prime_line(printer, grown(settings.extent, skirt_reach(settings.skirt, printer)), routed.layer.height);
  if (!line) {
    return warn("no prime line: the part leaves no edge of the bed free",
                "the first beads may come out thin or in a former colour");
  }
  steps.push_back(Remark{";TYPE:Custom"});
  steps.push_back(Approach{{}, line->from, routed.layer.top, line->width});
  const double purged = line->purge * static_cast<double>(printer.feeders);
  if (purged > 0) steps.push_back(Purge{line->from, line->at(purged), purged});
  steps.push_back(Lay{line->at(purged), line->to, line->volume - purged, prime_material, true});
  want({line->volume - purged, prime_material, 0, unseen, false, routed.layer.index, nullptr});
}

void Encoder::State::warn(const std::string& reason, const std::string& consequence) {
  steps.push_back(Remark{"; " + reason});
  steps.push_back(Warning{reason + "; " + consequence});
}

void Encoder::State::plan_skirt(const RoutedLayer& routed) {
  const PlacedLayer& of = routed.layer;
  const std::vector<core::BeadPath> rings = skirt(of, settings.skirt, printer);
  if (rings.empty() && settings.skirt.loops > 0) {
    warn("no skirt: the part leaves too little room round it on the bed", "nothing is laid instead");
  }
  if (!rings.empty()) steps.push_back(Remark{";TYPE:Skirt"});
  for (const core::BeadPath& ring : rings) {
    steps.push_back(Approach{{}, ring.start(0), of.top, ring.width(0)});
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const double volume = ring.beads[i].area * of.height;
      steps.push_back(Lay{ring.start(i), ring.end(i), volume, prime_material, true});
      want({volume, prime_material, 0, unseen, false, of.index, nullptr});
    }
  }
}

void Encoder::State::plan_path(const PlacedLayer& of, const core::BeadPath& whole,
                               const LayerMaterials& layer_materials) {
  const double width = whole.total_area() / whole.total_length();
  std::vector<core::Vec2> via;
  if (planned_to && (whole.start(0) - *planned_to).norm() > travel_widths * width) {
    via = detour(*planned_to, whole.start(0), of.outlines, {{0, 0}, {printer.bed[0], printer.bed[1]}});
  }
  steps.push_back(Approach{std::move(via), whole.start(0), of.top, width});
  planned_to = whole.start(0);
  const core::BeadPath path = simplified(whole);
  for (std::size_t bead = 0; bead < path.size(); ++bead) {
    const core::Vec2 from = path.start(bead), to = path.end(bead);
    const double volume = path.beads[bead].area * of.height;
    const std::size_t index = material_at(path, bead);
    const Material& material = settings.materials[index];
    const double pieces =
        material.gradient ? std::max(1.0, std::ceil((to - from).norm() / gradient_piece)) : 1;
    for (double i = 0; i < pieces; ++i) {
      const core::Vec2 middle = from + (to - from) * ((i + 0.5) / pieces);
      const double part = material.gradient ? material.gradient->part_at(middle, of.top - of.height / 2) : 0;
      want({volume / pieces, index, part, material.transition ? unseen : 1, material.transition, of.index,
            layer_materials});
    }
    steps.push_back(Lay{from, to, volume, index});
  }
}

/// A step is written when the mixture of the next bead is certain; a travel waits for the bead behind it.
bool Encoder::State::is_certain() const {
  if (ended || std::holds_alternative<EndLayer>(steps.front())) return true;
  for (const Step& step : steps) {
    if (const Lay* lay = std::get_if<Lay>(&step))
      return laid + lay->volume <= schedule.certain() + least_piece;
  }
  return false;
}

Chunk Encoder::State::write_certain() {
  Chunk chunk, part;
  while (!steps.empty() && is_certain()) {
    const Step step = std::move(steps.front());
    steps.pop_front();
    if (const BeginLayer* begin = std::get_if<BeginLayer>(&step)) {
      finish_part(part, chunk);
      layer = begin->index;
    }
    std::visit([&](const auto& kind) { write(part, kind); }, step);
  }
  finish_part(part, chunk);
  chunk.prime_material = prime_material;
  return chunk;
}

/// Warns once; the report lists all layers.
void Encoder::State::warn_of_crossings(Chunk& chunk) {
  for (const LayerMixing& mixing : chunk.mixing) {
    if (mixing.short_crossings == 0 || std::exchange(warned_of_crossings, true)) continue;
    chunk.warnings.push_back(
        fmt::format("layer {}: {} of {} crossings of transition zones are shorter than the mixing volume of "
                    "{:g} mm³, the shortest has "
                    "{:.2f} mm³; colours will change outside the zone there unless it is made wider",
                    mixing.layer, mixing.short_crossings, mixing.crossings, printer.mixing_volume,
                    mixing.shortest_crossing));
  }
}

/// Reviews the lines of one layer and adds them to the chunk.
void Encoder::State::finish_part(Chunk& part, Chunk& chunk) {
  if (part.lines.empty() && !layer_ends) return;
  review(part, fmt::format("layer {}", layer));
  chunk.layers.push_back({layer, part.volume, part.seconds, std::exchange(layer_ends, false)});
  for (MixtureStart& start : part.mixtures)
    chunk.mixtures.push_back({chunk.lines.size() + start.line, std::move(start.name)});
  for (const auto& [line, what] : part.asked) chunk.asked.push_back({chunk.lines.size() + line, what});
  append(chunk.lines, std::move(part.lines));
  append(chunk.warnings, std::move(part.warnings));
  for (const auto& [what, volume] : part.mixture_volumes) add(chunk.mixture_volumes, what, volume);
  for (const auto& [what, volume] : part.aside_mixtures) add(chunk.aside_mixtures, what, volume);
  chunk.volume += part.volume;
  chunk.prime_volume += part.prime_volume;
  chunk.seconds += part.seconds;
  part = {};
}

void Encoder::State::write(Chunk& chunk, const BeginLayer& step) {
  const bool next_part = step.on_bed && highest > 0;
  layer_height = step.height;
  level = step.on_bed ? 0 : level + 1;
  pace.run_at(step.flow);
  append(chunk.lines,
         {";LAYER_CHANGE", ";Z:" + short_number(step.top, 3), ";HEIGHT:" + short_number(step.height, 3)});
  if (next_part) leave_part(chunk);
  highest = std::max(highest, step.top);
  append(chunk.lines, layer_events(level, settings));
}

/// Rises above everything that is printed. The next approach stays at that height until it is at its place.
void Encoder::State::leave_part(Chunk& chunk) {
  constexpr double least_way = 1;  // mm above the parts, which curl up less
  draw_back(chunk);
  above_parts = std::min(highest + std::max(printer.z_hop, least_way), printer.bed[2]);
  if (writer.position()) writer.rise(chunk, *above_parts);
  append(chunk.lines, next_part_events(printer, settings));
}

void Encoder::State::write(Chunk&, const EndLayer&) {
  layer_ends = true;
}

void Encoder::State::write(Chunk& chunk, const Remark& step) {
  chunk.lines.push_back(step.line);
}

void Encoder::State::write(Chunk& chunk, const Warning& step) {
  chunk.warnings.push_back(step.text);
}

void Encoder::State::draw_back(Chunk& chunk) {
  if (std::exchange(drawn_back, true)) return;
  if (const auto tool = tools.retraction_tool()) writer.select_tool(chunk, *tool);
  writer.filament(chunk, -printer.retraction_length, printer.retraction_speed);
}

void Encoder::State::push_forward(Chunk& chunk) {
  if (!std::exchange(drawn_back, false)) return;
  if (const auto tool = tools.retraction_tool()) writer.select_tool(chunk, *tool);
  writer.filament(chunk, printer.retraction_length, printer.retraction_speed);
}

void Encoder::State::write(Chunk& chunk, const Approach& step) {
  const auto here = writer.position();
  if (!here || (step.to - *here).norm() > travel_widths * step.bead_width) draw_back(chunk);
  // Rise first: at the old height, the nozzle would plough through the layer.
  const double hop = drawn_back ? std::min(step.z + printer.z_hop, printer.bed[2]) : step.z;
  writer.rise(chunk, std::exchange(above_parts, std::nullopt).value_or(hop));
  for (const core::Vec2& place : step.via) writer.travel(chunk, place);
  writer.travel(chunk, step.to);
  writer.rise(chunk, step.z);
  push_forward(chunk);
}

/// Carries out the switches that are due (the last one counts), and selects the tool again after a
/// retraction.
void Encoder::State::switch_mixture(Chunk& chunk) {
  std::optional<Shade> next;
  while (!switches.empty() && switches.front().at <= laid + least_piece) {
    next = switches.front().shade;
    switches.pop_front();
  }
  if (next) {
    shade = next;
    shade_tool = tools.use(palette.calibrated(*next), chunk.lines);
    define_tool(shade_tool);
  }
  assert(shade);  // the first switch is at 0
  writer.select_tool(chunk, shade_tool);
}

/// The tool holds again what the table of tools says. It is selected, too, since a Repetier feeds what M163
/// said last.
void Encoder::State::give_back(Chunk& chunk, std::size_t tool) {
  append(chunk.lines, dialect.define_tool(tool, tools.mixture(tool).written));
  define_tool(tool);
  writer.select_tool(chunk, tool);
}

/// The printer may have no more tools than the print's mixtures need, so that the first two are borrowed in
/// turn. The one in use is never redefined.
void Encoder::State::write(Chunk& chunk, const Purge& step) {
  const core::Vec2 way = (step.to - step.from) / static_cast<double>(printer.feeders);
  const double volume = step.volume / static_cast<double>(printer.feeders);
  write_width(chunk, volume / layer_height / way.norm());
  std::size_t tool = writer.tool() == 0 ? 1 : 0;
  for (std::size_t f = 0; f < printer.feeders; ++f, tool = 1 - tool) {
    const CalibratedMixture mixture = calibrated(
        purge_mixture(f, printer.feeders).with_floor(printer.floor_share), printer.flow_factors, dialect);
    append(chunk.lines, dialect.define_tool(tool, mixture.written));
    writer.define_tool(tool, fmt::format("feeder {}", f + 1), mixture);
    writer.select_tool(chunk, tool);
    writer.bead(chunk, step.from + way * static_cast<double>(f + 1), volume,
                pace.speed(way, volume, level, layer_height));
    add(chunk.mixture_volumes, mixture.delivered, volume);
    add(chunk.aside_mixtures, mixture.delivered, volume);
    chunk.prime_volume += volume;
  }
  for (const std::size_t borrowed : {tool, 1 - tool}) give_back(chunk, borrowed);
}

/// Cuts the bead where a switch falls inside it.
void Encoder::State::write(Chunk& chunk, const Lay& bead) {
  const core::Vec2 way = bead.to - bead.from;
  const double width = way.norm() > 0 ? bead.volume / layer_height / way.norm() : 0;
  const double speed =
      way.norm() > 0 ? pace.speed(way, bead.volume, level, layer_height) : printer.max_speed[0];
  if (way.norm() > 0) write_width(chunk, width);
  if (std::exchange(asked_material, bead.material) != bead.material)
    chunk.asked.push_back({chunk.lines.size(), bead.material});
  for (double done = 0;;) {
    switch_mixture(chunk);
    const double left = bead.volume - done;
    const bool cut = !switches.empty() && switches.front().at < laid + left - least_piece;
    const double volume = cut ? switches.front().at - laid : left;
    done += volume;
    const core::Vec2 end = cut ? core::Vec2(bead.from + way * (done / bead.volume)) : bead.to;
    writer.bead(chunk, end, volume, speed);
    add(chunk.mixture_volumes, palette.mixture(*shade), volume);
    if (bead.prime) {
      chunk.prime_volume += volume;
      add(chunk.aside_mixtures, palette.mixture(*shade), volume);
    }
    laid += volume;
    if (!cut) return;
  }
}

void Encoder::State::write_width(Chunk& chunk, double width) {
  if (std::abs(width - written_width) <= width_comment_step * written_width) return;
  written_width = width;
  chunk.lines.push_back(";WIDTH:" + short_number(width, 3));
}

Encoder::Encoder(const Printer& printer, const PrintSettings& settings) {
  check_printer(printer);
  check_settings(settings, printer);
  const Dialect& dialect = dialect_named(printer.firmware);
  state_ = std::make_unique<State>(
      printer, settings, dialect,
      mixtures_of(printer, settings.materials, settings.look_ahead, settings.change_before_border, dialect));
}
Encoder::~Encoder() = default;
Encoder::Encoder(Encoder&&) noexcept = default;

Mixture Encoder::intended(std::size_t material, double part) const {
  return state_->palette.mixture(material, part);
}

double Encoder::flow() const {
  return state_->pace.flow();
}

double Encoder::laying_seconds() const {
  return state_->review.laying_seconds();
}

Chunk Encoder::start() {
  State& s = *state_;
  Chunk chunk;
  append(chunk.lines, job_comments(s.printer, s.settings, s.dialect));
  append(chunk.lines, warm_up(s.printer, s.settings));
  append(chunk.lines, framed(s.start_lines));
  append(chunk.lines, after_user_start(s.printer));
  append(chunk.lines, calibration(s.printer));
  append(chunk.lines, s.tools.define());
  s.writer.select_tool(chunk, 0);
  s.review(chunk, "the start");
  return chunk;
}

Chunk Encoder::layer(const PlacedLayer& layer) {
  State& s = *state_;
  check_layer(layer, s.settings, s.printer);
  if (!s.begun && prints_anything(layer)) {
    check_on_bed(layer);
    s.begun = true;
  }
  s.route.add(layer);
  s.plan_decided();
  Chunk chunk = s.write_certain();
  chunk.mixing = s.forecast.up_to(s.schedule.certain());
  s.warn_of_crossings(chunk);
  return chunk;
}

Chunk Encoder::rest() {
  State& s = *state_;
  s.route.end();
  s.schedule.end();
  s.plan_decided();
  s.ended = true;
  Chunk chunk = s.write_certain();
  chunk.mixing = s.forecast.rest();
  s.warn_of_crossings(chunk);
  return chunk;
}

Chunk Encoder::finish() {
  State& s = *state_;
  Chunk chunk;
  if (const auto height = s.writer.height()) {
    // The print may have stopped anywhere, so that no state is assumed.
    s.writer.forget();
    append(chunk.lines, modes());
    s.writer.select_tool(chunk, s.tools.retraction_tool().value_or(0));
    s.draw_back(chunk);
    s.writer.rise(chunk, std::min(std::max(*height, s.settings.part_height) + park_lift, s.printer.bed[2]));
    s.writer.travel(chunk, {0, s.printer.bed[1]});
  }
  append(chunk.lines, shut_down(s.end_lines));
  s.review(chunk, "the end");
  return chunk;
}

}  // namespace unicursal::gcode
