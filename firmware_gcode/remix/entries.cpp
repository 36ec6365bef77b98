#include "firmware_gcode/remix/entries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/error.hpp"

namespace unicursal::gcode {
namespace {

constexpr double same_draw = 1e-4;  ///< mm of filament
constexpr double above = 0.6;       ///< mm by which the way from a tower that is left out rises, at least
constexpr std::size_t most_held = 10000;
constexpr std::uint64_t lines_between_stops = 1 << 14;

}  // namespace

Entries::Entries(std::istream& file, const std::string& name, const Printer& printer,
                 const SlicedSurvey& survey, const RemixSettings& settings, Want want)
    : name_(name),
      printer_(printer),
      survey_(survey),
      settings_(settings),
      want_(std::move(want)),
      filament_area_(std::numbers::pi / 4 * printer.filament_diameter * printer.filament_diameter),
      reader_(file, name, printer, settings.limits, survey.marked) {}

void Entries::look_whether_to_stop() {
  if (!settings_.stop || reader_.lines() / lines_between_stops == looked_) return;
  looked_ = reader_.lines() / lines_between_stops;
  settings_.stop();
}

void Entries::read() {
  const auto step = reader_.next();
  if (!step) {
    throw core::DataError(name_, "", "has become shorter since it was looked at",
                          "start again when nothing writes to it any more");
  }
  look_whether_to_stop();
  std::visit([this](const auto& kind) { take(kind); }, *step);
  if (reader_.lines() < survey_.last_bead || !reader_.nothing_pending()) return;
  complete_ = true;
  release();
  note_layer(std::nullopt, 0);
}

std::vector<SlicedStep> Entries::rest() {
  std::vector<SlicedStep> steps;
  while (auto step = reader_.next()) {
    look_whether_to_stop();
    if (!std::holds_alternative<SlicedRemark>(*step)) steps.push_back(std::move(*step));
  }
  return steps;
}

void Entries::take(const SlicedRemark& step) {
  hold(Text{step.text});
}

void Entries::take(const SlicedPass& step) {
  const bool heats =
      step.text.starts_with("M10") || step.text.starts_with("M14") || step.text.starts_with("M19");
  if (step.tower && settings_.leave_out_tower && !heats) return;
  hold(Text{step.text});
}

void Entries::take(const SlicedLayer& step) {
  release();
  note_layer(std::nullopt, 0);  // of a layer without beads
  layer_noted_ = false;
  layer_ = step.index;
  queue_.emplace_back(LayerMark{step.index, std::nullopt, 0});
}

void Entries::take(const SlicedToolChange& step) {
  tool_ = step.tool;
  retraction_.change_tool(tool_);
}

std::size_t Entries::material_of(const SlicedMove& step) const {
  const auto known = settings_.tools.find(tool_);
  if (known == settings_.tools.end()) {
    throw core::DataError(name_, fmt::format("line {}", step.line),
                          fmt::format("uses tool T{}, which has no mixture", tool_),
                          "start again if the file has changed meanwhile");
  }
  return known->second;
}

/// What the file does in a tower that is left out, or while it loads and unloads filament.
bool Entries::leaves_out(const SlicedMove& step) {
  if (step.ramming) {
    away_ = rammed_ = true;
  } else if (settings_.leave_out_tower && step.feature == Feature::tower) {
    if (step.filament != 0 && std::exchange(rammed_, false)) retraction_.forget();
    left_out_ += retraction_.take(step.filament, !step.moves_flat()) * filament_area_;
    away_ = true;
  } else if (away_ && !step.moves() && step.filament < 0) {  // drawn back before the way back
    if (std::exchange(rammed_, false)) retraction_.forget();
    retraction_.take(step.filament, true);
    return true;
  } else {
    return away_ && step.filament == 0;  // on its way back
  }
  // The way to the tower is left out as well.
  std::erase_if(held_, [](const Entry& entry) { return std::holds_alternative<Go>(entry); });
  return true;
}

/// A file may hold any number of comments and travels between two beads.
void Entries::hold(Entry entry) {
  held_.push_back(std::move(entry));
  if (held_.size() > most_held) release();
}

/// What was held becomes certain.
void Entries::release() {
  for (Entry& entry : held_) {
    if (const Go* go = std::get_if<Go>(&entry)) planned_ = go->to;
    queue_.push_back(std::move(entry));
  }
  held_.clear();
}

void Entries::draw(double length, double feed) {
  Go go{planned_, planned_, feed, 0, length, 0, 0, 0, Feature::unknown};
  drawn_ -= length;
  queue_.emplace_back(go);
}

/// From where the nozzle is to where the file goes on: drawn back, and above what was laid.
void Entries::come_back(const SlicedMove& step) {
  away_ = false;
  if (std::exchange(rammed_, false)) retraction_.forget();
  bool same = true;
  for (std::size_t i = 0; i < planned_.size(); ++i)
    same = same && (!step.from[i] || planned_[i] == step.from[i]);
  if (same) return;
  if (drawn_ < printer_.retraction_length - same_draw)
    draw(drawn_ - printer_.retraction_length, printer_.retraction_speed * 60);
  const double travel = 60 * std::min(printer_.max_speed[0], printer_.max_speed[1]),
               rise = 60 * printer_.max_speed[2];
  const auto go = [&](Place to, double feed) {
    queue_.emplace_back(Go{planned_, to, feed, 0, 0, 0, 0, 0, Feature::unknown});
    planned_ = to;
  };
  const double top =
      std::max(planned_[2].value_or(0), step.from[2].value_or(0)) + std::max(printer_.z_hop, above);
  Place up = planned_;
  up[2] = std::min(top, printer_.bed[2]);
  go(up, rise);
  Place over = up;
  over[0] = step.from[0], over[1] = step.from[1];
  go(over, travel);
  go(step.from, rise);
}

/// The layer's own height is that of its first bead.
void Entries::note_layer(std::optional<double> top, double height) {
  if (std::exchange(layer_noted_, true)) return;
  for (auto entry = queue_.rbegin(); entry != queue_.rend(); ++entry) {
    LayerMark* begin = std::get_if<LayerMark>(&*entry);
    if (!begin) continue;
    begin->top = top.value_or(last_top_);
    begin->height = height > 0                ? height
                    : *begin->top > last_top_ ? *begin->top - last_top_
                                              : survey_.layer_height;
    last_top_ = *begin->top;
    return;
  }
}

void Entries::take(const SlicedMove& step) {
  if (leaves_out(step)) return;
  if (away_) come_back(step);
  Go go;
  go.from = step.from;
  go.to = step.to;
  go.feed = step.feed;
  go.feature = step.feature;
  go.width = step.width;
  go.height = step.height;
  if (step.filament == 0) {
    hold(go);
    return;
  }
  release();
  // A tool that counts its own retraction has come: the one nozzle follows before it lays a bead.
  if (step.lays() && std::abs(drawn_ - retraction_.drawn()) > same_draw)
    draw(drawn_ - retraction_.drawn(), printer_.retraction_speed * 60);
  const double fed = retraction_.take(step.filament, !step.moves_flat());
  go.fed = fed * filament_area_;
  go.other = drawn_ - retraction_.drawn();
  drawn_ = retraction_.drawn();
  planned_ = step.to;
  if (go.fed > 0) {
    go.material = material_of(step);
    if (step.moves_flat() && step.feature != Feature::custom) note_layer(step.to[2], step.height);
    want_(go, layer_);
  }
  if (go.fed > 0 || go.other != 0 || step.moves()) queue_.emplace_back(go);
}

}  // namespace unicursal::gcode
