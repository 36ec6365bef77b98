#include "host/doctor/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/engine/printer_check.hpp"

namespace unicursal::host {
namespace {

using gcode::Family;
using Weight = Finding::Weight;

constexpr double line_bytes = 40, bits_per_byte = 10;  ///< A typical move on a serial line.
constexpr double segment = 0.2;            ///< Segments in the bends of a curve of 0.45 mm spacing, mm.
constexpr double slow_answer = 0.012;      ///< s; FTDI's chips delay replies by 16 ms, others by 1 ms.
constexpr double hot = 50;                 ///< °C
constexpr double plenty_of_baud = 250000;  ///< bits/s

class Doctor {
 public:
  Doctor(const Examination& found, unsigned baud, const Profile* profile)
      : found_(found), baud_(baud), profile_(profile) {}

  std::vector<Finding> operator()() {
    firmware();
    mixing();
    settings();
    safety();
    line();
    heat();
    std::stable_sort(list_.begin(), list_.end(),
                     [](const Finding& a, const Finding& b) { return a.weight > b.weight; });
    return std::move(list_);
  }

 private:
  void add(Weight weight, std::string text) { list_.push_back({weight, std::move(text)}); }
  void add_if(bool well, Weight otherwise, std::string good, std::string bad) {
    add(well ? Weight::good : otherwise, well ? std::move(good) : std::move(bad));
  }

  void firmware() {
    const gcode::Identity& who = found_.identity;
    if (who.family == Family::unknown) {
      add(Weight::warning, "this program does not know its firmware; a print may fail in untested ways");
    } else {
      add_if(dialect_of(who.family).has_value(), Weight::trouble,
             fmt::format("this program speaks {}", gcode::name(who.family)),
             fmt::format("this program does not speak {} yet; use Marlin 2", gcode::name(who.family)));
    }
    if (profile_ != nullptr) {
      if (const auto wrong = mismatch(who, profile_->printer.firmware))
        add(Weight::trouble, fmt::format("{}; {}", *wrong, correction(who, profile_->file)));
    }
    if (who.family == Family::marlin && who.version && *who.version < gcode::Version{2, 0, 0}) {
      add(Weight::warning,
          "its Marlin is older than 2.0, in which a new mixture also affects moves that are already queued, "
          "so colours change early; update it to 2.1");
    }
  }

  void mixing() {
    if (speaks_of_tools()) return tool();
    add_if(found_.mixes, Weight::trouble,
           "its feeders mix (it knows M163); it does not report how many there are, so check the profile",
           does_not_mix("marlin"));
    const std::size_t wanted = profile_ != nullptr ? profile_->printer.feeders : gcode::Printer().feeders;
    if (const auto other = has_other_feeders(found_.identity, wanted)) add(Weight::trouble, *other);
    constexpr unsigned enough = 16;
    if (found_.tools)
      add_if(
          *found_.tools >= enough, Weight::warning,
          fmt::format("it has {} virtual tools for mixtures", *found_.tools),
          fmt::format("it has only {} virtual tools: a print that needs more mixtures is refused; build its "
                      "firmware with MIXING_VIRTUAL_TOOLS {}",
                      *found_.tools, enough));
    const auto extruders = found_.identity.extruders.value_or(1);
    if (!found_.mixes && extruders > 1)
      add(Weight::note, fmt::format("it treats its feeders as {} separate extruders", extruders));
  }

  bool speaks_of_tools() const { return found_.identity.family == Family::reprapfirmware; }

  void tool() {
    if (!found_.feeders) return add(Weight::trouble, does_not_mix("reprapfirmware"));
    const std::size_t wanted = profile_ != nullptr ? profile_->printer.feeders : *found_.feeders;
    add_if(*found_.feeders == wanted, Weight::trouble,
           fmt::format("its tool 0 mixes the filament of its {} feeders", *found_.feeders),
           mixes_other_feeders(*found_.feeders, wanted));
    add(Weight::note,
        "it drops a damaged line without a word: the print goes line by line, and ends if a line is lost "
        "whose effect cannot be seen");
  }

  void settings() {
    if (!found_.tells_settings)
      return add(Weight::note,
                 "it does not report its settings (M503): compare speeds and accelerations "
                 "with the profile yourself");
    if (found_.settings.volumetric.value_or(false)) {
      add(Weight::trouble,
          "it takes E as mm³ (volumetric extrusion, M200), so it would extrude 2.4 times too little of 1.75 "
          "mm "
          "filament; switch that off with M200 S0 and M500");
    }
    if (profile_ == nullptr) return;
    compare("max_speed", "mm/s", profile_->printer.max_speed, found_.settings.max_speed);
    compare("max_acceleration", "mm/s²", profile_->printer.max_acceleration,
            found_.settings.max_acceleration);
  }

  void compare(const char* key, const char* unit, const std::array<double, 3>& believed,
               const std::optional<std::array<double, 4>>& reported) {
    if (!reported) return;
    constexpr double rounding = 1.001;
    for (std::size_t axis = 0; axis < believed.size(); ++axis) {
      if (believed[axis] <= (*reported)[axis] * rounding) continue;
      return add(Weight::warning,
                 fmt::format("its own {0} for {1} is {2:g} {3}, the profile says {4:g}: prints take longer "
                             "than planned, and the flow is not constant; correct the profile",
                             key, "xyz"[axis], (*reported)[axis], unit, believed[axis]));
    }
    add(Weight::good, fmt::format("its {} is not below that of the profile", key));
  }

