#include "firmware_gcode/sliced/words.hpp"

#include <charconv>
#include <cmath>

namespace unicursal::gcode {
namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\xc2' || c == '\xa0';  // the last two: a no-break space
}
char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}
bool is_letter(char c) {
  return upper(c) >= 'A' && upper(c) <= 'Z';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Reads a number at the beginning of `text` and removes it.
bool take_number(std::string_view& text, double& value) {
  std::string_view rest = text;
  if (!rest.empty() && rest.front() == '+') rest.remove_prefix(1);
  const auto [end, error] =
      std::from_chars(rest.data(), rest.data() + rest.size(), value, std::chars_format::fixed);
  if (error != std::errc() || !std::isfinite(value) || std::abs(value) > 1e9) return false;
  text = rest.substr(static_cast<std::size_t>(end - rest.data()));
  return true;
}

void skip_spaces(std::string_view& text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  skip_spaces(text);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

SplitLine split_comment(std::string_view line) {
  SplitLine split;
  const auto at = line.find(';');
  split.has_comment = at != std::string_view::npos;
  split.command = trimmed(line.substr(0, at));
  if (split.has_comment) split.comment = line.substr(at + 1);
  return split;
}

SlicedCommand parse_command(std::string_view line) {
  SlicedCommand command;
  std::string_view rest = trimmed(line);
  if (rest.size() > 1 && upper(rest.front()) == 'N' && is_digit(rest[1])) {  // a line number
    rest.remove_prefix(1);
    while (!rest.empty() && is_digit(rest.front())) rest.remove_prefix(1);
    skip_spaces(rest);
    if (const auto sum = rest.rfind('*'); sum != std::string_view::npos) rest = trimmed(rest.substr(0, sum));
  }
  command.text = rest;
  command.name = rest.substr(0, rest.find_first_of(" \t"));
  if (rest.size() < 2 || !is_letter(rest.front())) return command;
  const char letter = upper(rest.front());
  rest.remove_prefix(1);
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), command.code);
  if (error != std::errc()) return command;
  command.letter = letter;
  rest = rest.substr(static_cast<std::size_t>(end - rest.data()));
  if (rest.size() > 1 && rest.front() == '.' && is_digit(rest[1])) {
    const auto [past, wrong] = std::from_chars(rest.data() + 1, rest.data() + rest.size(), command.sub);
    if (wrong != std::errc()) command.damaged = true;
    rest = rest.substr(static_cast<std::size_t>(past - rest.data()));
  }
  command.name = command.text.substr(0, command.text.size() - rest.size());
  while (skip_spaces(rest), !rest.empty()) {
    if (rest.front() == '(') {  // a comment
      const auto close = rest.find(')');
      if (close == std::string_view::npos) break;
      rest.remove_prefix(close + 1);
      continue;
    }
    if (!is_letter(rest.front())) {
      command.damaged = true;
      break;
    }
    const char word = upper(rest.front());
    rest.remove_prefix(1);
    const std::uint32_t bit = SlicedCommand::bit(word);
    if ((command.there_ & bit) != 0) command.damaged = true;
    command.there_ |= bit;
    double value = 0;
    if (!rest.empty() && !is_space(rest.front()) && !is_letter(rest.front())) {
      if (!take_number(rest, value)) {
        command.damaged = true;
        break;
      }
      command.valued_ |= bit;
      command.values_[static_cast<std::size_t>(word - 'A')] = value;
    }
  }
  return command;
}

}  // namespace unicursal::gcode
