#include "sim/line/line_check.hpp"

#include <algorithm>
#include <cassert>
#include <charconv>

#include <fmt/format.h>

namespace unicursal::sim {

namespace {

constexpr std::int64_t repetier_modulus = 65536, repetier_repeats = 40;
/// Larger numbers are clamped to this, so that no arithmetic on them overflows.
constexpr std::int64_t largest_line_number = 1'000'000'000'000;

std::string_view without_leading_spaces(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string_view::npos ? std::string_view{} : text.substr(first);
}

/// The integer at the start of the text, or 0 if there is none, as C's strtol() gives it.
std::int64_t leading_integer(std::string_view text) {
  text = without_leading_spaces(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  std::int64_t value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return std::clamp(value, -largest_line_number, largest_line_number);
}

std::string body_of(std::string_view line) {
  line.remove_prefix(1);
  const std::size_t digits = line.find_first_not_of("0123456789+- ");
  line = digits == std::string_view::npos ? std::string_view{} : line.substr(digits);
  line = line.substr(0, line.find('*'));
  const std::size_t last = line.find_last_not_of(' ');
  return std::string(line.substr(0, last == std::string_view::npos ? 0 : last + 1));
}

}  // namespace

std::uint8_t checksum(std::string_view bytes) {
  unsigned sum = 0;
  for (const char byte : bytes) sum ^= static_cast<unsigned char>(byte);
  return static_cast<std::uint8_t>(sum);
}

/// The first `*` counts, so that a second line that has lost its newline before it vanishes without a word.
LineVerdict LineCheck::check_checksum_only(std::string_view line) {
  if (!line.starts_with('N') && !line.starts_with('n'))
    return {LineVerdict::Kind::accepted, std::nullopt, std::string(line)};
  const std::int64_t number = leading_integer(line.substr(1));
  const std::size_t star = line.find('*');
  if (star != std::string_view::npos) {
    const bool good = leading_integer(line.substr(star + 1)) == checksum(line.substr(0, star));
    if (!good) return {LineVerdict::Kind::wrong_checksum, number, {}};
  }
  last_ = number;
  return {LineVerdict::Kind::accepted, number, body_of(line)};
}

LineVerdict LineCheck::check(std::string_view line) {
  if (rules_ == Rules::reprapfirmware) return check_checksum_only(line);
  if (!line.starts_with('N')) return {LineVerdict::Kind::accepted, std::nullopt, std::string(line)};
  const bool resets = line.find("M110") != std::string_view::npos;
  const std::size_t second = resets ? line.find('N', 4) : std::string_view::npos;
  const std::int64_t number = leading_integer(line.substr(second == std::string_view::npos ? 1 : second + 1));
  const LineVerdict::Kind kind = judge(line, number, resets);
  if (kind != LineVerdict::Kind::accepted) return {kind, number, {}};
  last_ = number;
  return {kind, number, body_of(line)};
}

bool LineCheck::follows(std::int64_t number) const {
  if (rules_ == Rules::marlin) return number == last_ + 1;
  return (number - last_ - 1) % repetier_modulus == 0;
}

bool LineCheck::repeats(std::int64_t number) const {
  if (rules_ == Rules::marlin) return number == last_ || number == last_ - 1;
  const std::int64_t behind = (last_ - number) % repetier_modulus;
  return (behind + repetier_modulus) % repetier_modulus < repetier_repeats;
}

LineVerdict::Kind LineCheck::judge(std::string_view line, std::int64_t number, bool resets) const {
  using Kind = LineVerdict::Kind;
  if (!resets && !follows(number)) return repeats(number) ? Kind::repeated : Kind::wrong_number;
  const std::size_t star = line.rfind('*');
  if (star == std::string_view::npos) return rules_ == Rules::repetier ? Kind::accepted : Kind::no_checksum;
  const bool good = leading_integer(line.substr(star + 1)) == checksum(line.substr(0, star));
  return good ? Kind::accepted : Kind::wrong_checksum;
}

std::string refusal(LineVerdict::Kind kind, std::int64_t last) {
  const char* reason = "";
  switch (kind) {
    case LineVerdict::Kind::wrong_number:
      reason = "Line Number is not Last Line Number+1";
      break;
    case LineVerdict::Kind::wrong_checksum:
      reason = "checksum mismatch";
      break;
    case LineVerdict::Kind::no_checksum:
      reason = "No Checksum with line number";
      break;
    case LineVerdict::Kind::accepted:
    case LineVerdict::Kind::repeated:
      assert(false && "not a refusal");
  }
  return fmt::format("{}, Last Line: {}", reason, last);
}

}  // namespace unicursal::sim
