#include "sim/report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace unicursal::sim {

namespace {

using nlohmann::json;

template <class T>
json first_of(const PerFeeder<T>& values, std::size_t feeders) {
  return json(std::vector<T>(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(feeders)));
}

json lines(const Firmware& firmware) {
  const LineCounts& counts = firmware.counts();
  return {{"received", counts.received},
          {"accepted", counts.accepted},
          {"executed", counts.executed},
          {"checksum_errors", counts.checksum_errors},
          {"number_errors", counts.number_errors},
          {"resends", counts.resends},
          {"repeated", counts.repeated},
          {"skipped", counts.skipped},
          {"unseen_damage", counts.unseen_damage},
          {"disguised", counts.disguised},
          {"bytes_while_booting", counts.while_booting},
          {"lost_bytes", firmware.buffer().lost()},
          {"flushed_bytes", firmware.buffer().flushed()},
          {"too_long", firmware.assembler().too_long()},
          {"unknown", counts.unknown}};
}

json feeders(const Machine& machine, const Planner& planner) {
  json all = json::array();
  for (std::size_t i = 0; i < machine.feeders; ++i) {
    const std::int64_t steps = planner.feeder_steps()[i];
    all.push_back(
        {{"steps", steps}, {"mm", static_cast<double>(steps) / planner.limits().steps_per_mm[axis_e]}});
  }
  return all;
}

json mixtures(const Machine& machine, const FeedLog& feed) {
  json all = json::array();
  for (const MixtureUse& use : feed.mixtures()) {
    all.push_back({{"tool", use.mix.tool},
                   {"factors", first_of(use.mix.factors, machine.feeders)},
                   {"shares", first_of(shares_of(use.mix.factors), machine.feeders)},
                   {"extruded_mm", use.extruded},
                   {"feeder_steps", first_of(use.feeder_steps, machine.feeders)}});
  }
  return all;
}

json layers(const Deposit& deposit) {
  json all = json::array();
  for (const DepositedLayer& layer : deposit.layers()) {
    all.push_back({{"z", layer.z},
                   {"height", layer.height},
                   {"beads", layer.beads},
                   {"length_mm", layer.length},
                   {"seconds", layer.seconds},
                   {"volume_mm3", layer.volume},
                   {"travel_mm", layer.travel},
                   {"travels", layer.travels}});
  }
  return all;
}

json extents(const Extents& box) {
  if (box.empty()) return nullptr;
  return {{"min", {box.min_x, box.min_y, box.min_z}}, {"max", {box.max_x, box.max_y, box.max_z}}};
}

json struck(const Strikes& strikes) {
  json result = {{"by_nozzle", strikes.by_nozzle()}, {"by_head", strikes.by_head()}};
  if (const auto& at = strikes.first()) result["first"] = {at->x, at->y, at->z};
  return result;
}

json heater(const Heater& heater, double now) {
  return {{"actual", heater.temperature(now)}, {"target", heater.target()}};
}

json screen(const PrinterScreen& screen) {
  json all{{"text", screen.text}, {"texts", screen.texts}};
  if (screen.percent) all["percent"] = *screen.percent;
  if (screen.minutes_left) all["minutes_left"] = *screen.minutes_left;
  return all;
}

json warnings(const Firmware& firmware) {
  json all = json::array();
  for (const auto& [what, times] : firmware.warnings()) {
    all.push_back(fmt::format("{} ({} {})", what, times, times == 1 ? "time" : "times"));
  }
  return all;
}

json flows(const std::map<double, double>& seconds_by_flow) {
  json all = json::array();
  for (const auto& [flow, seconds] : seconds_by_flow) all.push_back({flow, seconds});
  return all;
}

json motion(const MotionLog& log) {
  json starvations = json::array();
  for (const Starvation& s : log.starvations()) {
    starvations.push_back({{"time", s.time},
                           {"place", {s.place.x, s.place.y, s.place.z}},
                           {"seconds", s.seconds},
                           {"dry", s.dry}});
  }
  return {{"bead_seconds", log.seconds()},
          {"mean_speed", log.mean_speed()},
          {"starvations", log.dry()},
          {"hasty_stops", log.hasty()},
          {"stopped_seconds", log.dry_seconds()},
          {"stops", starvations},
          {"queue_seconds", log.fill()},
          {"flow_seconds", flows(log.flows())},
          {"flow_by_second", flows(log.second_flows())}};
}

json chamber(const Machine& machine, const Outcome& outcome) {
  return {{"fed_mm3", first_of(outcome.nozzle.fed(), machine.feeders)},
          {"deposited_mm3", first_of(outcome.deposit.by_feeder(), machine.feeders)},
          {"content_mm3", first_of(outcome.nozzle.chamber().content(), machine.feeders)}};
}

json place(const PicturePlace& pictures) {
  return {{"left_mm", pictures.left}, {"top_mm", pictures.top}, {"pixel_mm", pictures.pixel}};
}

}  // namespace

std::string report_json(const Machine& machine, const Printer& printer, const Outcome& outcome) {
  const Firmware& firmware = printer.firmware();
  const FeedLog& feed = outcome.feed;
  const Deposit& deposit = outcome.deposit;
  const Coordinates& coordinates = firmware.coordinates();
  json report{{"lines", lines(firmware)},
              {"executed_lines_in_order", firmware.counts().executed_in_order},
              {"last_line", firmware.last_line()},
              {"personality", firmware.personality().name},
              {"faults", printer.faults().counts()},
              {"resets", firmware.counts().resets},
              {"printer_seconds", firmware.now()},
              {"printing_seconds", deposit.last_end() - deposit.first_start()},
              {"feeders", feeders(machine, firmware.planner())},
              {"mixtures", mixtures(machine, feed)},
              {"extruded_mm", feed.extruded()},
              {"not_printed",
               {{"fed_mm", feed.fed_in_place()},
                {"retracted_mm", feed.retracted()},
                {"feeder_steps", first_of(feed.idle_steps(), machine.feeders)}}},
              {"motion", motion(outcome.motion)},
              {"chamber", chamber(machine, outcome)},
              {"deposited_mm3", deposit.volume()},
              {"dropped_mm3", deposit.dropped()},
              {"deposited_length_mm", deposit.length()},
              {"layers", layers(deposit)},
              {"extents", extents(deposit.extents())},
              {"struck", struck(outcome.strikes)},
              {"warnings", warnings(firmware)},
              {"display", screen(firmware.screen())},
              {"temperatures",
               {{"nozzle", heater(firmware.nozzle(), firmware.now())},
                {"bed", heater(firmware.bed(), firmware.now())}}},
              {"position",
               {{"x", coordinates.logical(axis_x)},
                {"y", coordinates.logical(axis_y)},
                {"z", coordinates.logical(axis_z)},
                {"e", coordinates.e()}}},
              {"killed", firmware.killed()},
              {"hung", firmware.hung()}};
  if (outcome.pictures) report["pictures"] = place(*outcome.pictures);
  return report.dump(2);
}

}  // namespace unicursal::sim
