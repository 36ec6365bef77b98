#include "host/cli/help_format.hpp"

#include <sstream>

namespace unicursal::host {
namespace {

constexpr std::size_t line_width = 90, first_column = 28;

/// Characters, not bytes: the bytes that continue a UTF-8 character do not count.
std::size_t width(const std::string& text) {
  std::size_t count = 0;
  for (const char byte : text) count += (static_cast<unsigned char>(byte) & 0xc0U) != 0x80U;
  return count;
}

/// Breaks the text at blanks. Each line after the first begins with `indent` blanks; the first one is taken
/// to stand in that column already.
std::string wrapped(const std::string& text, std::size_t indent) {
  std::istringstream words(text);
  std::string result, word;
  std::size_t column = indent;
  while (words >> word) {
    const bool first = result.empty();
    if (!first && column + 1 + width(word) > line_width) {
      result += '\n' + std::string(indent, ' ');
      column = indent;
    } else if (!first) {
      result += ' ';
      ++column;
    }
    result += word;
    column += width(word);
  }
  return result;
}

std::string entry(const std::string& name, const std::string& description) {
  std::string line = "  " + name;
  if (width(line) + 2 > first_column)
    line += '\n' + std::string(first_column, ' ');
  else
    line += std::string(first_column - width(line), ' ');
  return line + wrapped(description, first_column) + '\n';
}

}  // namespace

HelpFormat::HelpFormat() {
  column_width(first_column);
}

std::string HelpFormat::make_option(const CLI::Option* option, bool is_positional) const {
  return entry(make_option_name(option, is_positional) + make_option_opts(option), make_option_desc(option));
}

std::string HelpFormat::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
  // CLI11 leaves two empty lines between groups.
  return CLI::detail::find_and_replace(CLI::Formatter::make_help(app, std::move(name), mode), "\n\n\n",
                                       "\n\n");
}

std::string HelpFormat::make_subcommand(const CLI::App* command) const {
  return entry(command->get_name(), command->get_description());
}

std::string HelpFormat::make_footer(const CLI::App* app) const {
  std::istringstream lines(app->get_footer());
  std::string result;
  for (std::string line; std::getline(lines, line);)
    result += (line.starts_with(' ') ? line : wrapped(line, 0)) + '\n';
  return result;
}

}  // namespace unicursal::host
