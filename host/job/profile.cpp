#include "host/job/profile.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "firmware_gcode/dialect/dialect_named.hpp"
#include "firmware_gcode/mixing/chamber.hpp"
#include "firmware_gcode/print/bounds.hpp"
#include "firmware_gcode/print/mixture.hpp"
#include "firmware_gcode/toolpath/placeholders.hpp"
#include "host/job/keys.hpp"
#include "host/job/nearest.hpp"
#include "host/job/settings_file.hpp"

namespace unicursal::host {
namespace {

constexpr double longest_tube = 1900;  ///< mm; filament through it and out of the nozzle stays below 2 m
constexpr double most_of_equal_share = 0.9;  ///< that a floor share may be; mixtures then still differ

Range within(const gcode::Bounds& bounds, const char* unit) {
  return between(bounds.least, bounds.greatest, unit);
}

unsigned read_whole(const Section& section, const char* key, unsigned otherwise, const Range& range) {
  const std::string remedy = fmt::format("write for example {} = {}", key, otherwise);
  const double number = section.number_or(key, otherwise, range, remedy.c_str());
  if (number != std::floor(number)) section.fail(key, "is not a whole number", remedy.c_str());
  return static_cast<unsigned>(number);
}

std::optional<HeadClearance> read_clearance(const Section& section) {
  if (!section.has("clearance_radius") && !section.has("clearance_height")) return std::nullopt;
  constexpr double greatest = 1000;
  return HeadClearance{
      section.number("clearance_radius", {0, greatest, true, "mm"},
                     "measure from the nozzle to the farthest part of the hot end beside it, for example "
                     "clearance_radius = 45"),
      section.number("clearance_height", {0, greatest, true, "mm"},
                     "measure from the nozzle's tip up to the lowest rod or belt, for example "
                     "clearance_height = 25")};
}

void read_machine(const Section& section, Profile& profile) {
  gcode::Printer& printer = profile.printer;
  printer.name = section.text_or("name", profile.file.stem().string(), "write a name in quotes");
  if (const toml::node* firmware = section.find("firmware")) {
    printer.firmware = section.choice("firmware", *firmware, {"marlin", "repetier", "reprapfirmware"});
  }
  profile.port = section.text_or("port", profile.port, "write \"auto\" or a path such as \"/dev/ttyUSB0\"");
  profile.baud = read_whole(section, "baud", profile.baud, between(300, 4000000, "bits/s"));
  profile.receive_buffer =
      read_whole(section, "receive_buffer", profile.receive_buffer, between(32, 65536, "bytes"));
  profile.display = section.flag_or("display", profile.display, "write true or false");
  printer.bed =
      section.numbers_or("bed", printer.bed, within(gcode::bounds::bed, "mm"), "write bed = [x, y, z] in mm");
  printer.overtravel =
      section.numbers_or("overtravel", printer.overtravel, within(gcode::bounds::overtravel, "mm"),
                         "write overtravel = [left, front] in mm");
  printer.nozzle = section.number_or("nozzle", printer.nozzle, within(gcode::bounds::nozzle, "mm"),
                                     "write for example nozzle = 0.4");
  printer.bead_width_range = section.numbers_or("bead_width_range", printer.bead_width_range,
                                                within(gcode::bounds::bead_width, "mm"),
                                                "write bead_width_range = [least, greatest] in mm");
  if (printer.bead_width_range[0] > printer.bead_width_range[1]) {
    section.fail("bead_width_range", "has its least width above its greatest", "swap the two numbers");
  }
  printer.max_speed = section.numbers_or("max_speed", printer.max_speed, within(gcode::bounds::speed, "mm/s"),
                                         "write max_speed = [x, y, z] in mm/s");
  printer.max_acceleration = section.numbers_or("max_acceleration", printer.max_acceleration,
                                                within(gcode::bounds::acceleration, "mm/s²"),
                                                "write max_acceleration = [x, y, z] in mm/s²");
  profile.clearance = read_clearance(section);
  gcode::Motion& motion = printer.motion;
  motion.jerk = section.numbers_or("jerk", motion.jerk, within(gcode::bounds::jerk, "mm/s"),
                                   "write jerk = [x, y, z] in mm/s, as M503 reports");
  motion.junction_deviation = section.number_or("junction_deviation", motion.junction_deviation,
                                                within(gcode::bounds::junction_deviation, "mm"),
                                                "write for example junction_deviation = 0.013");
  motion.acceleration =
      section.number_or("acceleration", motion.acceleration, within(gcode::bounds::acceleration, "mm/s²"),
                        "write for example acceleration = 3000");
  motion.travel_acceleration = motion.acceleration;
}

void read_extruder_motion(const Section& section, gcode::Motion& motion) {
  motion.extruder_speed =
      section.number_or("max_speed", motion.extruder_speed, within(gcode::bounds::speed, "mm/s"),
                        "write mm of filament in a second, for example max_speed = 50");
  motion.extruder_acceleration = section.number_or("max_acceleration", motion.extruder_acceleration,
                                                   within(gcode::bounds::acceleration, "mm/s²"),
                                                   "write for example max_acceleration = 10000");
  motion.extruder_jerk = section.number_or("jerk", motion.extruder_jerk, within(gcode::bounds::jerk, "mm/s"),
                                           "write for example jerk = 5");
}

/// Reads a script; an unknown placeholder is an error that names the nearest known one.
std::string read_script(const Section& section, const char* key) {
  const std::string text = section.text_or(key, "", "write the extra lines in \"\"\"triple quotes\"\"\"");
  const std::vector<std::string> known = gcode::placeholder_names();
  for (const std::string& name : gcode::placeholders_in(text)) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    section.fail(key, fmt::format("holds {{{}}}, which stands for nothing", name),
                 fmt::format("did you mean {{{}}}?", nearest(name, known)));
  }
  return text;
}

/// The firmware has been read before; as many feeders as there are filaments are usual.
void read_feeders(const Section& section, gcode::Printer& printer) {
  const std::size_t most = gcode::dialect_named(printer.firmware).limits().feeders;
  const std::string remedy = fmt::format("write how many feeders meet in the nozzle, {} to {} with {}",
                                         gcode::least_feeders, most, printer.firmware);
  const double feeders =
      section.number_or("feeders", static_cast<double>(printer.feeders),
                        between(gcode::least_feeders, static_cast<double>(most), ""), remedy);
  if (!section.has("feeders") && (printer.feeders < gcode::least_feeders || printer.feeders > most))
    section.fail("feeders", fmt::format("would be {}, the number of [[filament]]", printer.feeders), remedy);
  if (feeders != std::floor(feeders)) section.fail("feeders", "is not a whole number", remedy);
  printer.feeders = static_cast<std::size_t>(feeders);
}

void read_flow_factors(const Section& section, gcode::Printer& printer) {
  const auto example = [&] { return gcode::PerFeeder::all(printer.feeders, 1); };
  printer.flow_factors = example();
  if (!section.has("flow_factors")) return;
  const std::string remedy = fmt::format("write one number for each feeder, for example flow_factors = [{}]",
                                         fmt::join(example(), ", "));
  const std::vector<double> factors =
      section.numbers("flow_factors", within(gcode::bounds::flow_factor, ""), remedy);
  if (factors.size() != printer.feeders)
    section.fail(
        "flow_factors",
        fmt::format("has {} numbers, but the printer has {} feeders", factors.size(), printer.feeders),
        remedy);
  printer.flow_factors = gcode::PerFeeder::of(factors);
}

void read_extruder(const Section& section, gcode::Printer& printer) {
  read_feeders(section, printer);
  printer.filament_diameter = section.number_or("filament_diameter", printer.filament_diameter,
                                                within(gcode::bounds::filament_diameter, "mm"),
                                                "write for example filament_diameter = 1.75");
  printer.max_flow = section.number_or("max_flow", printer.max_flow, within(gcode::bounds::flow, "mm³/s"),
                                       "write for example max_flow = 8.0");
  const double greatest_floor = most_of_equal_share / static_cast<double>(printer.feeders);
  printer.floor_share = section.number_or("floor_share", printer.floor_share, between(0, greatest_floor, ""),
                                          "write for example floor_share = 0.02");
  printer.retraction_length = section.number_or("retraction_length", printer.retraction_length,
                                                within(gcode::bounds::retraction_length, "mm"),
                                                "write for example retraction_length = 4.0");
  printer.retraction_speed =
      section.number_or("retraction_speed", printer.retraction_speed, within(gcode::bounds::speed, "mm/s"),
                        "write for example retraction_speed = 25.0");
  printer.z_hop = section.number_or("z_hop", printer.z_hop, within(gcode::bounds::z_hop, "mm"),
                                    "write for example z_hop = 0.4");
  printer.purge_inlets = section.flag_or("purge_inlets", true, "write true or false");
  read_flow_factors(section, printer);
  if (section.has("steps_per_mm")) {
    printer.extruder_steps = section.number("steps_per_mm", within(gcode::bounds::extruder_steps, "steps/mm"),
                                            "write for example steps_per_mm = 400");
  }
  read_extruder_motion(section, printer.motion);
}

void read_temperature(const Section& section, Profile& profile) {
  gcode::Printer& printer = profile.printer;
  printer.nozzle_temperature = section.number_or("nozzle", printer.nozzle_temperature,
                                                 between(150, 450, "°C"), "write for example nozzle = 210");
  printer.bed_temperature =
      section.number_or("bed", printer.bed_temperature, within(gcode::bounds::bed_temperature, "°C"),
                        "write for example bed = 60");
  profile.hottest_nozzle = section.number_or(
      "hottest_nozzle", std::max(profile.hottest_nozzle, printer.nozzle_temperature),
      between(printer.nozzle_temperature, 450, "°C"), "write for example hottest_nozzle = 260");
  profile.hottest_bed =
      section.number_or("hottest_bed", std::max(profile.hottest_bed, printer.bed_temperature),
                        between(printer.bed_temperature, gcode::bounds::bed_temperature.greatest, "°C"),
                        "write for example hottest_bed = 100");
}

void read_transition(const Section& section, gcode::Printer& printer) {
  printer.dead_volume =
      section.number_or("dead_volume", printer.dead_volume, within(gcode::bounds::transition, "mm³"),
                        "write for example dead_volume = 2.1");
  printer.mixing_volume =
      section.number_or("mixing_volume", printer.mixing_volume, within(gcode::bounds::transition, "mm³"),
                        "write for example mixing_volume = 4.0");
  const char* const remedy = "write a whole number, for example tanks = 2";
  const double tanks = section.number_or("tanks", static_cast<double>(printer.tanks),
                                         between(1, static_cast<double>(gcode::max_tanks), ""), remedy);
  if (tanks != std::floor(tanks)) section.fail("tanks", "is not a whole number", remedy);
  printer.tanks = static_cast<std::size_t>(tanks);
  printer.overshoot = section.flag_or("overshoot", printer.overshoot, "write true or false");
}

}  // namespace

