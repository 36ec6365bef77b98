#include "firmware_gcode/remix/remix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <deque>
#include <iterator>
#include <numbers>
#include <utility>
#include <variant>

#include "core/error.hpp"
#include "firmware_gcode/dialect/common_lines.hpp"
#include "firmware_gcode/dialect/dialect_named.hpp"
#include "firmware_gcode/dialect/number.hpp"
#include "firmware_gcode/dialect/share_writing.hpp"
#include "firmware_gcode/mixing/overshoot.hpp"
#include "firmware_gcode/mixing/schedule.hpp"
#include "firmware_gcode/mixing/tool_table.hpp"
#include "firmware_gcode/motion/time_estimate.hpp"
#include "firmware_gcode/remix/line_writer.hpp"
#include "firmware_gcode/remix/outflow.hpp"
#include "firmware_gcode/sliced/reader.hpp"
#include "firmware_gcode/sliced/retraction.hpp"
#include "firmware_gcode/toolpath/checks.hpp"
#include "firmware_gcode/toolpath/job_frame.hpp"

namespace unicursal::gcode {
namespace {

constexpr double unseen = 0.02;       ///< weight of plastic beside the part if nothing is hidden
constexpr double early = 0.999;       ///< fraction of a change that a switch may precede its border by
constexpr double horizon = 3;         ///< mixing volumes after which a switch is final
constexpr double least_piece = 1e-3;  ///< mm³; beads are not cut nearer to their ends
constexpr double same_draw = 1e-4;    ///< mm of filament
constexpr double above = 0.6;         ///< mm by which a way round a tower that is left out rises, at least
constexpr double park_lift = 10;      ///< mm above the last layer
constexpr std::size_t chunk_lines = 2000;
constexpr std::uint64_t lines_between_stops = 1 << 14;

void append(std::vector<std::string>& lines, std::vector<std::string> more) {
  lines.insert(lines.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

// ---- what was read and is not written yet

struct Text {
  std::string line;
};
struct BeginLayer {
  std::size_t index;
  std::optional<double> top;
  double height = 0;
};
/// Motion and filament together; either may be absent.
struct Go {
  Place from, to;
  double feed;
  double fed = 0;    ///< mm³ that come out of the nozzle
  double other = 0;  ///< mm of filament that are drawn back (negative) or pushed forward again
  double width = 0, height = 0;
  std::size_t material = 0;
  Feature feature = Feature::unknown;
};
using Entry = std::variant<Text, BeginLayer, Go>;

/// The mixtures of a print, and the tools that hold them at its start.
struct Mixtures {
  Palette palette;
  Overshoots overshoots;
  ToolTable tools;
};

ChamberModel chamber_of(const Printer& printer) {
  return {printer.dead_volume, printer.mixing_volume, printer.tanks};
}

Mixtures mixtures_of(const Printer& printer, const RemixSettings& settings, const Dialect& dialect) {
  const Palette::Calibrate calibrate = [floor = printer.floor_share, factors = printer.flow_factors,
                                        &dialect](const Mixture& mixture) {
    return calibrated(mixture.with_floor(floor), factors, dialect);
  };
  PaletteWithOvershoots all{Palette(settings.materials, calibrate), {}};
  if (settings.look_ahead && printer.overshoot) {
    const std::size_t most = dialect.limits().virtual_tools - 1;  // one tool draws filament back
    all = with_overshoots(std::move(all.palette), {chamber_of(printer), 0.5, printer.floor_share, most});
  }
  ToolTable tools(dialect, all.palette, calibrate(Mixture({1, 1, 1})));
  return {std::move(all.palette), std::move(all.overshoots), std::move(tools)};
}

ScheduleOptions schedule_options(const Printer& printer, const RemixSettings& settings,
                                 const Overshoots& overshoots) {
  ScheduleOptions options{chamber_of(printer), 0.5, settings.look_ahead, &overshoots};
  if (settings.hide) options.early = early, options.horizon = horizon;
  return options;
}

/// Every place of the part can be mistaken for any material of the file.
LayerMaterials all_materials(const RemixSettings& settings) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < settings.materials.size(); ++i) all.push_back(i);
  return std::make_shared<const std::vector<std::size_t>>(std::move(all));
}

}  // namespace

struct Remix::State {
  State(std::istream& file, const std::string& name, const Printer& of, const SlicedSurvey& surveyed,
        const RemixSettings& with, const Dialect& speaks, Mixtures mixtures);

