#include "host/tune/digits.hpp"

#include <array>
#include <string>

namespace unicursal::host {
namespace {

/// An end of a segment: column 0 to 1, row 0 (bottom), 1 or 2. The digit 1 is in the middle column.
struct Corner {
  double column, row;
};
using PenLine = std::vector<Corner>;

const std::array<std::vector<PenLine>, 10>& strokes_of_digits() {
  static const std::array<std::vector<PenLine>, 10> digits = {{
      {{{0, 0}, {0, 2}, {1, 2}, {1, 0}, {0, 0}}},
      {{{0.5, 0}, {0.5, 2}}},
      {{{0, 2}, {1, 2}, {1, 1}, {0, 1}, {0, 0}, {1, 0}}},
      {{{0, 2}, {1, 2}, {1, 0}, {0, 0}}, {{0, 1}, {1, 1}}},
      {{{0, 2}, {0, 1}, {1, 1}}, {{1, 2}, {1, 0}}},
      {{{1, 2}, {0, 2}, {0, 1}, {1, 1}, {1, 0}, {0, 0}}},
      {{{1, 2}, {0, 2}, {0, 0}, {1, 0}, {1, 1}, {0, 1}}},
      {{{0, 2}, {1, 2}, {1, 0}}},
      {{{0, 1}, {0, 2}, {1, 2}, {1, 0}, {0, 0}, {0, 1}, {1, 1}}},
      {{{1, 1}, {0, 1}, {0, 2}, {1, 2}, {1, 0}, {0, 0}}},
  }};
  return digits;
}

}  // namespace

double number_width(std::size_t number, const StripSizes& sizes) {
  const auto digits = static_cast<double>(std::to_string(number).size());
  return (digits - 1) * sizes.digit_step + sizes.digit_width;
}

std::vector<std::vector<core::Vec2>> number_strokes(std::size_t number, const core::Vec2& corner,
                                                    const StripSizes& sizes) {
  std::vector<std::vector<core::Vec2>> strokes;
  core::Vec2 foot = corner;
  for (const char digit : std::to_string(number)) {
    for (const PenLine& stroke : strokes_of_digits().at(static_cast<std::size_t>(digit - '0'))) {
      std::vector<core::Vec2>& line = strokes.emplace_back();
      for (const Corner& c : stroke) {
        line.push_back(foot + core::Vec2(c.column * sizes.digit_width, c.row * sizes.digit_height / 2));
      }
    }
    foot.x() += sizes.digit_step;
  }
  return strokes;
}

}  // namespace unicursal::host
