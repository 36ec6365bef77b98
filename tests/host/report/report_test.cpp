#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/error.hpp"
#include "host/report/curve_file.hpp"
#include "host/report/layer_log.hpp"
#include "host/report/summary.hpp"
#include "host/report/totals.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal::host {
namespace {

using gcode::Mixture;

/// A 2 x 1 rectangle as a closed path; the long sides fill 2 mm², the short ones 0.5 mm².
core::BeadPath rectangle() {
  return {{{{0, 0}, 2, 0}, {{2, 0}, 0.5, 1}, {{2, 1}, 2, 0}, {{0, 1}, 0.5, 1}}};
}

core::IslandPlan plan_of(std::size_t curves) {
  core::IslandPlan plan;
  for (std::size_t i = 0; i < curves; ++i) {
    core::PlannedCurve curve;
    curve.path = rectangle();
    curve.objectives = {0.5, 7, 3, 4};
    curve.farthest = static_cast<double>(i + 1);
    curve.zone_crossings = 4;
    plan.curves.push_back(curve);
  }
  plan.unfilled_area = 0.25;
  plan.graph = {1, 2};
  return plan;
}

std::vector<MaterialVolume> two_materials() {
  return {{"a", Mixture({1, 0, 0}), Mixture({0.9, 0.05, 0.05}), 0, 0},
          {"b", Mixture({0, 1, 1}), Mixture({0, 1, 1}), 0, 0}};
}

/// A simulator's report with steps for these volumes of filament (1 step is 1 mm³ here).
nlohmann::json seen(double scale) {
  return {{"lines", {{"accepted", 11}}},
          {"last_line", 10},
          {"executed_lines_in_order", true},
          {"mixtures",
           {{{"tool", 1}, {"shares", {0.0, 0.5, 0.5}}, {"feeder_steps", {0, 50 * scale, 50 * scale}}},
            {{"tool", 0}, {"shares", {0.9, 0.05, 0.05}}, {"feeder_steps", {180, 10, 10}}}}}};
}

Fed unit_steps() {
  // A filament of 1 mm² and one step for each mm.
  return {2 / std::sqrt(std::numbers::pi), 1, 10, {1, 1, 1}};
}

}  // namespace

TEST_CASE("Figures of islands add up, and spacing and E follow from the sums") {
  Figures sum = measure(plan_of(1));
  CHECK(sum.length == Approx(6));
  CHECK(sum.area == Approx(5));
  CHECK(sum.mean_spacing() == Approx(5.0 / 6));
  CHECK(sum.normalised_coverage() == Approx(0.5 / (5 * 25.0 / 36)));
  sum += measure(plan_of(2));
  sum += measure(core::IslandPlan{});
  CHECK(sum.islands == 3);
  CHECK(sum.empty_islands == 1);
  CHECK(sum.curves == 3);
  CHECK(sum.vertices == 12);
  CHECK(sum.farthest == 2);
  CHECK(sum.zone_crossings == 12);
  CHECK(sum.unfilled_area == 0.5);
  CHECK(sum.graph.cpu_seconds == 4);
  CHECK(sum.mean_spacing() == Approx(5.0 / 6));
  CHECK(sum.normalised_coverage() == Approx(0.5 / (5 * 25.0 / 36)));
  CHECK(Figures{}.mean_spacing() == 0);
  CHECK(Figures{}.normalised_coverage() == 0);
}

TEST_CASE("The report of a curve has the keys that other programs rely on") {
  const nlohmann::json report = to_json(measure(plan_of(1)));
  for (const char* key : {"vertices", "area_mm2", "length_mm", "zone_crossings", "self_intersections",
                          "outside_segments", "split_and_reconnect", "doubled_edges", "mean_spacing_mm",
                          "farthest_mm", "unfilled_mm2", "far_mm2"}) {
    INFO(key);
    CHECK(report.contains(key));
  }
  for (const char* stage : {"graph", "cycle", "fairing", "widths"}) {
    CHECK(report.at("seconds").contains(stage));
    CHECK(report.at("cpu_seconds").contains(stage));
  }
  CHECK(report.at("objectives").at("coverage") == 0.5);
  CHECK(report.at("objectives").at("E") == report.at("objectives").at("normalised_coverage"));
}

TEST_CASE("Volumes count for the materials of the beads' zones, fed volumes for the named mixtures") {
  auto volumes = two_materials();
  gcode::PlacedLayer layer;
  layer.height = 0.5;
  layer.paths = {rectangle()};
  add_layer(volumes, layer, {1, 0});
  CHECK(volumes[0].part == Approx(0.5));
  CHECK(volumes[1].part == Approx(2));
  const auto fed = fed_volumes({{volumes[1].intended, 9}, {gcode::Mixture({1, 1, 1}), 0.5}}, volumes);
  CHECK(fed[0].name == volumes[1].name);
  CHECK(fed[0].total() == 9);
  CHECK(fed[1].name == "between");
  volumes[1].prime = 7;
  const auto feeders = feeder_volumes(volumes);
  CHECK(feeders[0] == Approx(0.45));
  CHECK(feeders[1] == Approx(0.025 + 4.5));
}