  void read_more();
  void take(const SlicedMove& step);
  void take(const SlicedToolChange& step);
  void take(const SlicedLayer& step);
  void take(const SlicedPass& step);
  void take(const SlicedRemark& step);
  bool leaves_out(const SlicedMove& step);
  void release();
  void come_back(const SlicedMove& step);
  void draw(double length, double feed);
  void note_layer(std::optional<double> top, double height);
  std::size_t material_of(const SlicedMove& step) const;
  void end_reading();

  bool is_certain(const Entry& entry) const;
  bool write_some(std::size_t most_lines);
  void write(const Text& entry);
  void write(const BeginLayer& entry);
  void write(const Go& entry);
  void write_feed(const Go& entry);
  void switch_mixture();
  void select_equal_shares();
  void define_tool(std::size_t tool);
  void move(const Place& to, double filament, double feed);
  void account(const Go& entry, const Place& from, const Place& to, double volume);
  void end_layer(bool last);
  Chunk hand_over();
  void check_materials() const;

  const std::string name;
  const Printer printer;
  const SlicedSurvey survey;
  const RemixSettings settings;
  const Dialect& dialect;
  const double filament_area;  ///< mm²
  Palette palette;
  const Overshoots overshoots;
  ToolTable tools;
  LineWriter writer;
  Schedule schedule;
  Outflow outflow;
  TimeEstimate time;
  SlicedReader reader;
  const LayerMaterials materials;

  // Reading.
  std::deque<Entry> entries;  ///< read, not written yet
  std::vector<Entry>
      held;  ///< travels that may lead to a tower that is left out, and what stands between them
  std::vector<SlicedStep> end;  ///< the file's own end
  Retraction retraction;
  double drawn = 0;     ///< mm of filament that are really drawn back, when all entries are carried out
  Place planned{};      ///< the nozzle's place then
  bool away = false;    ///< the file's nozzle is somewhere else, in a part of the file that is left out
  bool rammed = false;  ///< filament was unloaded or loaded there
  int tool = 0;
  std::optional<std::size_t> last_material;
  std::size_t reading_layer = 0;
  double last_top = 0;
  bool layer_noted = true;  ///< the last layer's height is known
  bool read_all = false;
  bool in_end = false;
  std::uint64_t looked = 0;
  double left_out = 0;

