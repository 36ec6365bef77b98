// `unicursal tune colours`: the program itself, and a printer whose plastic mixes by other optics than the
// program's (other_optics.hpp).
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/host/support/colour_studio.hpp"

namespace unicursal {
namespace {

using test::ColourStudio;
using test::Dye;
using test::Outcome;
using test::run;

}  // namespace

TEST_CASE("After a chart was printed and measured, colours come out as wanted", "[tuning][optimised]") {
  ColourStudio studio({Dye::blue, Dye::red, Dye::white});
  const std::string rasters = (studio.folder / "rasters").string();
  const Outcome printed = run({"tune", "colours", studio.profile, "--simulate", "--rasters", rasters});
  INFO(printed.out << printed.err);
  REQUIRE(printed.code == 0);
  const auto laid = test::shares_on(rasters, studio.chart);
  REQUIRE(laid.size() == 19);
  const auto wanted = studio.as_delivered();
  for (std::size_t i = 0; i < laid.size(); ++i)
    for (std::size_t f = 0; f < 3; ++f) CHECK(laid[i][f] == Approx(wanted[i][f]).margin(0.01));
  const double before = studio.median_miss();
  const Outcome tuned = studio.tune(studio.measured(laid));
  INFO(tuned.out << tuned.err);
  REQUIRE(tuned.code == 0);
  CHECK(before > 2.5);
  CHECK(studio.median_miss() < 2);
}

TEST_CASE("Measured charts of several sets of filaments change the profile, and only what they should",
          "[tuning]") {
  const std::vector<Dye> dyes = GENERATE(std::vector<Dye>{Dye::yellow, Dye::blue},
                                         std::vector<Dye>{Dye::cyan, Dye::magenta, Dye::yellow},
                                         std::vector<Dye>{Dye::white, Dye::black, Dye::red, Dye::yellow});
  ColourStudio studio(dyes, 2);
  const Outcome outcome = studio.tune(studio.measured(studio.as_delivered()));
  INFO(outcome.out << outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(outcome.out.find("stands out") == std::string::npos);
  CHECK(studio.median_miss() < 2);
  const std::string text = test::read_text(studio.profile);
  CHECK(text.find("name = \"Diamond\"   # an old one\n") != std::string::npos);
  CHECK(text.find("# as its maker says\nstrength = [") != std::string::npos);
  CHECK(text.find("\n[colours]\nlift = ") != std::string::npos);
  // A second time the keys are replaced, not added.
  REQUIRE(studio.tune(studio.measured(studio.as_delivered())).code == 0);
  const std::string again = test::read_text(studio.profile);
  CHECK(std::count(again.begin(), again.end(), '\n') == std::count(text.begin(), text.end(), '\n'));
  CHECK(studio.median_miss() < 2);
}

TEST_CASE("A spoilt patch is named, and what cannot be right is refused", "[tuning]") {
  ColourStudio studio({Dye::blue, Dye::red, Dye::white});
  const auto delivered = studio.as_delivered();
  std::vector<std::string> lines(1);
  for (const char c : studio.measured(delivered)) {
    if (c == '\n') lines.emplace_back();
    if (c != '\n') lines.back() += c;
  }
  const auto joined = [&] {
    std::string list;
    for (const std::string& line : lines) list += line + "\n";
    return list;
  };
  const auto mixed = std::find_if(studio.chart.patches.begin(), studio.chart.patches.end(),
                                  [](const host::ChartPatch& patch) { return !patch.feeder; });
  const auto spoilt = static_cast<std::size_t>(mixed - studio.chart.patches.begin());
  const auto pure = static_cast<std::size_t>(
      std::find_if(studio.chart.patches.begin(), studio.chart.patches.end(),
                   [](const host::ChartPatch& patch) { return patch.feeder.has_value(); }) -
      studio.chart.patches.begin());
  SECTION("a spoilt mixture") {
    lines[spoilt + 1] = std::to_string(spoilt + 1) + ", #00ff00";
    const Outcome outcome = studio.tune(joined());
    INFO(outcome.out << outcome.err);
    CHECK(outcome.code == 0);
    CHECK(outcome.out.find("stands out\n") != std::string::npos);
    CHECK(studio.median_miss() < 2);
    return;
  }
  std::string complaint;
  SECTION("two patches of one filament differ") {
    lines[pure + 1] = std::to_string(pure + 1) + ", #00ff00";
    complaint = "are both of feeder 1 alone";
  }
  SECTION("too few patches") {
    lines.resize(5);
    complaint = "too few patches";
  }
  SECTION("all patches alike") {
    for (std::size_t i = 0; i < delivered.size(); ++i) lines[i + 1] = std::to_string(i + 1) + ", #808080";
    complaint = "too much alike";
  }
  SECTION("the mixtures in the wrong order") {
    std::vector<std::size_t> mixtures;
    for (std::size_t i = 0; i < delivered.size(); ++i)
      if (!studio.chart.patches[i].feeder) mixtures.push_back(i);
    const std::vector<std::string> kept = lines;
    for (std::size_t i = 0; i < mixtures.size(); ++i) {
      const std::string& other = kept[mixtures[(i + 5) % mixtures.size()] + 1];
      lines[mixtures[i] + 1] = std::to_string(mixtures[i] + 1) + other.substr(other.find(','));
    }
    complaint = "cannot be explained";
  }
  const Outcome outcome = studio.tune(joined());
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 2);
  CHECK(outcome.err.find(complaint) != std::string::npos);
  CHECK(test::read_text(studio.profile) == studio.text);
}

TEST_CASE("The chart is written as G-code, and nothing changes without consent", "[tuning]") {
  ColourStudio studio({Dye::blue, Dye::red, Dye::white});
  const std::string file = (studio.folder / "chart.gcode").string();
  const Outcome written = run({"tune", "colours", studio.profile, "-o", file});
  CHECK(written.code == 0);
  CHECK(written.out.find("19 patches") != std::string::npos);
  CHECK(test::read_text(file).find("a chart of 19 mixtures") != std::string::npos);
  const Outcome unanswered = studio.tune(studio.measured(studio.as_delivered()), {});
  CHECK(unanswered.code == 1);
  CHECK(unanswered.out.find("the profile was not changed") != std::string::npos);
  const std::vector<std::vector<std::string>> wrong = {{"--marks", "4"},
                                                       {"-o", studio.profile},
                                                       {"--measured", (studio.folder / "none").string()},
                                                       {"--picture", "x"},
                                                       {"--simulate", "--port", "auto"}};
  for (std::vector<std::string> more : wrong) {
    more.insert(more.begin(), {"tune", "colours", studio.profile});
    const Outcome refused = run(more);
    INFO(refused.out << refused.err);
    CHECK(refused.code == 2);
  }
  CHECK(test::read_text(studio.profile) == studio.text);
  const std::string plain = studio.folder.write("plain.toml", test::studio_machine).string();
  const Outcome nameless = run({"tune", "colours", plain});
  CHECK(nameless.code == 2);
  CHECK(nameless.err.find("write [[filament]] once for each feeder") != std::string::npos);
}

}  // namespace unicursal