TEST_CASE("Feeder steps are compared with the intended volume of each mixture") {
  auto volumes = two_materials();
  volumes[0].part = 200;
  volumes[1].part = 90;
  volumes[1].prime = 10;
  CHECK(compare(volumes, seen(1), unit_steps()).worst_error == Approx(0).margin(1e-9));
  const Comparison more = compare(volumes, seen(1.02), unit_steps());
  CHECK(more.mixtures[0].relative_error == Approx(0).margin(1e-9));
  CHECK(more.mixtures[1].relative_error == Approx(0.02));
  CHECK(more.worst_error == Approx(0.02));
}

TEST_CASE("Mixtures in between are judged together, since single steps matter in small volumes") {
  const auto volumes = fed_volumes(
      {{gcode::Mixture({0.5, 0.48, 0.02}), 50}, {gcode::Mixture({0.02, 0.48, 0.5}), 50}}, two_materials());
  REQUIRE(volumes[0].name == mixed_between);
  const auto report = [](double floor, double main) {
    return nlohmann::json{{"mixtures",
                           {{{"shares", {0.5, 0.48, 0.02}}, {"feeder_steps", {main, 24, floor}}},
                            {{"shares", {0.02, 0.48, 0.5}}, {"feeder_steps", {floor, 24, 25}}}}}};
  };
  CHECK(compare(volumes, report(1, 25), unit_steps()).worst_error == Approx(0).margin(1e-9));
  // One more step of a feeder that has one: twice its share, but 1 % of the volume.
  CHECK(compare(volumes, report(1, 26), unit_steps()).worst_error == Approx(0.01));
  CHECK(compare(volumes, report(2, 25), unit_steps()).worst_error == Approx(0.02));
}

TEST_CASE("A feeder that ran by mistake is found although the sum is right") {
  auto volumes = two_materials();
  volumes[0].part = 200;
  volumes[1].part = 100;
  nlohmann::json report = seen(1);
  report["mixtures"][1]["feeder_steps"] = {170, 20, 10};
  const Comparison comparison = compare(volumes, report, unit_steps());
  CHECK(comparison.mixtures[0].relative_error == Approx(0).margin(1e-9));
  CHECK(comparison.worst_error == Approx(1));
}

TEST_CASE("Materials that the printer cannot distinguish are compared as one") {
  auto volumes = two_materials();
  volumes[0].part = 120;
  volumes.push_back(volumes[0]);
  volumes.back().name = "c";
  volumes.back().part = 80;
  volumes[1].part = 100;
  const Comparison comparison = compare(volumes, seen(1), unit_steps());
  REQUIRE(comparison.mixtures.size() == 2);
  CHECK(comparison.mixtures[0].name == "a + c");
  CHECK(comparison.worst_error == Approx(0).margin(1e-9));
}

TEST_CASE("Lost, repeated and disordered lines are distinguished") {
  const auto volumes = two_materials();
  nlohmann::json report = seen(1);
  CHECK(compare(volumes, report, unit_steps()).lines_whole());
  report["last_line"] = 7;
  report["lines"]["accepted"] = 8;
  CHECK(compare(volumes, report, unit_steps()).lines_lost == 3);
  report = seen(1);
  report["lines"]["accepted"] = 13;
  CHECK(compare(volumes, report, unit_steps()).lines_twice == 2);
  report = seen(1);
  report["executed_lines_in_order"] = false;
  CHECK_FALSE(compare(volumes, report, unit_steps()).lines_whole());
  CHECK_FALSE(compare(volumes, nlohmann::json::object(), unit_steps()).lines_whole());
}

TEST_CASE("A report is streamed, valid, and appears only when it is complete") {
  const test::TempFolder folder;
  const auto file = folder / "deep/report.json";
  {
    LayerLog log(file);
    log.add({{"layer", 0}});
    CHECK_FALSE(std::filesystem::exists(file));
  }
  CHECK(std::filesystem::is_empty(file.parent_path()));
  LayerLog log(file);
  log.add({{"layer", 0}});
  log.add({{"layer", 1}});
  log.finish({{"job", "caf\xe9.toml"}, {"lines", 5}});
  const nlohmann::json report = nlohmann::json::parse(test::read_text(file));
  CHECK(report["layers"].size() == 2);
  CHECK(report["layers"][1]["layer"] == 1);
  CHECK(report["lines"] == 5);
  CHECK_THROWS_AS(LayerLog(folder.path()), core::FileError);
}

TEST_CASE("A curve's text restores its areas to the last digit") {
  core::IslandPlan plan = plan_of(1);
  plan.curves[0].path.beads[0].area = 1.0 / 3;
  std::istringstream text(curve_text(plan));
  double x = 0, y = 0, width = 0;
  REQUIRE(text >> x >> y >> width);
  CHECK(width == plan.curves[0].path.width(0));
  int vertices = 1;
  while (text >> x >> y >> width) ++vertices;
  CHECK(vertices == 4);
}

TEST_CASE("Durations are written as people say them") {
  CHECK(duration_words(12.34) == "12.3 s");
  CHECK(duration_words(200) == "3 min 20 s");
  CHECK(duration_words(7500) == "2 h 05 min");
}

}  // namespace unicursal::host
