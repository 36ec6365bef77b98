#include "core/field/direction_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/field/direction_field.hpp"
#include "core/text/file_bytes.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {
namespace {

constexpr std::size_t most_samples = 4'000'000;
constexpr std::uintmax_t largest_file = 512u << 20;  ///< bytes
constexpr double farthest_sample = 1e5;              ///< mm
constexpr double largest_angle = 1e6;  ///< degrees; beyond, rounding loses the fraction of a turn
constexpr const char* remedy = "write x,y,angle or x,y,z,angle on each line, in mm and degrees";

std::string_view without_blanks(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::optional<double> number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || word.empty()) return std::nullopt;
  // A number out of range becomes infinite here, and is refused later with others that are too large.
  if (error == std::errc::result_out_of_range) return HUGE_VAL;
  return error == std::errc{} ? std::optional(value) : std::nullopt;
}

class DirectionReader {
 public:
  DirectionReader(std::string_view text, std::string file) : rest_(text), file_(std::move(file)) {
    if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);  // byte order mark
  }

  std::vector<DirectionSample> read() {
    std::vector<DirectionSample> samples;
    bool first = true;
    while (!rest_.empty()) {
      const std::string_view line = next_line();
      if (line.empty() || line.starts_with('#')) continue;
      if (!(first && is_header(line))) samples.push_back(sample(line));
      if (samples.size() > most_samples) refuse("there are more than 4 million samples", "thin them out");
      first = false;
    }
    if (samples.empty()) throw ModelError(file_, "", "it contains no direction", remedy);
    return samples;
  }

 private:
  [[noreturn]] void refuse(const std::string& problem, const char* what_to_do = remedy) const {
    throw ModelError(file_, fmt::format("line {}", line_), problem, what_to_do);
  }

  std::string_view next_line() {
    const std::string_view line = rest_.substr(0, rest_.find('\n'));
    rest_.remove_prefix(std::min(line.size() + 1, rest_.size()));
    ++line_;
    return without_blanks(line);
  }

  /// The words between the commas. Stops at five, which is already too many: a line may be very long.
  static std::vector<std::string_view> words(std::string_view line) {
    std::vector<std::string_view> result;
    for (;;) {
      const auto comma = line.find(',');
      result.push_back(without_blanks(line.substr(0, comma)));
      if (comma == std::string_view::npos || result.size() > 4) return result;
      line.remove_prefix(comma + 1);
    }
  }

  /// A header names its columns: none of them is a number. Known names must be in their order.
  bool is_header(std::string_view line) const {
    const std::vector<std::string_view> names = words(line);
    if (std::any_of(names.begin(), names.end(), [](auto word) { return number(word).has_value(); })) {
      return false;
    }
    const std::array<std::string_view, 4> order{"x", "y", names.size() == 4 ? "z" : "angle", "angle"};
    for (std::size_t k = 0; k < names.size(); ++k) {
      const bool known = std::find(order.begin(), order.end(), names[k]) != order.end();
      if (known && (k >= order.size() || names[k] != order[k])) {
        refuse("the column " + in_quotes(names[k]) + " is in the wrong place");
      }
    }
    return true;
  }

  DirectionSample sample(std::string_view line) {
    const std::vector<std::string_view> found = words(line);
    const std::size_t count = found.size();
    std::array<double, 4> values{};
    if (count > values.size()) refuse("there are more than four numbers");
    for (std::size_t k = 0; k < count; ++k) {
      const std::optional<double> value = number(found[k]);
      if (!value) refuse(found[k].empty() ? "a number is missing" : in_quotes(found[k]) + " is not a number");
      values[k] = *value;
    }
    if (count < 3) refuse(count == 1 ? "there is only one number" : "there are only two numbers");
    if (columns_ != 0 && count != columns_) {
      refuse(fmt::format("there are {} numbers, but {} on the lines before", count, columns_));
    }
    columns_ = count;
    return checked(values[0], values[1], count == 4 ? values[2] : 0, values[count - 1]);
  }

  DirectionSample checked(double x, double y, double z, double degrees) const {
    // Written so that NaN fails too.
    for (const double coordinate : {x, y, z}) {
      if (!(std::abs(coordinate) <= farthest_sample)) {
        refuse(fmt::format("a coordinate of {} mm is out of reach", coordinate));
      }
    }
    if (!(std::abs(degrees) <= largest_angle)) refuse(fmt::format("{} is not an angle in degrees", degrees));
    return {{x, y}, z, doubled(std::numbers::pi / 180 * std::fmod(degrees, 180.0))};
  }

  std::string_view rest_;
  std::string file_;
  std::size_t line_ = 0, columns_ = 0;
};

}  // namespace

std::vector<DirectionSample> read_directions(const std::filesystem::path& file) {
  std::error_code no_size;  // if there is none, file_bytes() reports why
  if (const auto size = std::filesystem::file_size(file, no_size); !no_size && size > largest_file) {
    throw ModelError(file.string(), "", "it is larger than 512 MiB", "thin out the samples");
  }
  const std::string bytes = file_bytes(file);
  return DirectionReader(bytes, file.string()).read();
}

}  // namespace unicursal::core