namespace {

Profile read_profile(const SettingsFile& file, const std::filesystem::path& path) {
  Profile profile;
  profile.file = std::filesystem::absolute(path);
  const Section root = file.root(keys::profile);
  read_machine(root.section("printer", keys::printer,
                            "a profile describes the machine below [printer]; is this file a profile?"),
               profile);
  const Section extruder = root.section_or_empty("extruder", keys::extruder);
  profile.printer.feeders = filament_count(root).value_or(profile.printer.feeders);
  read_extruder(extruder, profile.printer);
  if (extruder.has("tube_length"))
    profile.tube_length =
        extruder.number("tube_length", between(1, longest_tube, "mm"),
                        "measure from the feeder to the hot end, for example tube_length = 450");
  profile.filaments = read_filaments(root, extruder, profile.printer);
  read_temperature(root.section_or_empty("temperature", keys::temperature), profile);
  read_transition(root.section_or_empty("transition", keys::transition), profile.printer);
  const Section gcode = root.section_or_empty("gcode", keys::gcode);
  profile.printer.start_gcode = read_script(gcode, "start");
  profile.printer.end_gcode = read_script(gcode, "end");
  return profile;
}

}  // namespace

Profile load_profile(const std::filesystem::path& path) {
  return read_profile(SettingsFile(path), path);
}

Profile profile_in(const std::string& text, const std::filesystem::path& file) {
  return read_profile(SettingsFile(file, text), file);
}

}  // namespace unicursal::host
