#include "host/cli/tune_colours.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include "core/error.hpp"
#include "core/picture/hex_colour.hpp"
#include "host/cli/arguments.hpp"
#include "host/cli/photo_corners.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/cli/test_printing.hpp"
#include "host/job/profile.hpp"
#include "host/job/profile_edit.hpp"
#include "host/photo/read_photo.hpp"
#include "host/report/summary.hpp"
#include "host/tune/chart.hpp"
#include "host/tune/chart_fit.hpp"
#include "host/tune/chart_photo.hpp"
#include "host/tune/terminal_reader.hpp"

namespace unicursal::host {
namespace {

constexpr const char* chart_name = "the chart";
constexpr double least_thickness = 0.05, most_thickness = 5;  ///< mm

std::size_t darkest_feeder(const Filaments& filaments) {
  const auto lightness = [](const Filament& filament) {
    return picture::lab_of(picture::light_of(filament.colour)).lightness;
  };
  const auto& all = filaments.of_feeders;
  const auto darkest = std::min_element(all.begin(), all.end(), [&](const Filament& a, const Filament& b) {
    return lightness(a) < lightness(b);
  });
  return static_cast<std::size_t>(darkest - all.begin());
}

/// What is measured is kept in [[filament]].
void expect_filaments(const Profile& profile) {
  if (profile.filaments.listed) return;
  throw core::DataError(profile.file.string(), "filament", "is missing, so that nothing names the colours",
                        "write [[filament]] once for each feeder and below it for example colour = "
                        "\"#2660c4\", see unicursal-profile(5)");
}

ChartFit fit_of_photo(const Chart& chart, const Filaments& filaments, const std::filesystem::path& file,
                      const std::optional<GivenCorners>& corners) {
  const Photo photo = read_photo(file);
  const Sheet sheet(photo, sheet_plan(chart), corners, file);
  return fit_photo(chart, filaments, read_chart(sheet, chart, file));
}

void report(const Chart& chart, const FinishedPrint& print) {
  const auto [volume, seconds] = amount_of(print);
  show(stdout, "chart:     {} patches; {:.0f} mm³ and about {} in all\n", chart.patches.size(), volume,
       duration_words(seconds));
}

void report(const Chart& chart, const ChartFit& fit, const Filaments& before) {
  show(stdout, "patch  mixture                foretold  seen     ΔE, then and now\n");
  for (const FittedPatch& patch : fit.patches) {
    show(stdout, "{:5}  {:21}  {}   {}  {:4.1f} {:5.1f}{}\n", patch.patch + 1,
         shares_text(chart.patches[patch.patch].mixture), picture::hex_of(patch.foretold),
         picture::hex_of(patch.seen), patch.before, patch.after, patch.stands_out ? "  stands out" : "");
  }
  for (std::size_t f = 0; f < before.of_feeders.size(); ++f) {
    const picture::Colour was = before.of_feeders[f].colour, is = fit.filaments.of_feeders[f].colour;
    if (was != is) show(stdout, "feeder {}: {} is {}\n", f + 1, picture::hex_of(was), picture::hex_of(is));
  }
  show(stdout, "median:    a ΔE of {:.1f} before, {:.1f} now\n", fit.before, fit.after);
  const auto outstanding = std::count_if(fit.patches.begin(), fit.patches.end(),
                                         [](const FittedPatch& patch) { return patch.stands_out; });
  if (outstanding > 0)
    show(stdout,
         "What stands out counts little. Look at these patches; measure them again, or leave them "
         "out.\n");
}

}  // namespace

void TuneColours::declare(CLI::App& tune) {
  CLI::App& app = *tune.add_subcommand(
      "colours", "Measure how the filaments mix with a chart and write it to the profile.");
  app_ = &app;
  app.footer(
      "Examples:\n  unicursal tune colours diamond.toml --port auto           print the chart, then:\n"
      "  unicursal tune colours diamond.toml --photo chart.jpg");
  add_note(
      app,
      "The chart shows the filaments alone, each of them twice, and mixtures. Take a photo of it, in even "
      "light and without reflections; the filaments alone show what the light and the camera do to "
      "colours. Or measure its patches, for example with a colorimeter, and write a line for each patch "
      "into a file: its number and \"#rrggbb\", or its number, L, a and b. The command shows how far the "
      "patches lie from what "
      "was foretold, before and now. It changes only the colours and strengths of the profile's "
      "[[filament]] and its [colours], and only after you confirm.");
  constexpr auto printing = "Printing", reading = "Reading", simulated = "Simulated printer";
  CLI::Option* simulate = test_.declare(app, "the chart");
  add_value(app, "--marks", marks_, "FEEDER",
            "Feeder of the marks and numbers, which should stand out from the bed. Default: the darkest.")
      .check(integer_between(1, 8))
      ->group(printing);
  add_value(app, "--thickness", thickness_, "MM",
            "Thickness of the patches. A thin layer shows the bed. Default: 0.8.")
      .check(number_between(least_thickness, most_thickness))
      ->group(printing);
  add_value(app, "--picture", pictures_, "DIR", "Folder for pictures of the simulated chart.")
      .needs(simulate)
      ->group(simulated);
  add_value(app, "--rasters", rasters_, "FILE",
            "Keep what the simulated printer has laid in this file (sim/bed/raster.hpp).")
      .needs(simulate)
      ->group(simulated);
  CLI::Option& measured =
      add_value(app, "--measured", measured_, "FILE", "The measured colours of the chart's patches.");
  measured.group(reading);
  CLI::Option* photo = add_value(app, "--photo", photo_, "FILE",
                                 "Read the chart from this photo, JPEG or PNG. It shows all six round marks, "
                                 "sharp and in even light.")
                           .excludes(&measured)
                           ->excludes(app.get_option("--port"))
                           ->excludes(simulate)
                           ->group(reading);
  add_value(app, "--corners", corners_, "NUMBERS",
            "Where the four corner marks are in the photo, if they are not found: x,y of the front left, "
            "front right, back right and back left one, in pixels. Needs --photo.")
      .needs(photo)
      ->group(reading);
}

bool TuneColours::chosen() const {
  return app_ && app_->parsed();
}

Exit TuneColours::run() const {
  const Profile profile = load_profile(test_.profile);
  const ProfileText text(test_.profile);
  expect_filaments(profile);
  for (const auto& written : {test_.output, rasters_})
    expect_other_file(written, {test_.profile, measured_, photo_});
  corners_in(corners_);
  if (marks_ && *marks_ > profile.printer.feeders)
    throw core::DataError("", "--marks", fmt::format("this printer has no feeder {}", *marks_),
                          fmt::format("choose one of 1 to {}", profile.printer.feeders));
  const Chart chart = make_chart(profile.printer, marks_ ? *marks_ - 1 : darkest_feeder(profile.filaments),
                                 thickness_.value_or(usual_thickness));
  const FinishedPrint print = gcode_of(chart.print, profile.printer);
  report(chart, print);
  try {
    if (test_.output) write_gcode(print, *test_.output);
    if (test_.simulate)
      simulate_test({test_.profile, {}, pictures_, rasters_}, profile, print, chart_name, skip_layer);
    if (test_.port) print_test(*test_.port, profile, print, chart_name);
    if (!measured_ && !photo_) {
      show(stdout,
           "Take a photo of the printed chart, or measure its patches; then run the command again with "
           "--photo or --measured.\n");
      return Exit::success;
    }
    const ChartFit fit =
        photo_ ? fit_of_photo(chart, profile.filaments, *photo_, corners_in(corners_))
               : fit_chart(chart, profile.filaments, read_measured_colours(*measured_, chart.patches.size()),
                           picture::PureColours::fitted);
    report(chart, fit, profile.filaments);
    const std::string question = fmt::format("Write this into {}?", test_.profile.string());
    if (!test_.yes && !confirmed(std::cin, std::cout, question))
      throw TuningCancelled("the result was not accepted");
    text.set(colour_changes(profile.filaments, fit.filaments));
    show(stdout, "written:   {}\n", test_.profile.string());
    return Exit::success;
  } catch (const TuningCancelled& cancelled) {
    show(stdout, "{}; the profile was not changed\n", cancelled.what());
    return Exit::failed;
  }
}

}  // namespace unicursal::host
