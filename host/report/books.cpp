#include "host/report/books.hpp"

#include "host/report/filament_use.hpp"
#include "host/report/peak_memory.hpp"
#include "host/report/summary.hpp"

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

}  // namespace

void forget_times(nlohmann::json& figures) {
  figures.erase("seconds");
  figures.erase("cpu_seconds");
}

Books::Books(const Job& job, std::string command, const RunOutputs& outputs)
    : job_(job), command_(std::move(command)), repeatable_(outputs.repeatable) {
  if (outputs.report) log_ = std::make_unique<LayerLog>(*outputs.report);
}

void Books::describe(std::size_t layer, nlohmann::json entry) {
  entries_[layer].json = std::move(entry);
}

void Books::log_finished_layers(bool all) {
  while (log_ && !entries_.empty()) {
    LayerEntry& entry = entries_.begin()->second;
    if (!all && !(entry.written && entry.mixing)) return;
    if (!entry.json.contains("layer")) entry.json["layer"] = entries_.begin()->first;
    entry.json["volume_mm3"] = entry.volume;
    entry.json["estimated_seconds"] = entry.seconds;
    if (entry.mixing) entry.json["mixing"] = to_json(*entry.mixing);
    log_->add(entry.json);
    entries_.erase(entries_.begin());
  }
}

void Books::count(const gcode::Chunk& chunk) {
  totals_.flow = flow();  // an automatic one is known when the first layer comes out of the encoder
  totals_.print_seconds += chunk.seconds;
  totals_.volume += chunk.volume;
  totals_.materials.at(chunk.prime_material).prime += chunk.prime_volume;
  for (const std::string& line : chunk.lines) totals_.lines += gcode::is_command(line) ? 1 : 0;
  for (const auto& [mixture, volume] : chunk.mixture_volumes) gcode::add(totals_.fed, mixture, volume);
  for (const auto& [mixture, volume] : chunk.aside_mixtures) gcode::add(totals_.aside, mixture, volume);
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

std::string Books::summary(const DepositFindings& laid) const {
  return host::summary(laid);
}

std::string Books::summary(const MotionFindings& motion) const {
  return host::summary(motion);
}

void Books::write_report(const nlohmann::json& extra) {
  end_pictures();
  if (!log_) return;
  nlohmann::json rest = {
      {"command", command_},
      {"job", job_.file.string()},
      {"profile", job_.profile.file.string()},
      {"printer", job_.profile.printer.name},
      {"flow_mm3_s", flow()},
      {"layer_count", totals_.layers},
      {"mixtures", to_json(totals_.materials)},
      {"mixing", to_json(totals_.mixing)},
      {"feeder_volumes_mm3", feeder_volumes(fed())},
      {"filament", used_filament_json(totals_, job_.profile)},
      {"extruded_mm3", totals_.volume},
      {"estimated_print_seconds", totals_.print_seconds},
      {"lines", totals_.lines},
  };
  if (!repeatable_) rest["peak_memory_mib"] = peak_memory();
  rest.update(more());
  rest.update(extra);
  log_->finish(rest);
}

}  // namespace unicursal::host
