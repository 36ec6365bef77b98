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
#include "firmware_gcode/mixing/print_mixtures.hpp"
#include "firmware_gcode/mixing/schedule.hpp"
#include "firmware_gcode/mixing/tool_table.hpp"
#include "firmware_gcode/motion/time_estimate.hpp"
#include "firmware_gcode/remix/entries.hpp"
#include "firmware_gcode/remix/line_writer.hpp"
#include "firmware_gcode/remix/outflow.hpp"
#include "firmware_gcode/toolpath/checks.hpp"
#include "firmware_gcode/toolpath/job_frame.hpp"

namespace unicursal::gcode {
namespace {

constexpr double unseen = 0.02;        ///< weight of plastic beside the part if nothing is hidden
constexpr double before_border = 0.5;  ///< fraction of each change
constexpr double early = 0.999;        ///< fraction of a change that a switch may precede its border by
constexpr double horizon = 3;          ///< mixing volumes after which a switch is final
constexpr double least_piece = 1e-3;   ///< mm³; beads are not cut nearer to their ends
constexpr double park_lift = 10;       ///< mm above the last layer
constexpr std::size_t chunk_lines = 2000;

void append(std::vector<std::string>& lines, std::vector<std::string> more) {
  lines.insert(lines.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

ScheduleOptions schedule_options(const Printer& printer, const RemixSettings& settings,
                                 const Overshoots& overshoots) {
  ScheduleOptions options{chamber_of(printer), before_border, settings.look_ahead, &overshoots};
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
        const RemixSettings& with, const Dialect& speaks, PrintMixtures mixtures);

  void want(const Go& go, std::size_t of_layer);
  void read_more();

  bool is_certain(const Entry& entry) const;
  bool write_some(std::size_t most_lines);
  void write(const Text& entry);
  void write(const LayerMark& entry);
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
  const LayerMaterials materials;
  Entries entries;

  std::deque<Switch> switches;
  std::optional<Shade> shade;  ///< in use
  std::size_t shade_tool = 0;
  double laid = 0;  ///< mm³ that are written
  Chunk chunk;
  LayerShare share;
  LayerMixing mixing;
  double assigned = 0;  ///< s of the chunks so far
  double highest = 0;
  std::optional<std::size_t> last_material;
  bool begun = false;  ///< a layer has begun
  bool listens = false;
  WantedLayer wanted;
  std::vector<WantedLayer> finished;
  SeenMixing seen;
};

Remix::State::State(std::istream& file, const std::string& of_name, const Printer& of,
                    const SlicedSurvey& surveyed, const RemixSettings& with, const Dialect& speaks,
                    PrintMixtures mixtures)
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
      outflow(chamber_of(of), of.feeders),
      time(of),
      materials(all_materials(with)),
      entries(file, name, printer, survey, settings,
              [this](const Go& go, std::size_t of_layer) { want(go, of_layer); }) {
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

void Remix::State::want(const Go& go, std::size_t of_layer) {
  const bool beside =
      go.feature == Feature::custom || go.feature == Feature::aside || go.feature == Feature::tower;
  const double matters = settings.hide ? weight(go.feature) : beside ? unseen : 1;
  schedule.add({go.fed, go.material, 0, matters, false, of_layer, materials});
}

void Remix::State::read_more() {
  entries.read();
  if (entries.complete()) schedule.end();
  for (const Switch& next : schedule.take()) switches.push_back(next);
}

bool Remix::State::is_certain(const Entry& entry) const {
  if (entries.complete()) return true;
  if (const LayerMark* begin = std::get_if<LayerMark>(&entry)) return begin->top.has_value();
  const Go* go = std::get_if<Go>(&entry);
  return !go || go->fed == 0 || laid + go->fed <= schedule.certain() + least_piece;
}

void Remix::State::write(const Text& entry) {
  if (is_command(entry.line))
    writer.pass(chunk, entry.line);
  else
    chunk.lines.push_back(entry.line);
}

void Remix::State::write(const LayerMark& entry) {
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
  if (last_material && *last_material != entry.material) ++mixing.changes;
  if (last_material != entry.material) chunk.asked.push_back({chunk.lines.size(), entry.material});
  last_material = entry.material;
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
  if (is_aside(entry.feature)) add(chunk.aside_mixtures, mixture, volume);
  chunk.volume += volume;
  share.volume += volume;
  highest = std::max(highest, to[2].value_or(0));
  const bool shows = is_seen(entry.feature);
  const Shares& want = palette.mixture(Shade{entry.material, 0}).shares();
  WantedRun run;
  run.material = entry.material;
  run.layer_materials = materials;
  outflow.feed(mixture.shares(), volume, [&](double piece, const Shares& arrived) {
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
  while (!entries.queue().empty()) {
    if (!is_certain(entries.queue().front())) return false;
    if (std::holds_alternative<LayerMark>(entries.queue().front()) && begun && !chunk.lines.empty()) {
      end_layer(true);
      return true;
    }
    const Entry entry = std::move(entries.queue().front());
    entries.queue().pop_front();
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
  state_ = std::make_unique<State>(
      file, name, printer, survey, settings, dialect,
      mixtures_of(printer, settings.materials, settings.look_ahead, before_border, dialect));
  state_->check_materials();
}
Remix::~Remix() = default;
Remix::Remix(Remix&&) noexcept = default;

Chunk Remix::start() {
  State& s = *state_;
  for (const auto& [number, material] : s.settings.tools) {
    const Material& of = s.settings.materials[material];
    s.chunk.lines.push_back(
        comment(fmt::format(" unicursal prints T{} with {}: {}", number, of.name, shares_text(of.mixture))));
  }
  append(s.chunk.lines, choose_extruder(s.dialect));
  append(s.chunk.lines, {stay_watchful(), "M220 S100", "M221 S100"});
  append(s.chunk.lines, modes());
  append(s.chunk.lines, calibration(s.printer));
  append(s.chunk.lines, s.tools.define());
  // The file's own lines up to its first layer.
  for (;;) {
    while (!s.entries.queue().empty() && !std::holds_alternative<LayerMark>(s.entries.queue().front()) &&
           s.is_certain(s.entries.queue().front())) {
      const Entry entry = std::move(s.entries.queue().front());
      s.entries.queue().pop_front();
      std::visit([&s](const auto& kind) { s.write(kind); }, entry);
    }
    if (s.entries.complete() ||
        (!s.entries.queue().empty() && std::holds_alternative<LayerMark>(s.entries.queue().front())))
      break;
    s.read_more();
  }
  return s.hand_over();
}

std::optional<Chunk> Remix::next() {
  State& s = *state_;
  for (;;) {
    if (s.write_some(chunk_lines)) return s.hand_over();
    if (s.entries.complete()) break;
    s.read_more();
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
    for (const SlicedStep& step : s.entries.rest()) {
      if (const auto* pass = std::get_if<SlicedPass>(&step)) s.write(Text{pass->text});
      const auto* move = std::get_if<SlicedMove>(&step);
      if (!move || move->ramming || (s.settings.leave_out_tower && move->feature == Feature::tower)) continue;
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
  return state_->entries.left_out();
}

}  // namespace unicursal::gcode
