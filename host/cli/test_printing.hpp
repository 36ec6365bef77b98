// Where the test prints of `tune` go: to a file, to a printer, or to the simulated printer.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/engine/source.hpp"
#include "host/job/profile.hpp"
#include "sim/bed/raster.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace unicursal::host {

/// What the commands of `tune` have in common.
struct TestOptions {
  std::filesystem::path profile;
  std::optional<std::string> port;
  std::optional<std::filesystem::path> output;  ///< G-code
  bool simulate = false;
  bool yes = false;

  /// `what` is printed, such as "the chart". Returns --simulate.
  CLI::Option* declare(CLI::App& app, const std::string& what);
};

/// Writes the lines of a whole print. Throws core::FileError.
void write_gcode(const FinishedPrint& print, const std::filesystem::path& file);

/// Throws core::DataError if the output would replace one of the inputs.
void expect_other_file(const std::optional<std::filesystem::path>& output,
                       const std::vector<std::optional<std::filesystem::path>>& inputs);

/// `name` is what is printed, such as "the strip". Throws PrintError if the print has failed, and
/// TuningCancelled if the user has stopped it.
void print_test(const std::string& port, const Profile& profile, const FinishedPrint& print,
                const std::string& name);

struct SimulatedTest {
  std::filesystem::path machine;                  ///< profile with the true volumes of the simulated printer
  std::optional<std::size_t> tanks;               ///< of its nozzle
  std::optional<std::filesystem::path> pictures;  ///< folder
  std::optional<std::filesystem::path> rasters;   ///< keeps what it has laid in this file
};

/// Called for each layer; it has to read all rows.
using LayerTaker = std::function<void(const sim::RasterFrame&, sim::RasterReader&)>;

void simulate_test(const SimulatedTest& simulated, const Profile& profile, const FinishedPrint& print,
                   const std::string& name, const LayerTaker& take);
/// Reads a layer and forgets it.
void skip_layer(const sim::RasterFrame& frame, sim::RasterReader& rasters);

/// The volume of a print, mm³, and its seconds.
struct TestAmount {
  double volume = 0, seconds = 0;
};
TestAmount amount_of(const FinishedPrint& print);

}  // namespace unicursal::host
