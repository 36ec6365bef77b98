// The keys of a job that do not concern the part's shape, and the profile's newer keys.
#include <catch2/catch.hpp>

#include "host/engine/prepared_job.hpp"
#include "host/job/load_job.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal::host {
namespace {

using test::replaced;
using test::sample_job;
using test::sample_profile;

Job load(const std::string& job, const std::string& profile = sample_profile) {
  const test::TempFolder folder;
  folder.write("bench.toml", profile);
  folder.write("plate.svg", test::sample_drawing);
  return load_job(folder.write("job.toml", job));
}

/// The sample job with `text` in place of its flow.
Job with(const std::string& text) {
  return load(replaced(sample_job, "flow = 3.0", text));
}

Job with_printer(const std::string& printer, const std::string& extruder = "") {
  return load(sample_job, replaced(replaced(sample_profile, "nozzle = 0.6", "nozzle = 0.6\n" + printer),
                                   "max_flow = 5.0", "max_flow = 5.0\n" + extruder));
}

std::string complaint(const std::function<void()>& load) {
  try {
    load();
  } catch (const core::DataError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("Speed, first layer, skirt, fan and temperatures arrive in their fields") {
  const Job plain = load(sample_job);
  CHECK_FALSE(plain.print.automatic_flow);
  CHECK_FALSE(plain.print.speed);
  CHECK(plain.print.skirt.loops == 0);
  CHECK(with("flow = \"auto\"").print.automatic_flow);
  CHECK(with("flow = \"auto\"").warnings.empty());
  CHECK(with("speed = 20").print.speed == 20);
  CHECK(with("first_layer_speed = 0.4").print.first_layer_speed == 0.4);
  CHECK(with("first_layer_height = 0.3").source.first_layer_height == 0.3);
  CHECK(with("skirt = 3").print.skirt.loops == 3);
  const Job skirt = with("skirt = { loops = 2, distance = 7.5 }");
  CHECK(skirt.print.skirt.loops == 2);
  CHECK(skirt.print.skirt.distance == 7.5);
  CHECK(with("outline = \"strokes\"").source.strokes_are_contours);
  CHECK_FALSE(with("outline = \"fills\"").source.strokes_are_contours);
  CHECK(with("fan = 80").print.fan.percent == 80);
  CHECK(with("fan = { percent = 60, from = 4 }").print.fan.from == 4);
  const Job warm =
      with("temperatures = [{ layer = 0, nozzle = 215, bed = 65 }, { layer = 3, nozzle = 200 }]");
  REQUIRE(warm.print.temperatures.size() == 2);
  CHECK(warm.print.temperatures[0].bed == 65);
  CHECK(warm.print.temperatures[1].layer == 3);
  CHECK_FALSE(warm.print.temperatures[1].bed);
}

TEST_CASE("Wrong values are reported with the line and the remedy") {
  const auto [text, words] = GENERATE(table<std::string, std::vector<std::string>>({
      {"flow = 3.0\nspeed = 20", {"part.speed", "flow", "leave out"}},
      {"speed = 0", {"part.speed", "0.1"}},
      {"first_layer_speed = 1.5", {"part.first_layer_speed", "1.5", "0.5"}},
      {"first_layer_height = 0.7", {"line 8", "part.first_layer_height", "0.7 mm", "opening of 0.6"}},
      {"first_layer_height = 0", {"part.first_layer_height"}},
      {"outline = \"lines\"", {"part.outline", "strokes"}},
      {"skirt = 1.5", {"part.skirt", "whole number"}},
      {"skirt = -1", {"part.skirt", "from 0 to 20"}},
      {"skirt = { loop = 2 }", {"part.skirt.loop", "did you mean \"loops\"?"}},
      {"fan = 120", {"part.fan", "100 %"}},
      {"fan = { from = 2 }", {"part.fan.percent", "missing"}},
      {"temperatures = 210", {"part.temperatures", "not a list"}},
      {"temperatures = [210]", {"part.temperatures", "not a table"}},
      {"temperatures = [{ layer = 1 }]", {"part.temperatures[0].layer", "neither"}},
      {"temperatures = [{ layer = 1, nozzle = 90 }]", {"part.temperatures[0].nozzle", "150"}},
      {"temperatures = [{ layer = 2, bed = 50 }, { layer = 2, bed = 60 }]", {"temperatures[1]", "sort"}},
  }));
  const std::string said = complaint([&, text = text] { with(text); });
  INFO(text << ": " << said);
  for (const std::string& word : words) CHECK(said.find(word) != std::string::npos);
}

TEST_CASE("A profile holds the firmware's limits in corners, the extruder's motion and its calibration") {
  const Job job = with_printer("jerk = [8, 9, 0.4]\njunction_deviation = 0.013\nacceleration = 1200",
                               "max_speed = 40\nmax_acceleration = 5000\njerk = 4\nz_hop = 0.3\n"
                               "steps_per_mm = 415\nflow_factors = [1, 1.02, 0.99]");
  const gcode::Printer& printer = job.profile.printer;
  CHECK(printer.motion.jerk == std::array<double, 3>{8, 9, 0.4});
  CHECK(printer.motion.junction_deviation == 0.013);
  CHECK(printer.motion.acceleration == 1200);
  CHECK(printer.motion.travel_acceleration == 1200);
  CHECK(printer.motion.extruder_speed == 40);
  CHECK(printer.motion.extruder_acceleration == 5000);
  CHECK(printer.motion.extruder_jerk == 4);
  CHECK(printer.z_hop == 0.3);
  CHECK(printer.extruder_steps == 415);
  CHECK(printer.flow_factors[1] == 1.02);
  CHECK(complaint([] { with_printer("", "flow_factors = [1, 3, 1]"); }).find("flow_factors") !=
        std::string::npos);
}

TEST_CASE("An unknown placeholder is reported with the nearest known one") {
  const auto load_script = [](const std::string& line) {
    return complaint(
        [&] { load(sample_job, std::string(sample_profile) + "[gcode]\nstart = \"" + line + "\"\n"); });
  };
  CHECK(load_script("M104 S{nozzle_temperature}").empty());
  const std::string said = load_script("M104 S{nozle_temperature}");
  INFO(said);
  CHECK(said.find("gcode.start") != std::string::npos);
  CHECK(said.find("{nozle_temperature}") != std::string::npos);
  CHECK(said.find("did you mean {nozzle_temperature}?") != std::string::npos);
}

TEST_CASE("Layers printed alone come down by the first layer's own height") {
  Job job = with("first_layer_height = 0.3");
  const test::TempFolder folder;
  job.source.files = {folder.write("plate.svg", test::sample_drawing)};
  job.source.height = 1.1;
  const PreparedJob whole = prepare(job);
  CHECK(whole.lowered == 0);
  CHECK(whole.count == 5);
  CHECK(print_settings(whole).first_layer_height == 0.3);
  const PreparedJob upper = prepare(job, LayerRange{2, 3});
  CHECK(upper.lowered == Approx(0.5));
  CHECK(print_settings(upper).first_layer_height == 0.2);
  CHECK(print_settings(upper).layer_count == 2);
}

}  // namespace unicursal::host
