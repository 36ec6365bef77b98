#include "host/job/written_job.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;

using gcode::Shares;

}  // namespace

std::string name_in_job(const fs::path& file, fs::path folder) {
  if (folder.empty()) folder = ".";
  const fs::path relative =
      fs::absolute(file).lexically_normal().lexically_relative(fs::absolute(folder).lexically_normal());
  const bool below = !relative.empty() && *relative.begin() != "..";
  return (below ? relative : fs::absolute(file).lexically_normal()).string();
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
