#include "sim/line/words.hpp"

#include <algorithm>

namespace unicursal::sim {

namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_letter(char c) {
  return c >= 'A' && c <= 'Z';
}

class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  bool done() const { return at_ == text_.size(); }
  char peek() const { return done() ? '\0' : text_[at_]; }
  char take() { return text_[at_++]; }
  void skip_spaces() {
    while (peek() == ' ') ++at_;
  }

  /// Reads a number here; if there is none, returns nullopt and does not advance.
  std::optional<double> number() {
    const std::size_t start = at_;
    const bool negative = peek() == '-';
    if (negative || peek() == '+') ++at_;
    double value = 0;
    std::size_t digits = read_digits(value);
    if (peek() == '.') {
      ++at_;
      digits += read_fraction(value);
    }
    if (digits == 0) {
      at_ = start;
      return std::nullopt;
    }
    value = std::min(value, largest_number);
    return negative ? -value : value;
  }

 private:
  std::size_t read_digits(double& value) {
    const std::size_t start = at_;
    while (is_digit(peek())) value = value * 10 + (take() - '0');
    return at_ - start;
  }
  /// Skips digits beyond the precision of a double.
  std::size_t read_fraction(double& value) {
    constexpr double finest = 1e17;
    const std::size_t start = at_;
    double fraction = 0, unit = 1;
    for (; is_digit(peek()); ++at_) {
      if (unit >= finest) continue;
      fraction = fraction * 10 + (peek() - '0');
      unit *= 10;
    }
    value += fraction / unit;
    return at_ - start;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

std::optional<double> Command::value(char letter) const {
  if ((valued_ & bit(letter)) == 0) return std::nullopt;
  return values_[place(letter)];
}

void Command::set(char letter, std::optional<double> value) {
  seen_ |= bit(letter);
  if (!value) return;
  valued_ |= bit(letter);
  values_[place(letter)] = *value;
}

std::optional<Command> parse_command(std::string_view text) {
  Reader reader(text);
  reader.skip_spaces();
  const char letter = reader.done() ? '\0' : reader.take();
  if ((letter != 'G' && letter != 'M' && letter != 'T') || !is_digit(reader.peek())) return std::nullopt;
  Command command(letter, static_cast<int>(*reader.number()));
  while (!reader.done()) {
    const char word = reader.take();
    if (!is_letter(word)) continue;
    reader.skip_spaces();
    command.set(word, reader.number());
  }
  return command;
}

}  // namespace unicursal::sim
