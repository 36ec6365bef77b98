#include "host/report/volumes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>

namespace unicursal::host {
namespace {

using gcode::PerFeeder;
using gcode::Shares;

/// Mixtures closer than this in every share are the same to the printer.
constexpr double same_mixture = 1e-4;

double difference(const Shares& a, const Shares& b) {
  double greatest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) greatest = std::max(greatest, std::abs(a[i] - b[i]));
  return greatest;
}

/// Numbers of a list in a report; missing ones are zero.
PerFeeder numbers(const nlohmann::json& entry, const char* key, std::size_t feeders) {
  PerFeeder result = PerFeeder::zeros(feeders);
  const auto list = entry.find(key);
  if (list == entry.end() || !list->is_array()) return result;
  for (std::size_t i = 0; i < std::min(result.size(), list->size()); ++i) {
    if ((*list)[i].is_number()) result[i] = (*list)[i].get<double>();
  }
  return result;
}

std::int64_t count(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<std::int64_t>() : 0;
}

/// One mixture, as far as the printer can distinguish them.
struct Row {
  Comparison::Mixture mixture;
  Shares shares;
  PerFeeder fed;  ///< mm³
};

std::vector<Row> rows_of(const std::vector<MaterialVolume>& volumes) {
  std::vector<Row> rows;
  for (const MaterialVolume& volume : volumes) {
    const Shares& shares = volume.intended.shares();
    auto row = std::find_if(rows.begin(), rows.end(),
                            [&](const Row& r) { return difference(r.shares, shares) < same_mixture; });
    if (row == rows.end())
      row = rows.insert(rows.end(), Row{{volume.name}, shares, PerFeeder::zeros(shares.size())});
    else
      row->mixture.name += " + " + volume.name;
    row->mixture.intended += volume.total();
  }
  return rows;
}

void add_steps(std::vector<Row>& rows, const nlohmann::json& entry, const PerFeeder& volume_per_step) {
  const std::size_t feeders = volume_per_step.size();
  const Shares shares = numbers(entry, "shares", feeders);
  const PerFeeder steps = numbers(entry, "feeder_steps", feeders);
  const auto row = std::min_element(rows.begin(), rows.end(), [&](const Row& a, const Row& b) {
    return difference(a.shares, shares) < difference(b.shares, shares);
  });
  if (row == rows.end()) return;
  for (std::size_t f = 0; f < steps.size(); ++f) row->fed[f] += steps[f] * volume_per_step[f];
}

double relative_error(double is, double should) {
  if (should > 0) return is / should - 1;
  return is > 0 ? std::numeric_limits<double>::infinity() : 0;
}

Comparison::Mixture judged(const Row& row) {
  Comparison::Mixture mixture = row.mixture;
  for (double volume : row.fed) mixture.fed += volume;
  mixture.relative_error = relative_error(mixture.fed, mixture.intended);
  mixture.feeder_error = PerFeeder::zeros(row.fed.size());
  for (std::size_t f = 0; f < row.fed.size(); ++f) {
    mixture.feeder_error[f] = relative_error(row.fed[f], row.shares[f] * mixture.intended);
  }
  return mixture;
}

double worst_of(const Comparison::Mixture& mixture) {
  double worst = std::abs(mixture.relative_error);
  for (double error : mixture.feeder_error) worst = std::max(worst, std::abs(error));
  return worst;
}

double worst_in_between(const std::vector<Row>& rows) {
  double intended = 0;
  PerFeeder lacks = rows.empty() ? PerFeeder() : PerFeeder::zeros(rows.front().fed.size());  // mm³
  for (const Row& row : rows) {
    if (row.mixture.name != mixed_between) continue;
    intended += row.mixture.intended;
    for (std::size_t f = 0; f < lacks.size(); ++f)
      lacks[f] += row.shares[f] * row.mixture.intended - row.fed[f];
  }
  double worst = std::abs(std::accumulate(lacks.begin(), lacks.end(), 0.0));
  for (const double lack : lacks) worst = std::max(worst, std::abs(lack));
  return intended > 0 ? worst / intended : 0;
}

/// JSON cannot hold infinity.
nlohmann::json finite(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

}  // namespace

void add_layer(std::vector<MaterialVolume>& volumes, const gcode::PlacedLayer& layer,
               const std::vector<std::size_t>& zone_materials) {
  for (const core::BeadPath& path : layer.paths) {
    for (const core::Bead& bead : path.beads) {
      volumes.at(zone_materials.at(bead.zone)).part += bead.area * layer.height;
    }
  }
}

std::vector<MaterialVolume> fed_volumes(const std::vector<gcode::MixtureVolume>& fed,
                                        const std::vector<MaterialVolume>& materials) {
  std::vector<MaterialVolume> volumes;
  for (const auto& [mixture, volume] : fed) {
    const auto material = std::find_if(materials.begin(), materials.end(), [&](const MaterialVolume& m) {
      return difference(m.intended.shares(), mixture.shares()) < same_mixture;
    });
    const std::string name = material == materials.end() ? mixed_between : material->name;
    volumes.push_back({name, mixture, mixture, volume, 0});
  }
  return volumes;
}

PerFeeder feeder_volumes(const std::vector<MaterialVolume>& volumes) {
  if (volumes.empty()) return {};
  PerFeeder sum = PerFeeder::zeros(volumes.front().intended.feeders());
  for (const MaterialVolume& volume : volumes) {
    for (std::size_t f = 0; f < sum.size(); ++f) sum[f] += volume.total() * volume.intended.share(f);
  }
  return sum;
}

nlohmann::json to_json(const std::vector<MaterialVolume>& volumes) {
  nlohmann::json list = nlohmann::json::array();
  for (const MaterialVolume& volume : volumes) {
    list.push_back({{"name", volume.name},
                    {"asked", volume.asked.shares()},
                    {"intended", volume.intended.shares()},
                    {"part_mm3", volume.part},
                    {"prime_mm3", volume.prime}});
  }
  return list;
}

Comparison compare(const std::vector<MaterialVolume>& volumes, const nlohmann::json& simulator,
                   const Fed& fed) {
  const double radius = fed.filament_diameter / 2;
  PerFeeder volume_per_step = PerFeeder::zeros(fed.flow_factors.size());
  for (std::size_t f = 0; f < volume_per_step.size(); ++f) {
    volume_per_step[f] = std::numbers::pi * radius * radius / (fed.feeder_steps_per_mm * fed.flow_factors[f]);
  }
  std::vector<Row> rows = rows_of(volumes);
  for (const nlohmann::json& entry : simulator.value("mixtures", nlohmann::json::array())) {
    add_steps(rows, entry, volume_per_step);
  }
  Comparison comparison;
  for (const Row& row : rows) {
    comparison.mixtures.push_back(judged(row));
    if (row.mixture.name == mixed_between) continue;
    comparison.worst_error = std::max(comparison.worst_error, worst_of(comparison.mixtures.back()));
  }
  comparison.worst_error = std::max(comparison.worst_error, worst_in_between(rows));
  const nlohmann::json lines = simulator.value("lines", nlohmann::json::object());
  // Lines are numbered from 1 behind an M110 numbered 0; a number that is accepted twice counts twice.
  const std::int64_t last = count(simulator, "last_line");
  comparison.lines_lost = std::max<std::int64_t>(0, static_cast<std::int64_t>(fed.lines_sent) - last);
  comparison.lines_twice = std::max<std::int64_t>(0, count(lines, "accepted") - 1 - last);
  comparison.in_order = simulator.value("executed_lines_in_order", false);
  return comparison;
}

nlohmann::json to_json(const Comparison& comparison) {
  nlohmann::json mixtures = nlohmann::json::array();
  for (const Comparison::Mixture& mixture : comparison.mixtures) {
    nlohmann::json feeders = nlohmann::json::array();
    for (double error : mixture.feeder_error) feeders.push_back(finite(error));
    mixtures.push_back({{"name", mixture.name},
                        {"intended_mm3", mixture.intended},
                        {"fed_mm3", mixture.fed},
                        {"relative_error", finite(mixture.relative_error)},
                        {"feeder_relative_error", feeders}});
  }
  return {{"mixtures", mixtures},
          {"worst_relative_error", finite(comparison.worst_error)},
          {"lines_lost", comparison.lines_lost},
          {"lines_twice", comparison.lines_twice},
          {"lines_in_order", comparison.in_order}};
}

}  // namespace unicursal::host
