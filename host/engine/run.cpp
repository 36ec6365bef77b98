#include "host/engine/run.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace unicursal::host {
namespace {

nlohmann::json layer_entry(const PlannedLayer& planned, const gcode::PlacedLayer& layer,
                           const gcode::Chunk& chunk) {
  nlohmann::json entry = to_json(measure(planned));
  entry["layer"] = planned.layer.index;
  entry["top_mm"] = layer.top;
  entry["height_mm"] = layer.height;
  entry["volume_mm3"] = chunk.volume;
  entry["estimated_seconds"] = chunk.seconds;
  if (planned.effort < 1) entry["effort"] = planned.effort;
  return entry;
}

void move(core::Polygon& polygon, const core::Vec2& offset) {
  for (core::Vec2& vertex : polygon.outer) vertex += offset;
  for (core::Ring& hole : polygon.holes) {
    for (core::Vec2& vertex : hole) vertex += offset;
  }
}

/// What planning took on this computer, which is another time at every run.
void forget_times(nlohmann::json& figures) {
  figures.erase("seconds");
  figures.erase("cpu_seconds");
}

}  // namespace

Run::Run(const PreparedJob& prepared, std::string command, const RunOutputs& outputs)
    : prepared_(prepared),
      command_(std::move(command)),
      repeatable_(outputs.repeatable),
      zone_materials_(print_settings(prepared).zone_materials),
      encoder_(prepared.job.profile.printer, print_settings(prepared)),
      start_(encoder_.start()) {
  if (outputs.report) log_ = std::make_unique<LayerLog>(*outputs.report);
  if (outputs.pictures) pictures_ = std::make_unique<PictureWriter>(*outputs.pictures, curve_style(prepared));
  const std::vector<gcode::Material>& materials = prepared.job.materials;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    totals_.materials.push_back({materials[i].name, materials[i].mixture, encoder_.intended(i)});
  }
  count(start_);
}

gcode::Chunk Run::layer(PlannedLayer planned) {
  const gcode::PlacedLayer layer = placed(prepared_, planned);
  gcode::Chunk chunk = replay(layer);
  totals_.figures += measure(planned);
  if (planned.effort < 1) ++totals_.hurried_layers;
  totals_.least_effort = std::min(totals_.least_effort, planned.effort);
  if (check_ != nullptr) check_->expect(target_of(prepared_, planned));
  if (log_) {
    nlohmann::json entry = layer_entry(planned, layer, chunk);
    if (repeatable_) forget_times(entry);
    log_->add(entry);
  }
  if (pictures_) pictures_->draw(std::move(planned));
  return chunk;
}

gcode::Chunk Run::replay(const gcode::PlacedLayer& layer) {
  gcode::Chunk chunk = encoder_.layer(layer);
  count(chunk);
  ++totals_.layers;
  add_layer(totals_.materials, layer, zone_materials_);
  add_prime(totals_.materials, chunk);
  return chunk;
}

gcode::Chunk Run::finish() {
  gcode::Chunk chunk = encoder_.finish();
  count(chunk);
  return chunk;
}

void Run::count(const gcode::Chunk& chunk) {
  totals_.print_seconds += chunk.seconds;
  totals_.volume += chunk.volume;
  for (const std::string& line : chunk.lines) totals_.lines += is_command(line) ? 1 : 0;
  encoding_warnings_.insert(encoding_warnings_.end(), chunk.warnings.begin(), chunk.warnings.end());
}

std::vector<std::string> Run::warnings() const {
  std::vector<std::string> warnings = prepared_.job.warnings;
  const std::vector<std::string>& reading = prepared_.part->warnings();
  warnings.insert(warnings.end(), reading.begin(), reading.end());
  warnings.insert(warnings.end(), encoding_warnings_.begin(), encoding_warnings_.end());
  if (pictures_ && pictures_->problem()) warnings.push_back(*pictures_->problem());
  return warnings;
}

void Run::write_report(const nlohmann::json& extra) {
  if (pictures_) pictures_->finish();
  if (!log_) return;
  nlohmann::json rest = {
      {"command", command_},
      {"job", prepared_.job.file.string()},
      {"profile", prepared_.job.profile.file.string()},
      {"printer", prepared_.job.profile.printer.name},
      {"warnings", warnings()},
      {"bead_width_mm", prepared_.job.bead_width},
      {"layer_height_mm", prepared_.job.source.layer_height},
      {"layer_count", totals_.layers},
      {"totals", to_json(totals_.figures)},
      {"mixtures", to_json(totals_.materials)},
      {"feeder_volumes_mm3", feeder_volumes(totals_.materials)},
      {"extruded_mm3", totals_.volume},
      {"estimated_print_seconds", totals_.print_seconds},
      {"lines", totals_.lines},
      {"effort", {{"hurried_layers", totals_.hurried_layers}, {"least", totals_.least_effort}}},
  };
  if (repeatable_) {
    forget_times(rest["totals"]);
  } else {
    rest["peak_memory_mib"] = peak_memory();
  }
  rest.update(extra);
  log_->finish(rest);
}

bool is_command(const std::string& line) {
  return !line.empty() && line.front() != ';';
}

double peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("VmHWM:", 0) != 0) continue;
    double kib = 0;
    std::istringstream(line.substr(6)) >> kib;
    return kib / 1024;
  }
  return 0;
}

TargetLayer target_of(const PreparedJob& prepared, const PlannedLayer& planned) {
  TargetLayer target;
  target.index = planned.layer.index;
  target.top = planned.layer.top - prepared.lowered;
  target.height = planned.layer.height;
  for (const core::Island& island : planned.layer.islands) {
    for (const core::ZoneRegion& region : island.zones) {
      const auto label = static_cast<RegionLabel>(prepared.part->zones().at(region.zone).material);
      for (core::Polygon polygon : region.polygons) {
        move(polygon, prepared.offset);
        target.zones.push_back({std::move(polygon), label});
      }
    }
  }
  return target;
}

std::vector<gcode::Mixture> intended_mixtures(const Run& run) {
  std::vector<gcode::Mixture> mixtures;
  for (const MaterialVolume& material : run.totals().materials) mixtures.push_back(material.intended);
  return mixtures;
}

CurveStyle curve_style(const PreparedJob& prepared) {
  CurveStyle style;
  style.extent = prepared.part->extent();
  for (const core::Zone& zone : prepared.part->zones()) {
    style.zone_colours.push_back(colour_of(prepared.job.materials.at(zone.material).mixture));
  }
  style.bead_width = prepared.job.bead_width;
  return style;
}

}  // namespace unicursal::host
