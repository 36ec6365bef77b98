#include "host/dry_run/dry_run_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "host/engine/session_json.hpp"
#include "host/files/web_files.hpp"
#include "host/files/whole_file.hpp"
#include "host/report/filament_use.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;

constexpr std::array<const char*, 2> viewer_files{"viewer.js", "viewer.css"};
constexpr const char* view_name = "index.html";

/// Above the first a figure is doubtful, above the second it is bad.
struct Limits {
  double doubtful, bad;

  const char* grade(double figure) const {
    return figure > bad ? "bad" : figure > doubtful ? "doubtful" : "good";
  }
};
constexpr Limits gaps_limits{0.02, 0.05};       // fractions of the area
constexpr Limits colour_limits{0.01, 0.03};     // fractions of the area
constexpr Limits material_limits{0.005, 0.02};  // relative error of a mixture

double number_in(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<double>() : 0;
}

/// Of lines and moves: a lost line or a blow of the head spoils the part, a starved queue leaves a blob.
json time_of(const DryRunFindings& f) {
  const json struck = f.simulator.value("struck", json::object());
  const double strikes = number_in(struck, "by_nozzle") + number_in(struck, "by_head");
  const bool whole = f.stream.ending == Ending::completed && f.comparison.lines_whole() && strikes == 0;
  const bool smooth = f.motion.starvations == 0 && f.motion.hasty_stops == 0;
  return {{"grade", !whole   ? "bad"
                    : smooth ? "good"
                             : "doubtful"},
          {"seconds", number_in(f.simulator, "printer_seconds")},
          {"laying_seconds", number_in(f.simulator, "printing_seconds")},
          {"starvations", f.motion.starvations + f.motion.hasty_stops},
          {"strikes", strikes},
          {"lines_whole", f.comparison.lines_whole()}};
}

json material_of(const DryRunFindings& f) {
  json material = used_filament_json(f.books.totals(), f.books.job().profile);
  material["grade"] = material_limits.grade(f.comparison.worst_error);
  material["worst_error"] = f.comparison.worst_error;
  return material;
}

json gaps_of(const DepositFindings& laid) {
  return {{"grade", gaps_limits.grade(std::max(laid.gap_fraction(), laid.overfill_fraction()))},
          {"fraction", laid.gap_fraction()},
          {"overfill_fraction", laid.overfill_fraction()},
          {"area_mm2", laid.area}};
}

/// Of the area whose mixture is judged.
double wrong_share(const DepositFindings& laid) {
  const double judged = laid.area - laid.transition;
  return judged > 0 ? laid.wrong / judged : 0;
}

json colours_of(const DepositFindings& laid) {
  json colours = {{"grade", colour_limits.grade(wrong_share(laid))},
                  {"fraction", wrong_share(laid)},
                  {"area_mm2", laid.wrong}};
  if (laid.wrong_distance.area() > 0) colours["within_mm"] = laid.wrong_distance.percentile(0.9);
  return colours;
}

/// The number of the picture deposit-NNNN.png that shows the layer with this top.
std::optional<std::size_t> deposit_at(const json& simulator, double top, double height) {
  const auto layers = simulator.find("layers");
  if (layers == simulator.end() || !layers->is_array()) return std::nullopt;
  for (std::size_t i = 0; i < layers->size(); ++i) {
    if (std::abs(number_in((*layers)[i], "z") - top) < height / 4) return i;
  }
  return std::nullopt;
}

json layers_of(const DryRunFindings& f) {
  json layers = json::array();
  for (const auto& [index, drawn] : f.laid.drawn()) {
    const DepositFindings& found = f.laid.layers().at(index);
    json layer = {{"layer", index},
                  {"top_mm", drawn.top},
                  {"gaps", found.gap_fraction()},
                  {"overfill", found.overfill_fraction()},
                  {"colours", wrong_share(found)},
                  {"place", to_json(drawn.place)}};
    if (const auto deposit = deposit_at(f.simulator, drawn.top, drawn.height)) layer["deposit"] = *deposit;
    layers.push_back(std::move(layer));
  }
  return layers;
}

json places_of(const DryRunFindings& f) {
  json places = json::object();
  if (const auto curve = f.books.place_of_curves()) places["curve"] = to_json(*curve);
  if (const auto laid = f.simulator.find("pictures"); laid != f.simulator.end())
    places["deposit"] = {number_in(*laid, "left_mm"), number_in(*laid, "top_mm"),
                         number_in(*laid, "pixel_mm")};
  return places;
}

std::string as_text_of_html(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

/// In a script element: neither its end nor a comment can begin in it.
std::string as_data_of_html(const json& value) {
  std::string safe;
  for (const char c : value.dump(-1, ' ', false, json::error_handler_t::replace)) {
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return safe;
}

}  // namespace

json view_of(const DryRunFindings& f) {
  json worst = json::array();
  for (const WorstPlace& place : f.laid.worst()) worst.push_back(to_json(place));
  return {{"version", 1},
          {"job", f.books.job().file.filename().string()},
          {"printer", f.books.job().profile.printer.name},
          {"ended", name(f.stream.ending)},
          {"time", time_of(f)},
          {"material", material_of(f)},
          {"gaps", gaps_of(f.laid.total())},
          {"colours", colours_of(f.laid.total())},
          {"places", places_of(f)},
          {"layers", layers_of(f)},
          {"worst", worst}};
}

json grades_in(const json& view) {
  json grades = json::object();
  for (const char* figure : {"time", "material", "gaps", "colours"})
    grades[figure] = view.at(figure).at("grade");
  return grades;
}

void remove_view(const std::filesystem::path& folder) {
  std::error_code ignored;
  std::filesystem::remove(folder / view_name, ignored);
  for (const char* file : viewer_files) std::filesystem::remove(folder / file, ignored);
}

void write_view(const std::filesystem::path& folder, const json& view) {
  if (web_files().empty()) return;
  for (const char* file : viewer_files) write_whole_file(folder / file, unpacked(*web_file(file)));
  write_whole_file(folder / view_name, view_html(view));
}

std::string view_html(const json& view) {
  // The name goes through JSON, so that it is valid UTF-8.
  const json name = json::parse(view.at("job").dump(-1, ' ', false, json::error_handler_t::replace));
  return R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>)" +
         as_text_of_html(name.get<std::string>()) + R"(</title>
<link rel="icon" href="data:,">
<link rel="stylesheet" href="viewer.css">
<script type="application/json" id="dry-run">)" +
         as_data_of_html(view) + R"(</script>
<script src="viewer.js" defer></script>
</head>
<body>
<noscript>This page needs JavaScript; the pictures beside it do not.</noscript>
</body>
</html>
)";
}

}  // namespace unicursal::host
