#include "host/report/sliced_books.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "host/report/picture_writer.hpp"
#include "host/report/summary.hpp"

namespace unicursal::host {
namespace {

constexpr double narrowest = 0.02, widest = 10;  ///< mm, of a bead in the picture of what was wanted

/// The width of a bead with upright sides, which is how the simulator lays it.
double upright_width(const gcode::WantedStroke& stroke, double height) {
  const double length = (stroke.to - stroke.from).norm();
  if (height <= 0 || length <= 0) return stroke.width;
  return std::clamp(stroke.volume / length / height, narrowest, widest);
}

core::Polygon rectangle(const core::Vec2& from, const core::Vec2& to, double width) {
  const core::Vec2 along = (to - from).normalized();
  const core::Vec2 aside = core::Vec2(-along.y(), along.x()) * (width / 2);
  core::Polygon polygon;
  polygon.outer = {from - aside, to - aside, to + aside, from + aside};
  return polygon;
}

}  // namespace

TargetLayer target_of(const gcode::WantedLayer& wanted, std::size_t materials) {
  TargetLayer target;
  target.index = wanted.index;
  target.top = wanted.top;
  target.height = wanted.height;
  target.by_beads = true;
  double widths = 0;
  for (const bool shown : {false, true}) {  // what is seen lies on top of the rest
    for (const gcode::WantedStroke& stroke : wanted.strokes) {
      if (gcode::is_seen(stroke.feature) != shown || stroke.from == stroke.to) continue;
      const double width = upright_width(stroke, wanted.height);
      const std::size_t label = stroke.material + (shown ? 0 : materials);
      target.zones.push_back({rectangle(stroke.from, stroke.to, width), static_cast<RegionLabel>(label)});
      widths += width;
    }
  }
  if (!target.zones.empty()) target.bead_width = widths / static_cast<double>(target.zones.size());
  return target;
}

SlicedBooks::SlicedBooks(SlicedProduction& production, std::string command, const RunOutputs& outputs)
    : Books(production.job(), std::move(command), outputs), production_(production) {
  if (outputs.pictures) make_picture_folder(*outputs.pictures);
  const std::vector<gcode::Material>& materials = production.job().print.materials;
  for (std::size_t i = 0; i < materials.size(); ++i)
    totals_.materials.push_back({materials[i].name, materials[i].mixture, production.intended(i)});
  count(production.start());
  production.listen(this);
}

SlicedBooks::~SlicedBooks() {
  production_.listen(nullptr);
}

std::vector<IntendedMaterial> SlicedBooks::intended_materials() const {
  std::vector<IntendedMaterial> intended;
  for (const bool shown : {true, false}) {
    for (const MaterialVolume& material : totals_.materials) {
      intended.emplace_back(material.intended);
      intended.back().transition = !shown;
    }
  }
  return intended;
}

void SlicedBooks::chunk_made(const RemixedChunk& made) {
  for (const gcode::WantedLayer& layer : made.wanted) {
    ++totals_.layers;
    for (const gcode::WantedStroke& stroke : layer.strokes)
      totals_.materials.at(stroke.material).part += stroke.volume;
    if (check() != nullptr) check()->expect(target_of(layer, totals_.materials.size()));
    if (has_log())
      describe(layer.index, {{"layer", layer.index}, {"top_mm", layer.top}, {"height_mm", layer.height}});
  }
  seen_ = made.seen;
  left_out_ = made.left_out;
  count(made.chunk);
  log_finished_layers(false);
}

void SlicedBooks::end_made(const gcode::Chunk& chunk) {
  count(chunk);
  log_finished_layers(true);
}

nlohmann::json SlicedBooks::more() const {
  const gcode::SlicedSurvey& survey = production_.prepared().survey;
  std::vector<std::string> warnings = survey.notes;
  for (const std::string& warning : production_.late_warnings()) warnings.push_back(warning);
  nlohmann::json tools = nlohmann::json::array();
  for (const gcode::SlicedTool& tool : survey.tools) {
    const std::size_t material = job().sliced->tools.at(tool.number);
    nlohmann::json entry = {{"tool", tool.number},
                            {"volume_mm3", tool.volume},
                            {"mixture", job().print.materials.at(material).name}};
    if (!tool.colour.empty()) entry["colour"] = tool.colour;
    tools.push_back(std::move(entry));
  }
  return {
      {"warnings", warnings},
      {"sliced",
       {{"slicer", survey.slicer},
        {"tools", tools},
        {"changes", survey.changes},
        {"tower_mm3", survey.tower_volume},
        {"left_out_mm3", left_out_},
        {"seen",
         {{"volume_mm3", seen_.volume},
          {"misplaced_mm3", seen_.misplaced},
          {"wrong_mm3", seen_.wrong},
          {"hidden_mm3", seen_.hidden}}}}},
  };
}

std::string SlicedBooks::summary(const std::optional<Planning>&) const {
  const gcode::SlicedSurvey& survey = production_.prepared().survey;
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{} layers, sliced by {}, {} changes of tool\n", totals_.layers,
                 survey.slicer.empty() ? "an unknown slicer" : survey.slicer, survey.changes);
  fmt::format_to(out, "material:  {:.1f} mm³", totals_.volume);
  for (const MaterialVolume& material : totals_.materials)
    fmt::format_to(out, ", {} {:.1f}", material.name, material.part);
  if (const double left_out = left_out_; left_out > 0)
    fmt::format_to(out, "; {:.1f} of the wipe tower left out", left_out);
  fmt::format_to(out, "\nprinting:  about {} at {:.2f} mm³/s on average\n",
                 duration_words(totals_.print_seconds), flow());
  if (seen_.volume > 0) {
    fmt::format_to(out, "forecast:  {:.2f} % of the plastic that is seen has another tool's colour\n",
                   100 * seen_.wrong / seen_.volume);
  }
  return text;
}

/// Every bead has a speed of its own, so that no flow is held.
std::string SlicedBooks::summary(const MotionFindings& motion) const {
  const std::string text = host::summary(motion);
  return text.substr(0, text.find("flow: "));
}

std::string SlicedBooks::summary(const DepositFindings& laid) const {
  if (laid.area <= 0) return "";
  const double shown = laid.area - laid.transition;
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(
      out, "laid:      gaps {:.2f} %, overfill {:.2f} % of {:.0f} mm² of beads; {:.2f} mm³ beside them\n",
      100 * laid.gap_fraction(), 100 * laid.overfill_fraction(), laid.area, laid.outside);
  if (shown > 0) {
    fmt::format_to(out,
                   "mixtures:  {:.1f} mm² ({:.2f} %) of what is seen nearer to another tool's\n"
                   "           misplaced plastic {:.1f} mm² ({:.2f} %)\n",
                   laid.wrong, 100 * laid.wrong / shown, laid.mixture_error,
                   100 * laid.mixture_error / shown);
  }
  return text;
}

}  // namespace unicursal::host
