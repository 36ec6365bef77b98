#include "host/cli/tune_flow.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "host/cli/arguments.hpp"
#include "host/cli/terminal_output.hpp"
#include "host/cli/test_printing.hpp"
#include "host/job/profile.hpp"
#include "host/job/profile_edit.hpp"
#include "host/report/summary.hpp"
#include "host/tune/flow_test.hpp"
#include "host/tune/terminal_reader.hpp"

namespace unicursal::host {
namespace {

constexpr const char* lines_name = "the test print";
constexpr double least_mark = 110, farthest_mark = 1000;  ///< mm
constexpr double most_fed = 1.05;                         ///< of what is asked for
constexpr double doubt = 0.7;                             ///< mm, of two readings of a ruler

/// What is left between inlet and mark, a number for each feeder.
gcode::PerFeeder left_in(const std::string& text, std::size_t feeders) {
  const char* const remedy = "write the mm that are left at each feeder, with commas, such as 21.5,19,20.5";
  std::vector<double> left;
  std::istringstream fields(text);
  for (std::string field; std::getline(fields, field, ',');) {
    const std::optional<double> number = typed_number(field);
    if (!number || left.size() == gcode::most_feeders)
      throw core::DataError("", "--measured", "is not a list of numbers", remedy);
    left.push_back(*number);
  }
  if (left.size() != feeders)
    throw core::DataError("", "--measured",
                          fmt::format("has {} numbers, but there are {} feeders", left.size(), feeders),
                          remedy);
  return gcode::PerFeeder::of(left);
}

/// A mark that has gone into its feeder cannot be read; a feeder may feed more than it is asked for.
void check_mark(double mark, const gcode::PerFeeder& asked) {
  const double most = *std::max_element(asked.begin(), asked.end());
  const double least = std::ceil(most_fed * most);
  if (mark >= most_fed * most) return;
  throw core::DataError(
      "", "--mark", fmt::format("{:g} mm is too near: the print takes {:.0f} mm of filament", mark, most),
      fmt::format("put the marks {:g} mm before the feeders, and add --mark {:g}", least, least));
}

gcode::PerFeeder ask_left(std::size_t feeders, double mark) {
  gcode::PerFeeder left = gcode::PerFeeder::zeros(feeders);
  std::cout << "Measure from the inlet of each feeder to the mark on its filament. q quits.\n";
  for (std::size_t f = 0; f < feeders; ++f) {
    const std::string question = fmt::format("How many mm are left at feeder {}?", f + 1);
    left[f] = asked_number(std::cin, std::cout, question, 0, mark);
  }
  return left;
}

void report(const FlowTest& test, const gcode::PerFeeder& went_in, const gcode::PerFeeder& factors) {
  show(stdout, "feeder  asked for  went in   flow factor\n");
  for (std::size_t f = 0; f < factors.size(); ++f) {
    show(stdout, "{:6}  {:6.1f} mm  {:5.1f} mm  {:.3f}, give or take {:.3f}\n", f + 1, test.asked[f],
         went_in[f], factors[f], factors[f] * doubt / went_in[f]);
  }
}

std::string list_of(const gcode::PerFeeder& factors) {
  std::vector<std::string> words;
  for (const double factor : factors) words.push_back(fmt::format("{:.3f}", factor));
  return fmt::format("[{}]", fmt::join(words, ", "));
}

}  // namespace

void TuneFlow::declare(CLI::App& tune) {
  CLI::App& app = *tune.add_subcommand(
      "flow", "Measure how far each feeder's filament goes and write flow factors to the profile.");
  app_ = &app;
  app.footer(
      "Examples:\n  unicursal tune flow diamond.toml --port auto\n"
      "  unicursal tune flow diamond.toml -o flow.gcode      print this file, then:\n"
      "  unicursal tune flow diamond.toml --measured 21.5,19,20.5");
  add_note(
      app,
      "Before the print, put a mark on each filament, 120 mm before it enters its feeder. The print lays "
      "lines of each feeder alone, some 100 mm of its filament. Then measure from the inlet to the mark "
      "again. With a ruler a factor is known to about 0.7 %. The command changes only "
      "extruder.flow_factors of the profile, and only after you confirm.");
  constexpr auto reading = "Reading";
  test_.declare(app, "the lines");
  add_value(app, "--mark", mark_, "MM",
            "Distance of the marks from the inlets before the print. Default: 120.")
      .check(number_between(least_mark, farthest_mark))
      ->group(reading);
  add_value(app, "--measured", measured_, "MM,...",
            "What is left of this distance after the print, one number for each feeder.")
      .group(reading);
}

bool TuneFlow::chosen() const {
  return app_ && app_->parsed();
}

Exit TuneFlow::run() const {
  const Profile profile = load_profile(test_.profile);
  const ProfileText text(test_.profile);
  expect_other_file(test_.output, {test_.profile});
  const std::size_t feeders = profile.printer.feeders;
  std::optional<gcode::PerFeeder> left;
  if (measured_) left = left_in(*measured_, feeders);
  const FlowTest test = make_flow_test(profile.printer);
  check_mark(mark_, test.asked);
  const FinishedPrint print = gcode_of(test.print, test.printer);
  const auto [volume, seconds] = amount_of(print);
  show(stdout, "lines:     {} feeders, {:.0f} mm³ and about {} in all\n", feeders, volume,
       duration_words(seconds));
  if (test.scripts_shortened)
    show(stdout,
         "Lines of gcode.start and gcode.end that feed filament are left out, since they would be measured "
         "too.\n");
  try {
    if (test_.output) write_gcode(print, *test_.output);
    const bool printed = test_.simulate || test_.port;
    if (test_.port && !measured_) {
      const std::string question =
          fmt::format("Is there a mark on each filament, {:g} mm before its feeder?", mark_);
      if (!test_.yes && !confirmed(std::cin, std::cout, question))
        throw TuningCancelled("nothing was printed");
    }
    if (test_.simulate) {
      Profile plain = profile;
      plain.printer = test.printer;
      simulate_test({test_.profile, {}, {}, {}}, plain, print, lines_name, skip_layer);
    }
    if (test_.port) {
      Profile plain = profile;
      plain.printer = test.printer;
      print_test(*test_.port, plain, print, lines_name);
    }
    if (test_.output && !printed && !left) {
      show(stdout,
           "Put a mark on each filament, {:g} mm before its feeder, and print this file. Then run the "
           "command again without -o to enter what is left of this distance.\n",
           mark_);
      return Exit::success;
    }
    if (!left) left = ask_left(feeders, mark_);
    gcode::PerFeeder went_in = *left;
    for (double& length : went_in) length = mark_ - length;
    const gcode::PerFeeder factors = flow_factors(test.asked, went_in);
    report(test, went_in, factors);
    const std::string question = fmt::format("Write these factors into {}?", test_.profile.string());
    if (!test_.yes && !confirmed(std::cin, std::cout, question))
      throw TuningCancelled("the result was not accepted");
    const std::vector<ProfileChange> change{{"extruder", {}, "flow_factors", list_of(factors), "feeders"}};
    text.set(change);
    show(stdout, "written:   {}\n", test_.profile.string());
    return Exit::success;
  } catch (const TuningCancelled& cancelled) {
    show(stdout, "{}; the profile was not changed\n", cancelled.what());
    return Exit::failed;
  }
}

}  // namespace unicursal::host
