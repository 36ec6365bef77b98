// The looks of --help: CLI11's own, but with long texts broken into lines that fit the terminal's window; 90
// columns elsewhere.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace unicursal::host {

/// A name with its description beside or below it.
std::string help_entry(const std::string& name, const std::string& description);
std::string help_paragraph(const std::string& text);

class HelpFormat final : public CLI::Formatter {
 public:
  HelpFormat();

  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
  std::string make_description(const CLI::App* app) const override;
  std::string make_subcommand(const CLI::App* command) const override;
  /// Breaks the lines of paragraphs; lines that begin with a space, such as examples and tables, stay whole.
  std::string make_footer(const CLI::App* app) const override;
};

}  // namespace unicursal::host
