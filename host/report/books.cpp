#include "host/report/books.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/model/hanging.hpp"
#include "core/model/read_part.hpp"
#include "host/report/peak_memory.hpp"
#include "host/report/target.hpp"

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

/// Removes planning times, which differ from run to run.
void forget_times(nlohmann::json& figures) {
  figures.erase("seconds");
  figures.erase("cpu_seconds");
}

nlohmann::json to_json(const std::vector<core::HangingPlace>& places) {
  nlohmann::json list = nlohmann::json::array();
  for (const core::HangingPlace& place : places) {
    nlohmann::json entry = {
        {"kind", word(place.kind)}, {"layer", place.layer}, {"layers", place.layers}, {"z_mm", place.z}};
    if (place.kind != core::HangingPlace::Kind::empty_layers)
      entry.update({{"x_mm", place.place.x()}, {"y_mm", place.place.y()}, {"area_mm2", place.area}});
    list.push_back(std::move(entry));
  }
  return list;
}

/// Slices the layers of the print once more, which takes little beside their planning.
std::vector<core::HangingPlace> places_in_the_air(const PreparedJob& prepared) {
  if (!is_plate(prepared.job) && core::is_drawing_file(prepared.job.source.files.front()))
    return {};  // all layers are alike
  core::HangingCheck check(prepared.job.bead_width);
  for (std::size_t i = 0; i < prepared.count; ++i) check.add(prepared.part->layer(prepared.first + i));
  return check.places();
}

}  // namespace

struct LayerEntry {
  nlohmann::json json;
  double volume = 0, seconds = 0;
  bool written = false;  ///< all its lines are in chunks
  std::optional<gcode::LayerMixing> mixing;
};

Books::Books(ChunkMaker& maker, std::string command, const RunOutputs& outputs)
    : maker_(maker), command_(std::move(command)), repeatable_(outputs.repeatable) {
  const PreparedJob& prepared = maker.prepared();
  if (outputs.report) log_ = std::make_unique<LayerLog>(*outputs.report);
  if (outputs.pictures) pictures_ = std::make_unique<PictureWriter>(*outputs.pictures, curve_style(prepared));
  const std::vector<gcode::Material>& materials = prepared.job.print.materials;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    totals_.materials.push_back({materials[i].name, materials[i].mixture, maker.encoder().intended(i)});
  }
  count(maker.start());
  maker.listen(this);
}

Books::~Books() {
  maker_.listen(nullptr);
}

void Books::layer_made(PlannedLayer planned, const gcode::PlacedLayer& placed, const gcode::Chunk& chunk) {
  ++totals_.layers;
  add_layer(totals_.materials, placed, maker_.prepared().frame.zone_materials);
  totals_.figures += measure(planned);
  if (planned.effort < 1) ++totals_.hurried_layers;
  totals_.least_effort = std::min(totals_.least_effort, planned.effort);
  if (check_ != nullptr) check_->expect(target_of(maker_.prepared(), planned, placed));
  if (log_) {
    nlohmann::json entry = layer_entry(planned, placed);
    if (repeatable_) forget_times(entry);
    entries_[placed.index].json = std::move(entry);
  }
  if (pictures_) pictures_->draw(std::move(planned));
  count(chunk);
  log_finished_layers(false);
}

void Books::end_made(const gcode::Chunk& chunk) {
  count(chunk);
  log_finished_layers(true);
}

/// Logs complete layers in order; with `all`, after a stop, also incomplete ones.
void Books::log_finished_layers(bool all) {
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

void Books::count(const gcode::Chunk& chunk) {
  totals_.flow = maker_.flow();  // an automatic one is known when the first layer comes out of the encoder
  totals_.print_seconds += chunk.seconds;
  totals_.volume += chunk.volume;
  totals_.materials.at(chunk.prime_material).prime += chunk.prime_volume;
  for (const std::string& line : chunk.lines) totals_.lines += gcode::is_command(line) ? 1 : 0;
  for (const auto& [mixture, volume] : chunk.mixture_volumes) gcode::add(totals_.fed, mixture, volume);
  for (const gcode::LayerMixing& mixing : chunk.mixing) totals_.mixing += mixing;
  if (log_) count_layers(chunk);
}

void Books::count_layers(const gcode::Chunk& chunk) {
  for (const gcode::LayerShare& share : chunk.layers) {
    LayerEntry& entry = entries_[share.layer];
    entry.volume += share.volume;
    entry.seconds += share.seconds;
    entry.written = entry.written || share.last;
  }
  for (const gcode::LayerMixing& mixing : chunk.mixing) entries_[mixing.layer].mixing = mixing;
}

std::vector<MaterialVolume> Books::fed() const {
  return fed_volumes(totals_.fed, totals_.materials);
}

std::vector<std::string> Books::warnings() const {
  if (pictures_ && pictures_->problem()) return {*pictures_->problem()};
  return {};
}

void Books::write_report(const nlohmann::json& extra) {
  if (pictures_) pictures_->finish();
  if (!log_) return;
  nlohmann::json rest = {
      {"command", command_},
      {"job", maker_.prepared().job.file.string()},
      {"profile", maker_.prepared().job.profile.file.string()},
      {"printer", maker_.prepared().job.profile.printer.name},
      {"warnings", maker_.warnings()},
      {"bare", maker_.bare().to_json()},
      {"in_the_air", to_json(places_in_the_air(maker_.prepared()))},
      {"bead_width_mm", maker_.prepared().job.bead_width},
      {"flow_mm3_s", maker_.flow()},
      {"layer_height_mm", maker_.prepared().job.source.layer_height},
      {"layer_count", totals_.layers},
      {"totals", to_json(totals_.figures)},
      {"mixtures", to_json(totals_.materials)},
      {"mixing", to_json(totals_.mixing)},
      {"feeder_volumes_mm3", feeder_volumes(fed())},
      {"extruded_mm3", totals_.volume},
      {"estimated_print_seconds", totals_.print_seconds},
      {"estimated_laying_seconds", maker_.encoder().laying_seconds()},
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

}  // namespace unicursal::host
