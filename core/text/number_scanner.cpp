#include "core/text/number_scanner.hpp"

#include <fmt/format.h>

#include <charconv>
#include <system_error>

#include "core/text/malformed.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

}  // namespace

void NumberScanner::skip_spaces() {
  while (!at_end() && is_blank(peek())) ++at_;
}

void NumberScanner::skip_separator() {
  skip_spaces();
  if (peek() == ',') {
    ++at_;
    skip_spaces();
  }
}

bool NumberScanner::starts_number() const {
  std::size_t i = at_;
  const auto at = [&](std::size_t k) { return k < text_.size() ? text_[k] : '\0'; };
  if (at(i) == '+' || at(i) == '-') ++i;
  return is_digit(at(i)) || (at(i) == '.' && is_digit(at(i + 1)));
}

std::optional<double> NumberScanner::number() {
  if (!starts_number()) return std::nullopt;
  if (peek() == '+') ++at_;  // from_chars does not accept it
  double value = 0;
  const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
  if (error != std::errc{}) throw Malformed("the number at " + in_quotes(rest()) + " is out of range");
  at_ = static_cast<std::size_t>(end - text_.data());
  return value;
}

double NumberScanner::required() {
  skip_separator();
  if (const auto value = number()) return *value;
  if (at_end()) throw Malformed("it ends where a number is missing");
  throw Malformed(fmt::format("character {} should start a number but is {}", at_ + 1, in_quotes(rest())));
}

bool NumberScanner::flag() {
  skip_separator();
  const char c = peek();
  if (c != '0' && c != '1')
    throw Malformed(fmt::format("character {} should be an arc flag, 0 or 1", at_ + 1));
  ++at_;
  return c == '1';
}

std::string_view NumberScanner::word() {
  const std::size_t start = at_;
  while (is_letter(peek())) ++at_;
  return text_.substr(start, at_ - start);
}

std::vector<double> numbers(std::string_view text) {
  NumberScanner scanner(text);
  std::vector<double> result;
  scanner.skip_spaces();
  while (!scanner.at_end()) {
    result.push_back(scanner.required());
    scanner.skip_spaces();
  }
  return result;
}

}  // namespace unicursal::core
