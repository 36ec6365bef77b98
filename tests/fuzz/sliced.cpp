#include "tests/fuzz/sliced.hpp"

#include <cmath>
#include <fstream>
#include <stdexcept>

#include "core/error.hpp"
#include "firmware_gcode/remix/remix.hpp"
#include "tests/firmware_gcode/support/sliced_block.hpp"
#include "tests/fuzz/damage.hpp"

namespace unicursal::test {
namespace {

gcode::test::BlockOptions random_options(core::Random& random) {
  gcode::test::BlockOptions options;
  options.style = gcode::test::styles[random.below(std::size(gcode::test::styles))];
  options.tools = 1 + static_cast<int>(random.below(3));
  options.layers = 1 + random.below(4);
  options.absolute_filament = random.below(2) == 0;
  options.relative_positions = random.below(4) == 0;
  options.tower = options.style == gcode::test::Style::prusaslicer && random.below(2) == 0;
  options.ramming = random.below(2) == 0;
  return options;
}

}  // namespace

void sliced(const std::filesystem::path& folder, core::Random& random) {
  const std::filesystem::path name = folder / "part.gcode";
  std::ofstream(name, std::ios::binary)
      << damaged(gcode::test::sliced_block(random_options(random)).text, random);
  gcode::Printer printer;
  printer.dead_volume = 0.5 + static_cast<double>(random.below(10));
  printer.mixing_volume = static_cast<double>(random.below(20));
  std::ifstream first(name, std::ios::binary), second(name, std::ios::binary);
  gcode::SlicedLimits limits;
  limits.allow_stops = random.below(2) == 0;
  const gcode::SlicedSurvey survey = gcode::survey_sliced(first, name.string(), printer, limits);
  gcode::RemixSettings settings;
  settings.limits = limits;
  settings.leave_out_tower = random.below(2) == 0;
  settings.hide = random.below(4) != 0;
  settings.look_ahead = random.below(4) != 0;
  for (const gcode::SlicedTool& tool : survey.tools) {
    gcode::Shares shares = gcode::Shares::zeros(3);
    shares[settings.materials.size() % 3] = 1;
    settings.tools[tool.number] = settings.materials.size();
    settings.materials.push_back({"m", gcode::Mixture(shares)});
    if (settings.materials.size() > 20) return;
  }
  // What the survey has accepted is printed to its end.
  gcode::Remix remix(second, name.string(), printer, survey, settings);
  double volume = 0;
  const auto take = [&](const gcode::Chunk& chunk) {
    volume += chunk.volume;
    for (const std::string& line : chunk.lines) {
      if (line.find_first_of("\n\r") != std::string::npos) throw std::runtime_error("a line holds two");
    }
  };
  try {
    take(remix.start());
    while (const auto chunk = remix.next()) take(*chunk);
    take(remix.finish(random.below(2) == 0));
  } catch (const core::DataError& error) {
    throw std::runtime_error(std::string("refused after the survey: ") + error.what());
  }
  if (!std::isfinite(volume) || volume > survey.volume * (1 + 1e-6) + 1)
    throw std::runtime_error("more plastic than the file has");
}

}  // namespace unicursal::test
