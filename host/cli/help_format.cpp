#include "host/cli/help_format.hpp"

#include <unistd.h>

#include <algorithm>
#include <sstream>

#include "host/cli/columns.hpp"
#include "host/cli/terminal_look.hpp"

namespace unicursal::host {
namespace {

constexpr std::size_t usual_first_column = 28;
constexpr std::size_t narrow_first_column = 6;  ///< below their names

struct Measures {
  std::size_t line_width = 90;
  std::size_t first_column = usual_first_column;  ///< of descriptions
};

/// Texts wider than 90 columns are hard to read, and in a narrow window descriptions need the whole width.
const Measures& measures() {
  static const Measures found = [] {
    constexpr std::size_t narrowest = 40, narrow = 70;
    Measures m;
    if (isatty(STDOUT_FILENO) == 1)
      m.line_width = std::clamp(terminal_width(STDOUT_FILENO), narrowest, m.line_width);
    if (m.line_width < narrow) m.first_column = narrow_first_column;
    return m;
  }();
  return found;
}

/// Breaks the text at blanks. Each line after the first begins with `indent` blanks; the first one is taken
/// to stand in that column already.
std::string indented(const std::string& text, std::size_t indent) {
  std::istringstream words(text);
  std::string result, word;
  std::size_t column = indent;
  while (words >> word) {
    const bool first = result.empty();
    if (!first && column + 1 + columns(word) > measures().line_width) {
      result += '\n' + std::string(indent, ' ');
      column = indent;
    } else if (!first) {
      result += ' ';
      ++column;
    }
    result += word;
    column += columns(word);
  }
  return result;
}

}  // namespace

std::string help_entry(const std::string& name, const std::string& description) {
  const std::size_t first_column = measures().first_column;
  std::string line = "  " + name;
  if (columns(line) + 2 > first_column)
    line += '\n' + std::string(first_column, ' ');
  else
    line += std::string(first_column - columns(line), ' ');
  return line + indented(description, first_column) + '\n';
}

std::string help_paragraph(const std::string& text) {
  return indented(text, 0) + '\n';
}

HelpFormat::HelpFormat() {
  column_width(measures().first_column);
}

std::string HelpFormat::make_option(const CLI::Option* option, bool is_positional) const {
  return help_entry(make_option_name(option, is_positional) + make_option_opts(option),
                    make_option_desc(option));
}

std::string HelpFormat::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
  // CLI11 leaves two empty lines between groups.
  return CLI::detail::find_and_replace(CLI::Formatter::make_help(app, std::move(name), mode), "\n\n\n",
                                       "\n\n");
}

std::string HelpFormat::make_description(const CLI::App* app) const {
  return help_paragraph(app->get_description());
}

std::string HelpFormat::make_subcommand(const CLI::App* command) const {
  return help_entry(command->get_name(), command->get_description());
}

std::string HelpFormat::make_footer(const CLI::App* app) const {
  std::istringstream lines(app->get_footer());
  std::string result;
  for (std::string line; std::getline(lines, line);)
    result += (line.starts_with(' ') ? line : indented(line, 0)) + '\n';
  return result;
}

}  // namespace unicursal::host
