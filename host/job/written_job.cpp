#include "host/job/written_job.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;

using gcode::Shares;

constexpr int share_steps = 20;  ///< mixtures are tried in steps of 1/20
constexpr int most_mixed = 4;    ///< feeders in a mixture; four filaments reach all colours between them

/// All mixtures in steps of 1 / share_steps of at most `more` feeders from `feeder` on.
void for_each_mixture(std::size_t feeder, int more, int left, Shares& shares, const auto& visit) {
  if (feeder + 1 == shares.size()) {
    shares[feeder] = double(left) / share_steps;
    if (more > 0 || left == 0) visit(shares);
    return;
  }
  for (int n = 0; n <= (more > 0 ? left : 0); ++n) {
    shares[feeder] = double(n) / share_steps;
    for_each_mixture(feeder + 1, more - (n > 0 ? 1 : 0), left - n, shares, visit);
  }
}

}  // namespace

std::string name_in_job(const fs::path& file, fs::path folder) {
  if (folder.empty()) folder = ".";
  const fs::path relative =
      fs::absolute(file).lexically_normal().lexically_relative(fs::absolute(folder).lexically_normal());
  const bool below = !relative.empty() && *relative.begin() != "..";
  return (below ? relative : fs::absolute(file).lexically_normal()).string();
}

Shares mixture_near(const std::string& colour, const Filaments& filaments) {
  const unsigned long rgb = std::stoul(colour.substr(1), nullptr, 16);
  Shares best, shares = Shares::zeros(filaments.of_feeders.size());
  const picture::Filaments colours = filaments.colours();
  double least = 1e300;
  for_each_mixture(0, most_mixed, share_steps, shares, [&](const Shares& tried) {
    const picture::Colour made = picture::colour_of(tried, colours);
    const double r = made.r - double(rgb >> 16), g = made.g - double(rgb >> 8 & 255),
                 b = made.b - double(rgb & 255);
    const double distance = r * r + g * g + b * b;
    if (distance < least) least = distance, best = tried;
  });
  return best;
}

Shares one_feeder(std::size_t which, std::size_t feeders) {
  Shares shares = Shares::zeros(feeders);
  shares[which % shares.size()] = 1;
  return shares;
}

std::string shares_in_toml(const Shares& shares) {
  std::vector<std::string> words;
  for (const double share : shares) words.push_back(fmt::format("{:.2f}", share));
  return fmt::format("[{}]", fmt::join(words, ", "));
}

}  // namespace unicursal::host
