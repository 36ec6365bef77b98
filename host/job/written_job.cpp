#include "host/job/written_job.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/picture/filaments.hpp"

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;

constexpr int share_steps = 20;  ///< mixtures are tried in steps of 1/20

using Shares = std::vector<double>;

/// All mixtures of so many feeders in steps of 1 / share_steps.
void for_each_mixture(int feeders, int left, Shares& shares, const auto& visit) {
  if (feeders == 1) {
    shares.push_back(double(left) / share_steps);
    visit(shares);
    shares.pop_back();
    return;
  }
  for (int n = 0; n <= left; ++n) {
    shares.push_back(double(n) / share_steps);
    for_each_mixture(feeders - 1, left - n, shares, visit);
    shares.pop_back();
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

std::vector<double> mixture_near(const std::string& colour, int feeders) {
  const unsigned long rgb = std::stoul(colour.substr(1), nullptr, 16);
  Shares best, shares;
  double least = 1e300;
  for_each_mixture(std::min(feeders, int(picture::filaments.size())), share_steps, shares,
                   [&](const Shares& tried) {
                     const picture::Colour made = picture::mixed_filaments(tried);
                     const double r = made.r - double(rgb >> 16), g = made.g - double(rgb >> 8 & 255),
                                  b = made.b - double(rgb & 255);
                     const double distance = r * r + g * g + b * b;
                     if (distance < least) least = distance, best = tried;
                   });
  best.resize(std::size_t(feeders), 0);
  return best;
}

std::vector<double> one_feeder(std::size_t which, int feeders) {
  Shares shares(std::size_t(feeders), 0);
  shares[which % shares.size()] = 1;
  return shares;
}

std::string shares_in_toml(const std::vector<double>& shares) {
  std::vector<std::string> words;
  for (const double share : shares) words.push_back(fmt::format("{:.2f}", share));
  return fmt::format("[{}]", fmt::join(words, ", "));
}

}  // namespace unicursal::host
