#include "host/report/motion_findings.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace unicursal::host {
namespace {

using Bins = std::vector<std::pair<double, double>>;  // flow, seconds; by rising flow

double number(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<double>() : 0;
}

std::uint64_t count(const nlohmann::json& object, const char* key) {
  return static_cast<std::uint64_t>(std::max(0.0, number(object, key)));
}

Bins bins(const nlohmann::json& object, const char* key) {
  Bins result;
  for (const auto& entry : object.value(key, nlohmann::json::array())) {
    if (entry.is_array() && entry.size() == 2 && entry[0].is_number() && entry[1].is_number())
      result.emplace_back(entry[0].get<double>(), entry[1].get<double>());
  }
  return result;
}

double all_seconds(const Bins& bins) {
  double sum = 0;
  for (const auto& [flow, time] : bins) sum += time;
  return sum;
}

double share_near(const Bins& bins, double nominal) {
  double near = 0;
  for (const auto& [flow, time] : bins) {
    if (std::abs(flow - nominal) <= MotionFindings::tolerance * nominal) near += time;
  }
  const double all = all_seconds(bins);
  return all > 0 ? near / all : 0;
}

/// The flow below which this fraction of the time lies.
double quantile(const Bins& bins, double share) {
  double left = share * all_seconds(bins);
  for (const auto& [flow, time] : bins) {
    left -= time;
    if (left < 0) return flow;
  }
  return 0;
}

double holdable(const Bins& by_second, double nominal) {
  const double lacking = 1 - quantile(by_second, 1 - MotionFindings::hold_share) / nominal;
  return lacking > MotionFindings::tolerance ? nominal * std::cbrt(MotionFindings::tolerance / lacking)
                                             : nominal;
}

double mean(const Bins& bins) {
  double volume = 0;
  for (const auto& [flow, time] : bins) volume += flow * time;
  const double all = all_seconds(bins);
  return all > 0 ? volume / all : 0;
}

}  // namespace

MotionFindings motion_findings(const nlohmann::json& simulator, double nominal_flow) {
  MotionFindings f;
  const nlohmann::json motion = simulator.value("motion", nlohmann::json::object());
  const Bins instants = bins(motion, "flow_seconds"), by_second = bins(motion, "flow_by_second");
  f.nominal_flow = nominal_flow;
  f.bead_seconds = number(motion, "bead_seconds");
  f.mean_speed = number(motion, "mean_speed");
  f.seconds_in_tolerance = share_near(by_second, nominal_flow);
  f.instants_in_tolerance = share_near(instants, nominal_flow);
  f.mean_flow = mean(instants);
  f.holdable_flow = holdable(by_second, nominal_flow);
  f.starvations = count(motion, "starvations");
  f.hasty_stops = count(motion, "hasty_stops");
  f.stopped_seconds = number(motion, "stopped_seconds");
  for (const auto& layer : simulator.value("layers", nlohmann::json::array())) {
    f.travels += count(layer, "travels");
    f.travel += number(layer, "travel_mm");
  }
  return f;
}

nlohmann::json to_json(const MotionFindings& f) {
  return {{"nominal_flow", f.nominal_flow},
          {"mean_flow", f.mean_flow},
          {"bead_seconds", f.bead_seconds},
          {"mean_speed", f.mean_speed},
          {"seconds_within_5_percent", f.seconds_in_tolerance},
          {"instants_within_5_percent", f.instants_in_tolerance},
          {"holdable_flow", f.holdable_flow},
          {"starvations", f.starvations},
          {"hasty_stops", f.hasty_stops},
          {"stopped_seconds", f.stopped_seconds},
          {"travels", f.travels},
          {"travel_mm", f.travel}};
}

}  // namespace unicursal::host
