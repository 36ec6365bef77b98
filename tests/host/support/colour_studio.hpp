// A printer that mixes by other optics than the program's (other_optics.hpp): its profile, its chart, what a
// colorimeter says of the patches, and how far requests by colour then miss.
#pragma once

#include <fcntl.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "core/picture/hex_colour.hpp"
#include "host/job/colour_mixture.hpp"
#include "host/job/profile.hpp"
#include "host/tune/chart.hpp"
#include "sim/bed/raster.hpp"
#include "tests/core/picture/other_optics.hpp"
#include "tests/host/support/child_process.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal::test {

inline constexpr const char* studio_machine = R"([printer]
name = "Diamond"   # an old one
bed = [200.0, 200.0, 200.0]
nozzle = 0.6
bead_width_range = [0.36, 1.6]
)";

struct ColourStudio {
  explicit ColourStudio(const std::vector<Dye>& dyes, unsigned seed = 1)
      : random(seed), optics(pigments(dyes, random)), text(studio_machine) {
    for (std::size_t f = 0; f < dyes.size(); ++f)
      text += "\n[[filament]]   # spool " + std::to_string(f + 1) + "\ncolour = \"" +
              picture::hex_of(picture::colour_of(optics.pure(f))) + "\" # as its maker says\n";
    profile = folder.write("diamond.toml", text).string();
    chart = host::make_chart(host::load_profile(profile).printer, 0);
  }

  static std::vector<Pigments> pigments(const std::vector<Dye>& dyes, std::mt19937& random) {
    std::vector<Pigments> all;
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

  TempFolder folder;
  std::mt19937 random;
  OtherOptics optics;
  std::string text, profile;
  host::Chart chart;
};

/// The mean shares in the middles of the patches, on the last layer.
inline std::vector<std::vector<double>> shares_on(const std::filesystem::path& rasters,
                                                  const host::Chart& chart) {
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

}  // namespace unicursal::test
