#include "firmware_gcode/mixing/tool_table.hpp"

#include <algorithm>

namespace unicursal::gcode {
namespace {

bool same(const CalibratedMixture& a, const CalibratedMixture& b) {
  return a.delivered == b.delivered;
}

std::vector<CalibratedMixture> different_mixtures(const Palette& palette, std::size_t enough) {
  std::vector<CalibratedMixture> mixtures;
  const auto add = [&](const CalibratedMixture& mixture) {
    const bool known = std::any_of(mixtures.begin(), mixtures.end(),
                                   [&](const CalibratedMixture& other) { return same(other, mixture); });
    if (!known) mixtures.push_back(mixture);
  };
  for (std::size_t material = 0; material < palette.size(); ++material) {
    for (std::size_t step = 0; step < palette.steps_of(material) && mixtures.size() < enough; ++step)
      add(palette.calibrated(Shade{material, step}));
  }
  for (std::size_t i = 0; i < palette.added(); ++i) add(palette.calibrated(Shade{palette.size() + i, 0}));
  return mixtures;
}

}  // namespace

ToolTable::ToolTable(const Dialect& dialect, const Palette& palette, const CalibratedMixture& equal_shares)
    : dialect_(dialect), equal_shares_(equal_shares) {
  const std::size_t most = dialect.limits().virtual_tools;
  const std::vector<CalibratedMixture> mixtures = different_mixtures(palette, most + 1);
  const bool all_fit = mixtures.size() <= most;
  const std::size_t count = std::min(mixtures.size(), all_fit ? most : most - 1);
  if (count < most) retraction_tool_ = count;
  for (std::size_t i = 0; i < count; ++i) tools_.push_back({mixtures[i], 0});
}

std::vector<std::string> ToolTable::define() const {
  std::vector<std::string> lines;
  for (std::size_t tool = 0; tool < size(); ++tool) {
    for (std::string& line : dialect_.define_tool(tool, mixture(tool).written))
      lines.push_back(std::move(line));
  }
  return lines;
}

const CalibratedMixture& ToolTable::mixture(std::size_t tool) const {
  return tool < tools_.size() ? tools_[tool].mixture : equal_shares_;
}

std::size_t ToolTable::use(const CalibratedMixture& mixture, std::vector<std::string>& lines) {
  auto tool =
      std::find_if(tools_.begin(), tools_.end(), [&](const Tool& t) { return same(t.mixture, mixture); });
  if (tool == tools_.end()) {
    tool = std::min_element(tools_.begin(), tools_.end(),
                            [](const Tool& a, const Tool& b) { return a.used < b.used; });
    tool->mixture = mixture;
    const auto index = static_cast<std::size_t>(tool - tools_.begin());
    for (std::string& line : dialect_.define_tool(index, mixture.written)) lines.push_back(std::move(line));
  }
  tool->used = ++uses_;
  return static_cast<std::size_t>(tool - tools_.begin());
}

}  // namespace unicursal::gcode