  // Writing.
  std::deque<Switch> switches;
  std::optional<Shade> shade;  ///< in use
  std::size_t shade_tool = 0;
  double laid = 0;  ///< mm³ that are written
  Chunk chunk;
  LayerShare share;
  LayerMixing mixing;
  double assigned = 0;  ///< s of the chunks so far
  double highest = 0;
  bool begun = false;  ///< a layer has begun
  bool listens = false;
  WantedLayer wanted;
  std::vector<WantedLayer> finished;
  SeenMixing seen;
};

Remix::State::State(std::istream& file, const std::string& of_name, const Printer& of,
                    const SlicedSurvey& surveyed, const RemixSettings& with, const Dialect& speaks,
                    Mixtures mixtures)
    : name(of_name),
      printer(of),
      survey(surveyed),
      settings(with),
      dialect(speaks),
      filament_area(std::numbers::pi / 4 * of.filament_diameter * of.filament_diameter),
      palette(std::move(mixtures.palette)),
      overshoots(std::move(mixtures.overshoots)),
      tools(std::move(mixtures.tools)),
      writer(printer, speaks),
      schedule(palette, schedule_options(of, with, overshoots)),
      outflow(chamber_of(of)),
      time(of),
      reader(file, of_name, of, with.limits),
      materials(all_materials(with)) {
  for (std::size_t i = 0; i < tools.size(); ++i) define_tool(i);
}

void Remix::State::define_tool(std::size_t which) {
  const CalibratedMixture& mixture = tools.mixture(which);
  std::string called = shares_text(mixture.delivered);
  for (std::size_t i = 0; i < settings.materials.size(); ++i) {
    if (palette.mixture(Shade{i, 0}) == mixture.delivered) called = settings.materials[i].name;
  }
  writer.define_tool(which, std::move(called), mixture);
}

// ---- reading

void Remix::State::read_more() {
  const auto step = reader.next();
  if (!step) return end_reading();
  if (settings.stop && reader.lines() / lines_between_stops != looked) {
    looked = reader.lines() / lines_between_stops;
    settings.stop();
  }
  if (in_end) {
    end.push_back(*step);
    return;
  }
  std::visit([this](const auto& kind) { take(kind); }, *step);
  for (const Switch& next : schedule.take()) switches.push_back(next);
  if (reader.lines() >= survey.last_bead && reader.nothing_pending()) {
    in_end = true;
    schedule.end();
    for (const Switch& next : schedule.take()) switches.push_back(next);
  }
}

void Remix::State::end_reading() {
  read_all = true;
  if (!in_end) {
    throw core::DataError(name, "", "has become shorter since it was looked at",
                          "start again when nothing writes to it any more");
  }
}

void Remix::State::take(const SlicedRemark& step) {
  held.emplace_back(Text{step.text});
}

void Remix::State::take(const SlicedPass& step) {
  const bool heats =
      step.text.starts_with("M10") || step.text.starts_with("M14") || step.text.starts_with("M19");
  if (step.tower && settings.leave_out_tower && !heats) return;
  held.emplace_back(Text{step.text});
}

void Remix::State::take(const SlicedLayer& step) {
  release();
  note_layer(std::nullopt, 0);  // of a layer without beads
  layer_noted = false;
  reading_layer = step.index;
  entries.emplace_back(BeginLayer{step.index, std::nullopt, 0});
}

void Remix::State::take(const SlicedToolChange& step) {
  tool = step.tool;
  retraction.change_tool(tool);
}

std::size_t Remix::State::material_of(const SlicedMove& step) const {
  const auto known = settings.tools.find(tool);
  if (known == settings.tools.end()) {
    throw core::DataError(name, fmt::format("line {}", step.line),
                          fmt::format("uses tool T{}, which has no mixture", tool),
                          "start again if the file has changed meanwhile");
  }
  return known->second;
}

/// What the file does in a tower that is left out, or while it loads and unloads filament.
bool Remix::State::leaves_out(const SlicedMove& step) {
  if (step.ramming) {
    away = rammed = true;
  } else if (settings.leave_out_tower && step.feature == Feature::tower) {
    if (std::exchange(rammed, false)) retraction.forget();
    left_out += retraction.take(step.filament, !step.moves_flat()) * filament_area;
    away = true;
  } else {
    return away && step.filament == 0;  // on its way back
  }
  // The way to the tower is left out as well.
  std::erase_if(held, [](const Entry& entry) { return std::holds_alternative<Go>(entry); });
  return true;
}

/// What was held becomes certain.
void Remix::State::release() {
  for (Entry& entry : held) {
    if (const Go* go = std::get_if<Go>(&entry)) planned = go->to;
    entries.push_back(std::move(entry));
  }
  held.clear();
}

void Remix::State::draw(double length, double feed) {
  Go go{planned, planned, feed, 0, length, 0, 0, 0, Feature::unknown};
  drawn -= length;
  entries.emplace_back(go);
}

/// From where the nozzle is to where the file goes on: drawn back, and above what was laid.
void Remix::State::come_back(const SlicedMove& step) {
  away = false;
  if (std::exchange(rammed, false)) retraction.forget();
  bool same = true;
  for (std::size_t i = 0; i < planned.size(); ++i)
    same = same && (!step.from[i] || planned[i] == step.from[i]);
  if (same) return;
  if (drawn < printer.retraction_length - same_draw)
    draw(drawn - printer.retraction_length, printer.retraction_speed * 60);
  const double travel = 60 * std::min(printer.max_speed[0], printer.max_speed[1]),
               rise = 60 * printer.max_speed[2];
  const auto go = [&](Place to, double feed) {
    entries.emplace_back(Go{planned, to, feed, 0, 0, 0, 0, 0, Feature::unknown});
    planned = to;
  };
  const double top =
      std::max(planned[2].value_or(0), step.from[2].value_or(0)) + std::max(printer.z_hop, above);
  Place up = planned;
  up[2] = std::min(top, printer.bed[2]);
  go(up, rise);
  Place over = up;
  over[0] = step.from[0], over[1] = step.from[1];
  go(over, travel);
  go(step.from, rise);
}

/// The layer's own height is that of its first bead.
void Remix::State::note_layer(std::optional<double> top, double height) {
  if (std::exchange(layer_noted, true)) return;
  for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry) {
    BeginLayer* begin = std::get_if<BeginLayer>(&*entry);
    if (!begin) continue;
    begin->top = top.value_or(last_top);
    begin->height = height > 0               ? height
                    : *begin->top > last_top ? *begin->top - last_top
                                             : survey.layer_height;
    last_top = *begin->top;
    return;
  }
}