  void safety() {
    add_if(
        found_.shuts_down, Weight::warning,
        "if this computer fails in mid-print, the printer switches its heaters off by itself (M85)",
        "M85 has no effect on it: if this computer fails in mid-print, the heaters stay on; do not leave the "
        "printer unattended");
    add_if(found_.identity.can("EMERGENCY_PARSER"), Weight::warning, "an emergency stop takes effect at once",
           speaks_of_tools()
               ? "an emergency stop waits until the running command is done, which takes minutes "
                 "while it heats; keep its power switch within reach"
               : "an emergency stop waits until there is room in its queue; keep its power switch "
                 "within reach, or build its firmware with EMERGENCY_PARSER");
  }

  void line() {
    add_if(found_.identity.can("AUTOREPORT_TEMP"), Weight::note, "it reports its temperatures by itself",
           "it must be asked for its temperatures, and answers late while it moves");
    add_if(found_.queues.has_value(), Weight::note,
           fmt::format("it reports how full its queues are (up to {} moves and {} commands)",
                       found_.queues ? found_.queues->planner_size : 0,
                       found_.queues ? found_.queues->commands_size : 0),
           speaks_of_tools()
               ? "it does not report how full its queues are"
               : "it does not report how full its queues are; build its firmware with ADVANCED_OK");
    const double lines = baud_ / (line_bytes * bits_per_byte);
    add_if(baud_ >= plenty_of_baud, Weight::warning,
           fmt::format("{} baud carry {:.0f} lines a second", baud_, lines),
           fmt::format("{} baud carry only {:.0f} lines a second: segments of {:g} mm are printed at "
                       "{:.0f} mm/s at most, unless the board has native USB; use 250000 baud",
                       baud_, lines, segment, lines * segment));
    add_if(found_.answer_seconds < slow_answer, Weight::warning,
           fmt::format("it answers within {:.1f} ms", 1000 * found_.answer_seconds),
           fmt::format("it takes {:.0f} ms to answer; if its cable has an FTDI chip, write 1 to "
                       "/sys/bus/usb-serial/devices/…/latency_timer",
                       1000 * found_.answer_seconds));
    if (found_.identity.family == Family::repetier)
      add(Weight::note,
          "it takes some damaged lines without a word, so keep its cable short and away from motors");
    if (found_.reset_by_opening)
      add(Weight::note, "it has just started: opening its port resets it, or it has just been switched on");
  }

  void heat() {
    const gcode::Temperatures& t = found_.temperatures;
    if (t.nozzle_target.value_or(0) > 0 || t.bed_target.value_or(0) > 0)
      add(Weight::warning,
          "it is heating although nothing prints; M104 S0 and M140 S0 switch the heaters off");
    else if (t.nozzle.value_or(0) > hot)
      add(Weight::note, fmt::format("its nozzle is still at {:.0f} °C", *t.nozzle));
    if (!t.nozzle) add(Weight::warning, "it does not report the temperature of its nozzle");
  }

  const Examination& found_;
  const unsigned baud_;
  const Profile* profile_;
  std::vector<Finding> list_;
};

const char* word(Weight weight) {
  switch (weight) {
    case Weight::good:
      return "good";
    case Weight::note:
      return "note";
    case Weight::warning:
      return "warning";
    case Weight::trouble:
      return "trouble";
  }
  return "";
}

nlohmann::json axes_json(const std::optional<std::array<double, 4>>& values) {
  return values ? nlohmann::json(*values) : nlohmann::json();
}

}  // namespace

std::vector<Finding> findings(const Examination& found, unsigned baud, const Profile* profile) {
  return Doctor(found, baud, profile)();
}

bool has_trouble(const std::vector<Finding>& findings) {
  return std::any_of(findings.begin(), findings.end(),
                     [](const Finding& finding) { return finding.weight == Weight::trouble; });
}

std::string in_words(const Examination& found, const std::vector<Finding>& findings) {
  const gcode::Identity& who = found.identity;
  std::string text = who.firmware.empty() ? "a printer that does not report its firmware" : who.firmware;
  if (!who.machine.empty()) text += ", " + who.machine;
  text += "\n";
  for (const Finding& finding : findings)
    text += fmt::format("  {:<8} {}\n", word(finding.weight), finding.text);
  return text;
}

nlohmann::json to_json(const Examination& found, const std::vector<Finding>& findings) {
  const gcode::Identity& who = found.identity;
  nlohmann::json json = {{"firmware", who.firmware},
                         {"family", gcode::name(who.family)},
                         {"machine", who.machine},
                         {"capabilities", who.capabilities},
                         {"mixes", found.mixes},
                         {"shuts_down", found.shuts_down},
                         {"reset_by_opening", found.reset_by_opening},
                         {"answer_seconds", found.answer_seconds},
                         {"steps_per_mm", axes_json(found.settings.steps_per_mm)},
                         {"max_speed", axes_json(found.settings.max_speed)},
                         {"max_acceleration", axes_json(found.settings.max_acceleration)},
                         {"findings", nlohmann::json::array()}};
  if (who.version)
    json["version"] = fmt::format("{}.{}.{}", who.version->major, who.version->minor, who.version->patch);
  if (who.extruders) json["extruders"] = *who.extruders;
  if (found.tools) json["virtual_tools"] = *found.tools;
  if (found.queues)
    json["queues"] = {{"moves", found.queues->planner_size}, {"commands", found.queues->commands_size}};
  if (found.temperatures.nozzle) json["nozzle_temperature"] = *found.temperatures.nozzle;
  if (found.temperatures.bed) json["bed_temperature"] = *found.temperatures.bed;
  for (const Finding& finding : findings)
    json["findings"].push_back({{"weight", word(finding.weight)}, {"text", finding.text}});
  return json;
}

}  // namespace unicursal::host
