#include "host/engine/printer_view.hpp"

#include <variant>

#include "firmware_gcode/reply/phrases.hpp"
#include "host/engine/printer_check.hpp"

namespace unicursal::host {
namespace {

namespace reply = gcode::reply;

void update(gcode::Temperatures& known, const gcode::Temperatures& reported) {
  const auto take = [](std::optional<double>& to, const std::optional<double>& from) {
    if (from) to = from;
  };
  take(known.nozzle, reported.nozzle);
  take(known.nozzle_target, reported.nozzle_target);
  take(known.bed, reported.bed);
  take(known.bed_target, reported.bed_target);
}

Remark::Kind kind_of(const reply::Echo& echo) {
  if (echo.unknown_command && echo.text.find("M85") != std::string::npos) return Remark::Kind::unknown_m85;
  return echo.unknown_command ? Remark::Kind::unknown : Remark::Kind::other;
}

}  // namespace

Remark PrinterView::hear(const std::string& line) {
  const gcode::Reply reply = gcode::parse_reply(line);
  if (const auto* ok = std::get_if<reply::Ok>(&reply)) {
    update(temperatures, ok->temperatures);
    return {Remark::Kind::temperatures, {}};
  }
  if (const auto* report = std::get_if<reply::TemperatureReport>(&reply)) {
    update(temperatures, report->temperatures);
    return {Remark::Kind::temperatures, {}};
  }
  if (const auto* error = std::get_if<reply::Error>(&reply); error && error->halted) {
    halted = true;
    return {Remark::Kind::halted, error->text};
  }
  const auto meaning = gcode::meaning_of(line);
  if (meaning == gcode::Meaning::too_cold) return {Remark::Kind::too_cold, line};
  if (meaning == gcode::Meaning::too_long) return {Remark::Kind::too_long, line};
  if (meaning == gcode::Meaning::no_such_tool) {
    has_tools = false;
    return {Remark::Kind::no_such_tool, line};
  }
  if (const auto* busy = std::get_if<reply::Busy>(&reply); busy && busy->for_user)
    return {Remark::Kind::waits, line};
  if (const auto* action = std::get_if<reply::Action>(&reply)) return {Remark::Kind::action, action->text};
  if (denies_mixing(line)) {
    mixes = false;
    return {Remark::Kind::no_mixing, line};
  }
  if (const auto count = mixing_feeders(line)) feeders = count;
  if (const auto* echo = std::get_if<reply::Echo>(&reply)) return {kind_of(*echo), echo->text};
  return {Remark::Kind::other, line};
}

void PrinterView::run(const std::string& line) {
  expected.run(line);
  if (line.starts_with("M104") || line.starts_with("M109")) job_nozzle = expected.nozzle;
  if (line.starts_with("M140") || line.starts_with("M190")) job_bed = expected.bed;
}

bool PrinterView::knows_position() const {
  const auto& position = expected.position;
  return position[0] && position[1] && position[2] && !expected.relative;
}

}  // namespace unicursal::host
