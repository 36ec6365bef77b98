// Options that several commands share, or that one command has many of. A group is declared on a command;
// after parsing it makes what that command takes.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/cli/commands.hpp"

namespace unicursal::host {

/// CLI11 keeps options in plain values; empty means that the option was not given.
std::optional<std::filesystem::path> path_if(const std::string& text);
std::optional<std::string> text_if(const std::string& text);

/// CLI11's own ranges let "nan" pass.
CLI::Validator finite_number(double least, double most);

inline constexpr double most_threads = 256;

/// Which job, and what comes out beside the print.
struct JobArguments {
  std::string job, profile, layers, report, pictures;
  bool no_look_ahead = false, full_quality = false;
  std::size_t threads = 0;

  void declare(CLI::App& app);
  /// For commands that plan while the printer prints.
  void declare_full_quality(CLI::App& app);
  JobOptions options() const;
};

/// Which printer is simulated, and what goes wrong with it.
struct PrinterArguments {
  std::string personality, usb = "cdc", fault_file;
  std::vector<std::string> faults;
  std::uint64_t seed = 0;
  std::size_t tanks = 0;
  CLI::Option* seed_given[2] = {nullptr, nullptr};

  void declare(CLI::App& app);
  bool chosen() const { return !personality.empty(); }
  void apply(sim::SimulatorOptions& options) const;
};

/// What kinds of faults there are, for the end of a command's help.
std::string fault_footer();

/// Of `tune transition`.
struct TuneArguments {
  TuneCommand command;
  std::size_t from = 1, to = 2;  ///< counted from 1, as people do
  std::string profile, output, port, machine, pictures;
  CLI::App* app = nullptr;

  void declare(CLI::App& parent);
  TuneCommand finished() const;

 private:
  void declare_strip();
  void declare_ways();
  void declare_reading();
};

}  // namespace unicursal::host
