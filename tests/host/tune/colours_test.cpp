// `unicursal tune colours`: the program itself, and a printer whose plastic mixes by other optics than the
// program's (other_optics.hpp).
#include <fcntl.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "core/picture/hex_colour.hpp"
#include "host/job/colour_mixture.hpp"
#include "host/job/profile.hpp"
#include "host/tune/chart.hpp"
#include "sim/bed/raster.hpp"
#include "tests/core/picture/other_optics.hpp"
#include "tests/host/support/child_process.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal {
namespace {

using test::Dye;
using test::Outcome;
using test::run;

constexpr const char* machine_text = R"([printer]
name = "Diamond"   # an old one
bed = [200.0, 200.0, 200.0]
nozzle = 0.6
bead_width_range = [0.36, 1.6]
)";

struct Studio {
  explicit Studio(const std::vector<Dye>& dyes, unsigned seed = 1)
      : random(seed), optics(pigments(dyes, random)), text(machine_text) {
    for (std::size_t f = 0; f < dyes.size(); ++f)
      text += "\n[[filament]]   # spool " + std::to_string(f + 1) + "\ncolour = \"" +
              picture::hex_of(picture::colour_of(optics.pure(f))) + "\" # as its maker says\n";
    profile = folder.write("diamond.toml", text).string();
    chart = host::make_chart(host::load_profile(profile).printer, 0);
  }

  static std::vector<test::Pigments> pigments(const std::vector<Dye>& dyes, std::mt19937& random) {
    std::vector<test::Pigments> all;
    for (const Dye dye : dyes) all.push_back(pigments_of(dye, random));
    return all;
  }

  /// What a colorimeter says, with noise of a ΔE of about 1.
  std::string measured(const std::vector<std::vector<double>>& shares) {
    std::normal_distribution<double> noise(0, 0.6);
    std::string list = "patch, L, a, b\n";
    for (std::size_t i = 0; i < shares.size(); ++i) {
      const picture::Lab lab = picture::lab_of(optics.light(shares[i]));
      list += std::to_string(i + 1);
      for (const double value : {lab.lightness, lab.a, lab.b})
        list += ", " + std::to_string(value + noise(random));
      list += "\n";
    }
    return list;
  }

  std::vector<std::vector<double>> as_delivered() const {
    std::vector<std::vector<double>> all;
    for (const host::ChartPatch& patch : chart.patches)
      all.emplace_back(patch.mixture.shares().begin(), patch.mixture.shares().end());
    return all;
  }

  Outcome tune(const std::string& list, std::vector<std::string> more = {"--yes"}) const {
    more.insert(more.begin(),
                {"tune", "colours", profile, "--measured", folder.write("list.csv", list).string()});
    return run(more);
  }

  /// Requests by colour, of what these filaments can make: how far what is then printed lies from it.
  double median_miss() {
    const host::Profile used = host::load_profile(profile);
    std::exponential_distribution<double> part(1);
    std::vector<double> far;
    for (int i = 0; i < 21; ++i) {
      std::vector<double> shares(optics.size());
      double sum = 0;
      for (double& share : shares) sum += share = part(random);
      for (double& share : shares) share = 0.02 + (1 - 0.02 * double(shares.size())) * share / sum;
      const picture::Colour wanted = picture::colour_of(optics.light(shares));
      const gcode::Shares found = host::mixture_near(wanted, used).shares;
      far.push_back(
          difference(picture::lab_of(picture::light_of(wanted)),
                     picture::lab_of(optics.light(std::vector<double>(found.begin(), found.end())))));
    }
    std::nth_element(far.begin(), far.begin() + 10, far.end());
    return far[10];
  }

  test::TempFolder folder;
  std::mt19937 random;
  test::OtherOptics optics;
  std::string text, profile;
  host::Chart chart;
};

/// The mean shares in the middles of the patches, on the last layer.
std::vector<std::vector<double>> shares_on(const std::filesystem::path& rasters, const host::Chart& chart) {
  const std::size_t feeders = chart.patches.front().mixture.feeders();
  std::vector<std::vector<double>> shares;
  sim::RasterReader reader(::open(rasters.c_str(), O_RDONLY | O_CLOEXEC));
  while (const auto frame = reader.next()) {
    shares.assign(chart.patches.size(), std::vector<double>(feeders));
    std::vector<double> count(chart.patches.size());
    std::vector<sim::RasterPixel> pixels(frame->columns);
    for (std::uint64_t row = 0; row < frame->rows; ++row) {
      reader.read_row(pixels);
      const double y = frame->bottom + (double(row) + 0.5) * frame->pixel;
      for (std::size_t i = 0; i < chart.patches.size(); ++i) {
        const core::Box& box = chart.patches[i].middle;
        if (y < box.min.y() || y > box.max.y()) continue;
        for (double x = box.min.x(); x < box.max.x(); x += frame->pixel) {
          const sim::RasterPixel& pixel = pixels.at(std::size_t((x - frame->left) / frame->pixel));
          if (pixel.fill <= 0) continue;
          count[i] += 1;
          for (std::size_t f = 0; f < feeders; ++f) shares[i][f] += pixel.share(f);
        }
      }
    }
    for (std::size_t i = 0; i < shares.size(); ++i)
      for (double& share : shares[i]) share /= count[i];
  }
  return shares;
}

}  // namespace

TEST_CASE("After a chart was printed and measured, colours come out as wanted", "[tuning][optimised]") {
  Studio studio({Dye::blue, Dye::red, Dye::white});
  const std::string rasters = (studio.folder / "rasters").string();
  const Outcome printed = run({"tune", "colours", studio.profile, "--simulate", "--rasters", rasters});
  INFO(printed.out << printed.err);
  REQUIRE(printed.code == 0);
  const auto laid = shares_on(rasters, studio.chart);
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
  Studio studio(dyes, 2);
  const Outcome outcome = studio.tune(studio.measured(studio.as_delivered()));
  INFO(outcome.out << outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(outcome.out.find("stands out") == std::string::npos);
  CHECK(studio.median_miss() < 2);
  const std::string text = test::read_text(studio.profile);
  CHECK(text.find("name = \"Diamond\"   # an old one\n") != std::string::npos);
  CHECK(text.find("# as its maker says\nstrength = [") != std::string::npos);
  CHECK(text.find("\n[colours]\npower = ") != std::string::npos);
  // A second time the keys are replaced, not added.
  REQUIRE(studio.tune(studio.measured(studio.as_delivered())).code == 0);
  const std::string again = test::read_text(studio.profile);
  CHECK(std::count(again.begin(), again.end(), '\n') == std::count(text.begin(), text.end(), '\n'));
  CHECK(studio.median_miss() < 2);
}

TEST_CASE("A spoilt patch is named, and what cannot be right is refused", "[tuning]") {
  Studio studio({Dye::blue, Dye::red, Dye::white});
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
  Studio studio({Dye::blue, Dye::red, Dye::white});
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
  const std::string plain = studio.folder.write("plain.toml", machine_text).string();
  const Outcome nameless = run({"tune", "colours", plain});
  CHECK(nameless.code == 2);
  CHECK(nameless.err.find("write [[filament]] once for each feeder") != std::string::npos);
}

}  // namespace unicursal