void Remix::State::take(const SlicedMove& step) {
  if (leaves_out(step)) return;
  if (away) come_back(step);
  Go go;
  go.from = step.from;
  go.to = step.to;
  go.feed = step.feed;
  go.feature = step.feature;
  go.width = step.width;
  go.height = step.height;
  if (step.filament == 0) {
    held.emplace_back(go);
    return;
  }
  release();
  // A tool that counts its own retraction has come: the one nozzle follows before it lays a bead.
  if (step.lays() && std::abs(drawn - retraction.drawn()) > same_draw)
    draw(drawn - retraction.drawn(), printer.retraction_speed * 60);
  const double fed = retraction.take(step.filament, !step.moves_flat());
  go.fed = fed * filament_area;
  go.other = drawn - retraction.drawn();
  drawn = retraction.drawn();
  planned = step.to;
  if (go.fed > 0) {
    go.material = material_of(step);
    if (step.moves_flat() && step.feature != Feature::custom) note_layer(step.to[2], step.height);
    const bool beside =
        step.feature == Feature::custom || step.feature == Feature::aside || step.feature == Feature::tower;
    const double matters = settings.hide ? weight(step.feature) : beside ? unseen : 1;
    schedule.add({go.fed, go.material, 0, matters, false, reading_layer, materials});
    if (last_material && *last_material != go.material) ++mixing.changes;
    last_material = go.material;
  }
  if (go.fed > 0 || go.other != 0 || step.moves()) entries.emplace_back(go);
}

// ---- writing

bool Remix::State::is_certain(const Entry& entry) const {
  if (in_end) return true;
  if (const BeginLayer* begin = std::get_if<BeginLayer>(&entry)) return begin->top.has_value();
  const Go* go = std::get_if<Go>(&entry);
  return !go || go->fed == 0 || laid + go->fed <= schedule.certain() + least_piece;
}

void Remix::State::write(const Text& entry) {
  if (is_command(entry.line))
    writer.pass(chunk, entry.line);
  else
    chunk.lines.push_back(entry.line);
}

void Remix::State::write(const BeginLayer& entry) {
  end_layer(true);
  begun = true;
  share = {entry.index, 0, 0, false};
  mixing = {};
  mixing.layer = entry.index;
  wanted = {entry.index, entry.top.value_or(0), entry.height, {}};
  append(chunk.lines, {";LAYER_CHANGE", ";Z:" + short_number(entry.top.value_or(0), 3),
                       ";HEIGHT:" + short_number(entry.height, 3)});
}

void Remix::State::end_layer(bool last) {
  if (!begun) return;
  share.seconds += time.seconds() - assigned;
  chunk.seconds += time.seconds() - assigned;
  assigned = time.seconds();
  share.last = last;
  chunk.layers.push_back(share);
  share.volume = share.seconds = 0;
  if (!last) return;
  chunk.mixing.push_back(mixing);
  if (listens && !wanted.strokes.empty()) finished.push_back(std::move(wanted));
  begun = false;
}

void Remix::State::select_equal_shares() {
  if (const auto equal = tools.retraction_tool()) writer.select_tool(chunk, *equal);
}

void Remix::State::switch_mixture() {
  std::optional<Shade> next;
  while (!switches.empty() && switches.front().at <= laid + least_piece) {
    next = switches.front().shade;
    switches.pop_front();
    ++mixing.switches;
  }
  if (next) {
    shade = next;
    shade_tool = tools.use(palette.calibrated(*next), chunk.lines);
    define_tool(shade_tool);
  }
  assert(shade);  // the first switch is at 0
  writer.select_tool(chunk, shade_tool);
}

