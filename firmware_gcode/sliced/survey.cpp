#include "firmware_gcode/sliced/survey.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "firmware_gcode/motion/time_estimate.hpp"
#include "firmware_gcode/sliced/reader.hpp"
#include "firmware_gcode/sliced/retraction.hpp"

namespace unicursal::gcode {
namespace {

constexpr std::uint64_t lines_between_stops = 1 << 14;
constexpr double other_diameter = 0.02;  ///< mm by which filament may differ from the profile's
constexpr std::size_t most_beside = 200'000;
constexpr double least_height = 0.01;  ///< mm

class Surveyor {
 public:
  Surveyor(const std::string& name, const Printer& printer, const SlicedReader& reader)
      : name_(name),
        printer_(printer),
        reader_(reader),
        area_(std::numbers::pi / 4 * printer.filament_diameter * printer.filament_diameter),
        time_(printer) {}

  void take(const SlicedMove& move) {
    count(move.line);
    if (move.ramming) {  // is never printed
      rammed_ = true;
      return;
    }
    if (move.filament != 0 && std::exchange(rammed_, false)) retraction_.forget();
    const double fed = retraction_.take(move.filament, !move.moves_flat());
    const bool in_tower = move.ramming || move.feature == Feature::tower;
    if (in_tower != in_tower_) note_tower_time(), in_tower_ = in_tower;
    PerAxis way{};
    for (std::size_t i = 0; i < 3; ++i)
      way[i] = move.to[i].value_or(0) - move.from[i].value_or(move.to[i].value_or(0));
    way[3] = move.filament;
    if (move.feed > 0) time_.move(way, move.feed / 60);
    if (fed <= 0) return;
    const double volume = fed * area_;
    survey_.volume += volume;
    tools_[tool_] += volume;
    if (move.feature == Feature::tower) survey_.tower_volume += volume;
    if (!move.moves_flat()) return;
    survey_.last_bead = move.line;
    if (in_layers_) beside_ = 0;
    if (move.feature == Feature::custom) return;
    if (is_seen(move.feature) && !seen_any_) seen_any_ = true, before_part_ = survey_.volume - volume;
    if (last_tool_ && *last_tool_ != tool_) ++survey_.changes;
    last_tool_ = tool_;
    for (const Place& place : {move.from, move.to}) extend(place);
    const double z = move.to[2].value_or(0);
    survey_.height = std::max(survey_.height, z);
    if (std::exchange(layer_is_new_, false)) note_height(z);
  }
  void take(const SlicedToolChange& change) { tool_ = change.tool, retraction_.change_tool(tool_); }
  void take(const SlicedLayer& layer) {
    survey_.layers = layer.index + 1;
    layer_is_new_ = true;
    end_layer();
    in_layers_ = true;
  }
  void take(const SlicedPass& pass) { count(pass.line); }
  void take(const SlicedRemark&) {}

  SlicedSurvey finish() {
    end_layer();
    const CommentState& comments = reader_.comments();
    survey_.slicer = comments.slicer;
    survey_.seconds = time_.seconds();
    survey_.nozzle = reader_.hottest_nozzle();
    survey_.bed = reader_.hottest_bed();
    survey_.lines = reader_.lines();
    survey_.marked = reader_.marked();
    survey_.notes = reader_.notes();
    if (!any_ || survey_.layers == 0) {
      throw core::DataError(name_, "", "lays no plastic",
                            reader_.lines() == 0 ? "the file is empty; export it from the slicer again"
                                                 : "check that it is the G-code of a print");
    }
    survey_.layer_height = heights_.empty() ? survey_.first_layer_height : most_common_height();
    for (const auto& [number, volume] : tools_) {
      SlicedTool tool{number, {}, volume, {}};
      tool.colour = comments.colour(number);
      if (const auto own = reader_.own_colours().find(number); own != reader_.own_colours().end())
        tool.colour = own->second;
      if (const auto own = reader_.own_mixtures().find(number); own != reader_.own_mixtures().end())
        tool.mixture = own->second;
      survey_.tools.push_back(std::move(tool));
    }
    if (comments.filament_diameter &&
        std::abs(*comments.filament_diameter - printer_.filament_diameter) > other_diameter) {
      survey_.notes.push_back(fmt::format(
          "the file was sliced for filament of {:g} mm, and the profile has {:g} mm; slice with the right "
          "diameter, or {:.0f} % of the plastic come out",
          *comments.filament_diameter, printer_.filament_diameter,
          100 * std::pow(printer_.filament_diameter / *comments.filament_diameter, 2)));
    }
    if (comments.any_feature && before_part_ < printer_.dead_volume + printer_.mixing_volume) {
      survey_.notes.push_back(fmt::format(
          "only {:.1f} mm³ are printed before the part is seen, and a change of mixture takes {:g} mm³, so "
          "that the first beads may come out in a former colour; add loops to the skirt in the slicer",
          before_part_, printer_.dead_volume + printer_.mixing_volume));
    }
    if (!comments.any_feature) {
      survey_.notes.push_back(
          "the file does not say what is wall and what is infill, so that changes of mixture cannot be "
          "hidden; "
          "slice with a program that writes it into comments, such as PrusaSlicer from version 2.3 on, or "
          "Cura");
    }
    return std::move(survey_);
  }

