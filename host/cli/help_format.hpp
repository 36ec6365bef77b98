// The looks of --help: CLI11's own, but with long texts broken into lines.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace unicursal::host {

class HelpFormat final : public CLI::Formatter {
 public:
  HelpFormat();

  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
  std::string make_subcommand(const CLI::App* command) const override;
  /// Breaks the lines of paragraphs; lines that begin with a space, such as examples and tables, stay whole.
  std::string make_footer(const CLI::App* app) const override;
};

}  // namespace unicursal::host
