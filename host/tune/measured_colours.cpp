#include "host/tune/measured_colours.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "core/picture/hex_colour.hpp"

namespace unicursal::host {
namespace {

constexpr std::uintmax_t largest_list = 1 << 20;  ///< bytes
constexpr double most_lightness = 100, most_chroma = 200;
const char* const line_remedy = "write its number and a colour, such as 3, #e0604a or 3, 47.2, 12.5, -40.1";

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == ',' || c == ';' || c == '\t') {
      fields.emplace_back();
    } else if (c != ' ' && c != '"' && c != '\r') {
      fields.back() += c;
    }
  }
  return fields;
}

std::optional<double> number_of(const std::string& field) {
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  return error == std::errc() && end == field.data() + field.size() ? std::optional(value) : std::nullopt;
}

std::optional<picture::Light> colour_of(const std::vector<std::string>& fields) {
  if (fields.size() == 2) {
    const auto colour = picture::colour_in(fields[1]);
    return colour ? std::optional(picture::light_of(*colour)) : std::nullopt;
  }
  if (fields.size() != 4) return std::nullopt;
  const auto lightness = number_of(fields[1]), a = number_of(fields[2]), b = number_of(fields[3]);
  if (!lightness || !a || !b) return std::nullopt;
  // All are false for NaN.
  if (!(*lightness >= 0 && *lightness <= most_lightness)) return std::nullopt;
  if (!(std::abs(*a) <= most_chroma && std::abs(*b) <= most_chroma)) return std::nullopt;
  return picture::light_of(picture::Lab{*lightness, *a, *b});
}

}  // namespace

std::vector<SeenPatch> read_measured_colours(const std::filesystem::path& file, std::size_t patches) {
  std::error_code error;
  std::ifstream stream(file);
  if (!stream || !std::filesystem::is_regular_file(file, error))
    throw core::FileError(file.string(), "", "cannot be read", "check the name and permissions");
  if (std::filesystem::file_size(file, error) > largest_list)
    throw core::FileError(file.string(), "", "is too big for a list of colours",
                          "name a file with one line for each patch");
  std::vector<SeenPatch> seen;
  std::size_t count = 0;
  for (std::string line; std::getline(stream, line);) {
    const std::string place = fmt::format("line {}", ++count);
    const auto fail = [&](const std::string& problem, const std::string& remedy) {
      throw core::DataError(file.string(), place, problem, remedy);
    };
    const std::vector<std::string> fields = fields_of(line);
    if (fields.size() == 1 && fields[0].empty()) continue;
    const std::optional<double> number = number_of(fields[0]);
    if (!number && count == 1) continue;
    if (!number) fail("does not begin with the number of a patch", line_remedy);
    if (!(*number >= 1 && *number <= double(patches)) || *number != std::floor(*number))
      fail(fmt::format("names patch {:g}, but the chart has 1 to {}", *number, patches),
           "use the numbers that are printed in front of the patches");
    const auto light = colour_of(fields);
    if (!light) fail("holds no colour that can be read", line_remedy);
    const auto patch = static_cast<std::size_t>(*number) - 1;
    const auto same = [&](const SeenPatch& other) { return other.patch == patch; };
    if (std::any_of(seen.begin(), seen.end(), same))
      fail(fmt::format("names patch {} a second time", patch + 1), "keep one of the two lines");
    seen.push_back({patch, *light});
  }
  return seen;
}

}  // namespace unicursal::host