 private:
  /// What precedes the first layer, and what follows the last bead, is kept in memory as a whole.
  void count(std::uint64_t line) {
    if (++beside_ <= most_beside) return;
    throw core::DataError(name_, fmt::format("line {}", line),
                          fmt::format("is the {}th in a row that lays nothing", most_beside + 1),
                          "check that the file is the G-code of a print");
  }
  void extend(const Place& place) {
    if (!place[0] || !place[1]) return;
    const core::Vec2 point(*place[0], *place[1]);
    if (!std::exchange(any_, true)) survey_.extent = {point, point};
    survey_.extent.min = survey_.extent.min.cwiseMin(point);
    survey_.extent.max = survey_.extent.max.cwiseMax(point);
  }
  /// Differences between the heights at which plastic is laid are the layer heights.
  void note_height(double z) {
    if (survey_.first_layer_height == 0) survey_.first_layer_height = z;
    if (z > last_z_ + least_height && last_z_ > 0 && heights_.size() < 1000)
      ++heights_[std::llround((z - last_z_) * 1000)];
    last_z_ = z;
  }
  double most_common_height() const {
    const auto most = std::max_element(heights_.begin(), heights_.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    return static_cast<double>(most->first) / 1000;
  }
  void note_tower_time() {
    const double now = time_.seconds();
    if (in_tower_) in_this_tower_ += now - tower_began_;
    tower_began_ = now;
  }
  void end_layer() {
    note_tower_time();
    const double now = time_.seconds();
    if (in_layers_) {
      survey_.layer_seconds.push_back(now - layer_began_);
      survey_.tower_seconds.push_back(in_this_tower_);
    }
    in_this_tower_ = 0;
    layer_began_ = now;
  }

  const std::string& name_;
  const Printer& printer_;
  const SlicedReader& reader_;
  double area_;  ///< mm², of the filament
  TimeEstimate time_;
  Retraction retraction_;
  SlicedSurvey survey_;
  std::map<int, double> tools_;
  std::map<long long, std::size_t> heights_;  ///< µm, and how often
  int tool_ = 0;
  std::optional<int> last_tool_;
  double last_z_ = 0, layer_began_ = 0, tower_began_ = 0, in_this_tower_ = 0;
  std::size_t beside_ = 0;  ///< steps since the last bead of a layer
  bool in_tower_ = false, layer_is_new_ = false;
  bool any_ = false, in_layers_ = false, rammed_ = false, seen_any_ = false;
  double before_part_ = 0;  ///< mm³ before the first bead that is seen
};

}  // namespace

namespace {

/// nullopt if the file has to be read again, because comments mark its layers.
std::optional<SlicedSurvey> survey_once(std::istream& file, const std::string& name, const Printer& printer,
                                        const SlicedLimits& limits, const std::function<void()>& stop,
                                        bool marked) {
  SlicedReader reader(file, name, printer, limits, marked);
  Surveyor surveyor(name, printer, reader);
  std::uint64_t looked = 0;
  while (const auto step = reader.next()) {
    if (reader.marked_late()) return std::nullopt;
    std::visit([&](const auto& kind) { surveyor.take(kind); }, *step);
    if (!stop || reader.lines() / lines_between_stops == looked) continue;
    looked = reader.lines() / lines_between_stops;
    stop();
  }
  return surveyor.finish();
}

}  // namespace

SlicedSurvey survey_sliced(std::istream& file, const std::string& name, const Printer& printer,
                           const SlicedLimits& limits, const std::function<void()>& stop) {
  if (auto survey = survey_once(file, name, printer, limits, stop, false)) return std::move(*survey);
  file.clear();
  file.seekg(0);
  return *survey_once(file, name, printer, limits, stop, true);
}

}  // namespace unicursal::gcode
