#include "host/report/estimate.hpp"

#include <nlohmann/json.hpp>

#include "core/picture/hex_colour.hpp"
#include "core/stopping.hpp"
#include "host/lookahead/foretold_times.hpp"
#include "host/report/filament_use.hpp"

namespace unicursal::host {
namespace {

/// mm³ by feeder.
void add_volume(gcode::PerFeeder& sum, const gcode::Mixture& mixture, double volume) {
  for (std::size_t f = 0; f < sum.size(); ++f) sum[f] += volume * mixture.share(f);
}

std::vector<EstimatedFilament> filaments_of(const gcode::PerFeeder& volumes, const Profile& profile) {
  std::vector<EstimatedFilament> filaments;
  for (std::size_t f = 0; f < volumes.size(); ++f) {
    if (volumes[f] <= 0) continue;
    const Filament& filament = profile.filaments.of_feeders[f];
    filaments.push_back(
        {filament.name, picture::hex_of(filament.colour), amount_of(volumes[f], filament).grams});
  }
  return filaments;
}

}  // namespace

JobEstimate estimate_of(const PreparedJob& prepared) {
  const Job& job = prepared.job;
  const double flow = lookahead_options(prepared).flow;
  gcode::PerFeeder volumes = gcode::PerFeeder::zeros(job.profile.printer.feeders);
  double seconds = 0;
  for (std::size_t i = 0; i < prepared.count; ++i) {
    core::stop_point();
    const core::Layer layer = prepared.part->layer(prepared.first + i);
    seconds += foretold_seconds(layer, flow);
    for (const core::Island& island : layer.islands) {
      for (const core::ZoneRegion& region : island.zones) {
        const std::size_t material = prepared.part->zones().at(region.zone).material;
        add_volume(volumes, job.print.materials.at(material).mixture,
                   core::area(region.polygons) * layer.height);
      }
    }
  }
  JobEstimate estimate{std::nullopt, filaments_of(volumes, job.profile), prepared.count};
  if (flow > 0) estimate.seconds = seconds;
  return estimate;
}

JobEstimate estimate_of(const PreparedSliced& prepared) {
  const Job& job = prepared.job;
  gcode::PerFeeder volumes = gcode::PerFeeder::zeros(job.profile.printer.feeders);
  for (const gcode::SlicedTool& tool : prepared.survey.tools) {
    const auto material = job.sliced->tools.find(tool.number);
    if (material != job.sliced->tools.end())
      add_volume(volumes, job.print.materials.at(material->second).mixture, tool.volume);
  }
  return {prepared.survey.seconds, filaments_of(volumes, job.profile), prepared.survey.layers};
}

nlohmann::json to_json(const JobEstimate& estimate) {
  nlohmann::json grams = nlohmann::json::array();
  for (const EstimatedFilament& one : estimate.filaments)
    grams.push_back({{"name", one.name}, {"colour", one.colour}, {"grams", one.grams}});
  nlohmann::json object = {{"grams", grams}, {"layer_count", estimate.layers}};
  if (estimate.seconds) object["seconds"] = *estimate.seconds;
  return object;
}

}  // namespace unicursal::host
