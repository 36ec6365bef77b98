// Options that several commands share, and how options are declared. A command or a group of options holds
// the values; CLI11 writes into them while it parses.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "host/engine/prepared_job.hpp"
#include "host/engine/session_types.hpp"
#include "host/report/run_outputs.hpp"
#include "sim/simulator_options.hpp"

namespace unicursal::host {

inline constexpr double any_number = std::numeric_limits<double>::max();
inline constexpr std::uint64_t most_threads = 256;

/// Accepts a number in this range. CLI11's own ranges accept "nan".
CLI::Validator number_between(double least, double most);
/// Accepts an integer in this range. CLI11 itself wraps "-1" around for unsigned values.
CLI::Validator integer_between(std::uint64_t least, std::uint64_t most);
/// Accepts one of these words.
CLI::Validator one_of(const std::vector<std::string>& words);
/// Refuses an empty text, which scripts produce from unset variables.
CLI::Validator not_empty();

/// Adds a command to the program. `group` is the heading below which the help lists it.
CLI::App& add_command(CLI::App& program, const std::string& name, const std::string& group,
                      const std::string& summary, const std::string& example);
/// Adds a paragraph below the example of a command's help.
void add_note(CLI::App& app, const std::string& paragraph);

/// Adds an option, or a positional argument if `names` has no dash. `placeholder` stands for its value in the
/// help.
template <class T>
CLI::Option& add_value(CLI::App& app, const std::string& names, T& value, const std::string& placeholder,
                       const std::string& help) {
  CLI::Option* option = app.add_option(names, value, help)->option_text(placeholder);
  using Plain = std::remove_cvref_t<T>;
  if constexpr (std::is_same_v<Plain, std::string> || std::is_same_v<Plain, std::filesystem::path> ||
                std::is_same_v<Plain, std::optional<std::string>> ||
                std::is_same_v<Plain, std::optional<std::filesystem::path>>) {
    option->check(not_empty());
  }
  return *option;
}
/// The same for an option that may be given several times, with one value each.
template <class T>
CLI::Option& add_values(CLI::App& app, const std::string& names, std::vector<T>& values,
                        const std::string& placeholder, const std::string& help) {
  return *app.add_option(names, values, help)
              ->option_text(placeholder)
              ->take_all()
              ->expected(1)
              ->check(not_empty());
}

/// Parses "3", "3:7", ":7" or "3:"; both ends are included. Throws core::DataError.
LayerRange parse_layers(const std::string& text);

/// The options of commands that take a whole job.
struct JobOptions {
  std::filesystem::path job;
  std::optional<std::filesystem::path> profile;
  std::optional<LayerRange> layers;
  RunOutputs outputs;
  bool quiet = false;         ///< show only warnings, errors and the end
  bool allow_bare = false;    ///< accept layers that stay mostly without plastic
  std::size_t threads = 0;    ///< planning threads; 0: one for each core
  bool look_ahead = true;     ///< switch mixtures ahead of borders
  bool no_tower = false;      ///< leave a slicer's wipe tower out
  bool allow_stops = false;   ///< a slicer's file may wait for a person
  bool full_quality = false;  ///< never plan with less effort to keep up with the nozzle

  void declare(CLI::App& app);
  /// For commands that print a slicer's file as well.
  void declare_sliced(CLI::App& app);
  /// For commands that plan while the printer prints.
  void declare_full_quality(CLI::App& app);
};

/// The options that describe a simulated printer and its faults.
struct SimulatedPrinter {
  std::optional<std::string> personality;  ///< absent: the firmware of the profile
  sim::SimulatorOptions options;

  void declare(CLI::App& app);
  /// Throws core::DataError for options that make no printer.
  void check() const;
};

/// How a print reports its progress.
struct DisplayOptions {
  bool json = false;   ///< events as JSON on standard output
  bool quiet = false;  ///< only warnings, errors and the end, in words
};

void declare_layers(CLI::App& app, std::optional<LayerRange>& layers, const std::string& help);
CLI::Option& declare_port(CLI::App& app, std::optional<std::string>& port, const std::string& otherwise);
void declare_log(CLI::App& app, std::optional<std::filesystem::path>& log);
void declare_spool(CLI::App& app, std::optional<std::filesystem::path>& spool);
void declare_state(CLI::App& app, std::optional<std::filesystem::path>& state);
void declare_events(CLI::App& app, DisplayOptions& display);
void declare_quiet(CLI::App& app, bool& quiet);
void declare_pause_heat(CLI::App& app, PauseHeat& heat);
void declare_tanks(CLI::App& app, std::optional<std::size_t>& tanks);
/// Adds the paragraph on the words that steer a print from its terminal.
void add_steering_note(CLI::App& app);

}  // namespace unicursal::host
