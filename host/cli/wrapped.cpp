#include "host/cli/wrapped.hpp"

#include <algorithm>

#include "host/cli/columns.hpp"

namespace unicursal::host {
namespace {

/// Takes the blanks at the beginning of the line, and the word after them.
std::string_view take_word(std::string_view& line) {
  std::size_t end = std::min(line.find_first_not_of(' '), line.size());
  for (; end < line.size() && line[end] != ' '; ++end) {
    if (line[end] != '`') continue;
    const std::size_t other = line.find('`', end + 1);
    if (other != std::string_view::npos) end = other;
  }
  const std::string_view word = line.substr(0, end);
  line.remove_prefix(end);
  return word;
}

std::string wrapped_line(std::string_view line, std::size_t width) {
  if (columns(line) <= width) return std::string(line);
  const std::string indent(std::min(line.find_first_not_of(' '), width / 2), ' ');
  std::string text(take_word(line));
  std::size_t column = columns(text);
  while (!line.empty()) {
    std::string_view word = take_word(line);
    if (column + columns(word) > width) {
      word.remove_prefix(std::min(word.find_first_not_of(' '), word.size()));
      if (word.empty()) break;  // blanks at the end
      text += '\n' + indent;
      column = indent.size();
    }
    text += word;
    column += columns(word);
  }
  return text;
}

}  // namespace

std::string wrapped(std::string_view text, std::size_t width) {
  std::string result;
  while (true) {
    const std::size_t end = text.find('\n');
    result += wrapped_line(text.substr(0, end), width);
    if (end == std::string_view::npos) return result;
    result += '\n';
    text.remove_prefix(end + 1);
  }
}

}  // namespace unicursal::host