void Remix::State::move(const Place& to, double filament, double feed) {
  const Place from = writer.place();
  writer.move(chunk, to, filament, feed);
  PerAxis way{};
  for (std::size_t i = 0; i < to.size(); ++i) way[i] = to[i] && from[i] ? *to[i] - *from[i] : 0;
  way[3] = filament;
  if (feed > 0) time.move(way, feed / 60);
}

void Remix::State::write(const Go& entry) {
  if (entry.fed > 0) return write_feed(entry);
  if (entry.other != 0) select_equal_shares();
  move(entry.to, entry.other, entry.feed);
}

/// Cuts the move where a switch falls inside it. What was drawn back is pushed forward with the first piece.
void Remix::State::write_feed(const Go& entry) {
  Place from = entry.from;
  for (double done = 0;;) {
    switch_mixture();
    const double left = entry.fed - done;
    bool known = true;
    for (std::size_t i = 0; i < 3; ++i) known = known && (entry.from[i].has_value() || !entry.to[i]);
    const bool cut = known && !switches.empty() && switches.front().at < laid + left - least_piece;
    const double volume = cut ? std::max(switches.front().at - laid, 0.0) : left;
    done += volume;
    Place to = entry.to;
    for (std::size_t i = 0; i < 3 && cut; ++i) {
      if (!to[i]) continue;
      to[i] = *entry.from[i] + (*entry.to[i] - *entry.from[i]) * (done / entry.fed);
      if (*entry.from[i] != *entry.to[i]) to[i] = std::round(*to[i] * 1000) / 1000;
    }
    const double other = from == entry.from && done == volume ? entry.other : 0;
    move(to, volume / filament_area + other, entry.feed);
    account(entry, from, to, volume);
    laid += volume;
    from = to;
    if (!cut) return;
  }
}

void Remix::State::account(const Go& entry, const Place& from, const Place& to, double volume) {
  const Mixture& mixture = palette.mixture(*shade);
  add(chunk.mixture_volumes, mixture, volume);
  chunk.volume += volume;
  share.volume += volume;
  highest = std::max(highest, to[2].value_or(0));
  const bool shows = is_seen(entry.feature);
  const Tanks::Shares& want = palette.mixture(Shade{entry.material, 0}).shares();
  WantedRun run;
  run.material = entry.material;
  run.layer_materials = materials;
  outflow.feed(mixture.shares(), volume, [&](double piece, const Tanks::Shares& arrived) {
    const Mismatch bad = mismatch(palette, run, want, arrived);
    if (!shows) {
      seen.hidden += bad.misplaced * piece;
      return;
    }
    seen.volume += piece;
    seen.misplaced += bad.misplaced * piece;
    mixing.misplaced += bad.misplaced * piece;
    if (!bad.wrong) return;
    seen.wrong += piece;
    mixing.wrong += piece;
  });
  if (!listens || !begun || !from[0] || !from[1] || !to[0] || !to[1]) return;
  const core::Vec2 a(*from[0], *from[1]), b(*to[0], *to[1]);
  const double length = (b - a).norm(), height = entry.height > 0 ? entry.height : wanted.height;
  if (length <= 0) return;
  const double width = entry.width > 0 ? entry.width : height > 0 ? volume / length / height : printer.nozzle;
  wanted.strokes.push_back({a, b, width, volume, entry.material, entry.feature});
}

/// Writes what is certain; returns false when more has to be read.
bool Remix::State::write_some(std::size_t most_lines) {
  while (!entries.empty()) {
    if (!is_certain(entries.front())) return false;
    if (std::holds_alternative<BeginLayer>(entries.front()) && begun && !chunk.lines.empty()) {
      end_layer(true);
      return true;
    }
    const Entry entry = std::move(entries.front());
    entries.pop_front();
    std::visit([this](const auto& kind) { write(kind); }, entry);
    if (chunk.lines.size() >= most_lines) return true;
  }
  return false;
}

Chunk Remix::State::hand_over() {
  if (begun) end_layer(false);
  chunk.seconds += time.seconds() - assigned;
  assigned = time.seconds();
  return std::exchange(chunk, {});
}

