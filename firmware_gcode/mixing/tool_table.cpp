#include "firmware_gcode/mixing/tool_table.hpp"

#include <algorithm>

namespace unicursal::gcode {
namespace {

const Mixture equal_shares({1, 1, 1});

std::vector<Mixture> different_mixtures(const Palette& palette, std::size_t enough) {
  std::vector<Mixture> mixtures;
  for (std::size_t material = 0; material < palette.size(); ++material) {
    for (std::size_t step = 0; step < palette.steps_of(material) && mixtures.size() < enough; ++step) {
      const Mixture& mixture = palette.mixture(Shade{material, step});
      if (std::find(mixtures.begin(), mixtures.end(), mixture) == mixtures.end()) mixtures.push_back(mixture);
    }
  }
  for (std::size_t i = 0; i < palette.added(); ++i) {
    const Mixture& mixture = palette.mixture(Shade{palette.size() + i, 0});
    if (std::find(mixtures.begin(), mixtures.end(), mixture) == mixtures.end()) mixtures.push_back(mixture);
  }
  return mixtures;
}

}  // namespace

ToolTable::ToolTable(const Dialect& dialect, const Palette& palette,
                     const std::array<double, max_feeders>& factors)
    : dialect_(dialect), factors_(factors) {
  const std::size_t most = dialect.limits().virtual_tools;
  std::vector<Mixture> mixtures = different_mixtures(palette, most + 1);
  const bool all_fit = mixtures.size() <= most;
  const std::size_t count = std::min(mixtures.size(), all_fit ? most : most - 1);
  if (count < most) retraction_tool_ = count;
  for (std::size_t i = 0; i < count; ++i) tools_.push_back({mixtures[i], 0});
}

std::vector<std::string> ToolTable::define() const {
  std::vector<std::string> lines;
  const auto append = [&](std::size_t tool, const Mixture& mixture) {
    for (std::string& line : dialect_.define_tool(tool, written(mixture).written))
      lines.push_back(std::move(line));
  };
  for (std::size_t i = 0; i < tools_.size(); ++i) append(i, tools_[i].mixture);
  if (retraction_tool_) append(*retraction_tool_, equal_shares);
  return lines;
}

double ToolTable::scale(std::size_t tool) const {
  return written(tool < tools_.size() ? tools_[tool].mixture : equal_shares).scale;
}

std::size_t ToolTable::use(const Mixture& mixture, std::vector<std::string>& lines) {
  auto tool = std::find_if(tools_.begin(), tools_.end(), [&](const Tool& t) { return t.mixture == mixture; });
  if (tool == tools_.end()) {
    tool = std::min_element(tools_.begin(), tools_.end(),
                            [](const Tool& a, const Tool& b) { return a.used < b.used; });
    tool->mixture = mixture;
    const auto index = static_cast<std::size_t>(tool - tools_.begin());
    for (std::string& line : dialect_.define_tool(index, written(mixture).written))
      lines.push_back(std::move(line));
  }
  tool->used = ++uses_;
  return static_cast<std::size_t>(tool - tools_.begin());
}

}  // namespace unicursal::gcode
