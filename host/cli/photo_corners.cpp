#include "host/cli/photo_corners.hpp"

#include <algorithm>
#include <sstream>

#include "core/error.hpp"

namespace unicursal::host {

std::optional<GivenCorners> corners_in(const std::optional<std::string>& text) {
  if (!text) return std::nullopt;
  std::string spaced = *text;
  std::replace(spaced.begin(), spaced.end(), ',', ' ');
  std::istringstream numbers(spaced);
  GivenCorners corners;
  for (core::Vec2& corner : corners) numbers >> corner.x() >> corner.y();
  std::string rest;
  if (numbers && !(numbers >> rest)) return corners;
  throw core::DataError("", "--corners", "are not eight numbers",
                        "write x and y of the four corner marks in pixels, as in "
                        "--corners 310,2050,3650,2100,3500,720,420,700");
}

}  // namespace unicursal::host