void Remix::State::check_materials() const {
  for (const SlicedTool& one : survey.tools) {
    const auto known = settings.tools.find(one.number);
    if (known != settings.tools.end() && known->second < settings.materials.size()) continue;
    throw core::DataError(name, fmt::format("T{}", one.number), "has no mixture", "choose one for it");
  }
  for (const Material& material : settings.materials) {
    if (!material.gradient) continue;
    throw core::DataError(name, material.name, "is a gradient, which a slicer's file cannot have",
                          "choose a single mixture");
  }
}

Remix::Remix(std::istream& file, const std::string& name, const Printer& printer, const SlicedSurvey& survey,
             const RemixSettings& settings) {
  check_printer(printer);
  const Dialect& dialect = dialect_named(printer.firmware);
  state_ = std::make_unique<State>(file, name, printer, survey, settings, dialect,
                                   mixtures_of(printer, settings, dialect));
  state_->check_materials();
}
Remix::~Remix() = default;
Remix::Remix(Remix&&) noexcept = default;

Chunk Remix::start() {
  State& s = *state_;
  append(s.chunk.lines, choose_extruder(s.dialect));
  append(s.chunk.lines, {stay_watchful(), "M220 S100", "M221 S100"});
  append(s.chunk.lines, modes());
  append(s.chunk.lines, calibration(s.printer));
  append(s.chunk.lines, s.tools.define());
  // The file's own lines up to its first layer.
  for (;;) {
    while (!s.entries.empty() && !std::holds_alternative<BeginLayer>(s.entries.front()) &&
           s.is_certain(s.entries.front())) {
      const Entry entry = std::move(s.entries.front());
      s.entries.pop_front();
      std::visit([&s](const auto& kind) { s.write(kind); }, entry);
    }
    if (s.read_all || (!s.entries.empty() && std::holds_alternative<BeginLayer>(s.entries.front()))) break;
    s.read_more();
  }
  return s.hand_over();
}

std::optional<Chunk> Remix::next() {
  State& s = *state_;
  for (;;) {
    if (s.write_some(chunk_lines)) return s.hand_over();
    if (s.read_all) break;
    s.read_more();
    if (s.in_end && !s.held.empty()) s.release();
  }
  if (s.begun) s.end_layer(true);
  if (s.chunk.lines.empty()) return std::nullopt;
  return s.hand_over();
}

Chunk Remix::finish(bool stopped) {
  State& s = *state_;
  if (stopped) {
    // The print may have stopped anywhere, so that no state is assumed.
    s.writer.forget();
    append(s.chunk.lines, modes());
    if (s.highest > 0) {
      s.select_equal_shares();
      s.writer.move(s.chunk, {}, -s.printer.retraction_length, s.printer.retraction_speed * 60);
      Place up{};
      up[2] = std::min(std::max(s.highest, s.survey.height) + park_lift, s.printer.bed[2]);
      s.writer.move(s.chunk, up, 0, s.printer.max_speed[2] * 60);
      s.writer.move(s.chunk, {0.0, s.printer.bed[1], up[2]}, 0,
                    60 * std::min(s.printer.max_speed[0], s.printer.max_speed[1]));
    }
  } else {
    s.in_end = false;
    for (const SlicedStep& step : std::exchange(s.end, {})) {
      if (const auto* pass = std::get_if<SlicedPass>(&step)) s.write(Text{pass->text});
      if (const auto* remark = std::get_if<SlicedRemark>(&step)) s.write(Text{remark->text});
      const auto* move = std::get_if<SlicedMove>(&step);
      if (!move) continue;
      if (move->filament != 0) s.select_equal_shares();
      s.move(move->to, move->filament, move->feed);
    }
  }
  append(s.chunk.lines, shut_down({}));
  return s.hand_over();
}

Mixture Remix::intended(std::size_t material) const {
  return state_->palette.mixture(Shade{material, 0});
}

void Remix::listen() {
  state_->listens = true;
}

std::vector<WantedLayer> Remix::wanted() {
  return std::exchange(state_->finished, {});
}

SeenMixing Remix::seen() const {
  return state_->seen;
}

double Remix::left_out() const {
  return state_->left_out;
}

}  // namespace unicursal::gcode
