#include "host/engine/run.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "firmware_gcode/toolpath/prime_line.hpp"
#include "firmware_gcode/toolpath/skirt.hpp"

namespace unicursal::host {
namespace {

nlohmann::json to_json(const gcode::LayerMixing& mixing) {
  nlohmann::json entry = {{"changes", mixing.changes},         {"switches", mixing.switches},
                          {"passed_over", mixing.passed_over}, {"passed_over_mm3", mixing.passed_over_volume},
                          {"misplaced_mm3", mixing.misplaced}, {"wrong_mm3", mixing.wrong}};
  if (mixing.crossings > 0) {
    entry["transition_crossings"] = mixing.crossings;
    entry["short_transition_crossings"] = mixing.short_crossings;
    entry["shortest_transition_crossing_mm3"] = mixing.shortest_crossing;
  }
  return entry;
}

nlohmann::json layer_entry(const PlannedLayer& planned, const gcode::PlacedLayer& layer) {
  nlohmann::json entry = to_json(measure(planned));
  entry["layer"] = planned.layer.index;
  entry["top_mm"] = layer.top;
  entry["height_mm"] = layer.height;
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

struct LayerEntry {
  nlohmann::json json;
  double volume = 0, seconds = 0;
  bool written = false;  ///< all its lines are in chunks
  std::optional<gcode::LayerMixing> mixing;
};

Run::~Run() = default;

Run::Run(const PreparedJob& prepared, std::string command, const RunOutputs& outputs)
    : prepared_(prepared),
      command_(std::move(command)),
      repeatable_(outputs.repeatable),
      encoder_(prepared.job.profile.printer, print_settings(prepared)),
      start_(encoder_.start()) {
  if (outputs.report) log_ = std::make_unique<LayerLog>(*outputs.report);
  if (outputs.pictures) pictures_ = std::make_unique<PictureWriter>(*outputs.pictures, curve_style(prepared));
  const std::vector<gcode::Material>& materials = prepared.job.print.materials;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    totals_.materials.push_back({materials[i].name, materials[i].mixture, encoder_.intended(i)});
  }
  count(start_);
}

gcode::Chunk Run::layer(PlannedLayer planned) {
  const gcode::PlacedLayer layer = placed(prepared_, planned);
  gcode::Chunk chunk = encoded(layer);
  totals_.figures += measure(planned);
  if (planned.effort < 1) ++totals_.hurried_layers;
  totals_.least_effort = std::min(totals_.least_effort, planned.effort);
  if (check_ != nullptr) check_->expect(target_of(prepared_, planned));
  if (log_) {
    nlohmann::json entry = layer_entry(planned, layer);
    if (repeatable_) forget_times(entry);
    entries_[layer.index].json = std::move(entry);
  }
  if (pictures_) pictures_->draw(std::move(planned));
  count(chunk);
  log_finished_layers(false);
  return chunk;
}

gcode::Chunk Run::replay(const gcode::PlacedLayer& layer) {
  gcode::Chunk chunk = encoded(layer);
  count(chunk);
  return chunk;
}

gcode::Chunk Run::encoded(const gcode::PlacedLayer& layer) {
  gcode::Chunk chunk = encoder_.layer(layer);
  ++totals_.layers;
  add_layer(totals_.materials, layer, prepared_.frame.zone_materials);
  return chunk;
}

gcode::Chunk Run::rest() {
  gcode::Chunk chunk = encoder_.rest();
  count(chunk);
  log_finished_layers(true);
  return chunk;
}

gcode::Chunk Run::finish() {
  gcode::Chunk chunk = encoder_.finish();
  count(chunk);
  log_finished_layers(true);
  return chunk;
}

double Run::flow() const {
  const Job& job = prepared_.job;
  return job.print.speed ? *job.print.speed * job.bead_width * job.source.layer_height : encoder_.flow();
}

/// In order; after a stop those that were not printed to their end as well.
void Run::log_finished_layers(bool all) {
  while (log_ && !entries_.empty()) {
    LayerEntry& entry = entries_.begin()->second;
    if (!all && !(entry.written && entry.mixing)) return;
    entry.json["volume_mm3"] = entry.volume;
    entry.json["estimated_seconds"] = entry.seconds;
    if (entry.mixing) entry.json["mixing"] = to_json(*entry.mixing);
    log_->add(entry.json);
    entries_.erase(entries_.begin());
  }
}

void Run::count(const gcode::Chunk& chunk) {
  totals_.flow = flow();  // an automatic one is known when the first layer comes out of the encoder
  totals_.print_seconds += chunk.seconds;
  totals_.volume += chunk.volume;
  totals_.materials.at(chunk.prime_material).prime += chunk.prime_volume;
  for (const std::string& line : chunk.lines) totals_.lines += gcode::is_command(line) ? 1 : 0;
  for (const auto& [mixture, volume] : chunk.mixture_volumes) gcode::add(totals_.fed, mixture, volume);
  for (const gcode::LayerMixing& mixing : chunk.mixing) totals_.mixing += mixing;
  encoding_warnings_.insert(encoding_warnings_.end(), chunk.warnings.begin(), chunk.warnings.end());
  if (log_) count_layers(chunk);
}

void Run::count_layers(const gcode::Chunk& chunk) {
  for (const gcode::LayerShare& share : chunk.layers) {
    LayerEntry& entry = entries_[share.layer];
    entry.volume += share.volume;
    entry.seconds += share.seconds;
    entry.written = entry.written || share.last;
  }
  for (const gcode::LayerMixing& mixing : chunk.mixing) entries_[mixing.layer].mixing = mixing;
}

std::vector<MaterialVolume> Run::fed() const {
  return fed_volumes(totals_.fed, totals_.materials);
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
      {"flow_mm3_s", flow()},
      {"layer_height_mm", prepared_.job.source.layer_height},
      {"layer_count", totals_.layers},
      {"totals", to_json(totals_.figures)},
      {"mixtures", to_json(totals_.materials)},
      {"mixing", to_json(totals_.mixing)},
      {"feeder_volumes_mm3", feeder_volumes(fed())},
      {"extruded_mm3", totals_.volume},
      {"estimated_print_seconds", totals_.print_seconds},
      {"estimated_laying_seconds", encoder_.laying_seconds()},
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

namespace {

/// Where the skirt and the prime line are to lie.
void add_aside(TargetLayer& target, const PreparedJob& prepared, const PlannedLayer& planned) {
  const gcode::Printer& printer = prepared.job.profile.printer;
  core::Box kept_clear = prepared.frame.extent;
  const double reach = gcode::skirt_reach(prepared.job.print.skirt, printer);
  kept_clear.min -= core::Vec2(reach, reach);
  kept_clear.max += core::Vec2(reach, reach);
  if (const auto line = gcode::prime_line(printer, kept_clear, target.height)) {
    target.prime.push_back({line->from, line->to, line->width});
  }
  for (const core::BeadPath& ring :
       gcode::skirt(placed(prepared, planned), prepared.job.print.skirt, printer)) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      target.skirt.push_back({ring.start(i), ring.end(i), ring.width(i)});
    }
  }
}

}  // namespace

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
  target.bead_width = prepared.job.bead_width;
  if (planned.layer.index == prepared.first) add_aside(target, prepared, planned);
  return target;
}

std::vector<IntendedMaterial> intended_materials(const PreparedJob& prepared, const gcode::Encoder& encoder) {
  std::vector<IntendedMaterial> intended;
  for (std::size_t i = 0; i < prepared.job.print.materials.size(); ++i) {
    IntendedMaterial material(encoder.intended(i));
    material.gradient = prepared.job.print.materials[i].gradient;
    if (material.gradient) material.gradient->to = encoder.intended(i, 1);
    material.transition = prepared.job.print.materials[i].transition;
    intended.push_back(std::move(material));
  }
  return intended;
}

CurveStyle curve_style(const PreparedJob& prepared) {
  CurveStyle style;
  style.extent = prepared.part->extent();
  for (const core::Zone& zone : prepared.part->zones()) {
    style.zone_colours.push_back(colour_of(prepared.job.print.materials.at(zone.material).mixture));
  }
  style.bead_width = prepared.job.bead_width;
  return style;
}

}  // namespace unicursal::host
