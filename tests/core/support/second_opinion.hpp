// A second opinion on drawings: pictures by librsvg (rsvg-convert) of a drawing, and of the shapes that were
// read from it, compared by the area of each colour.
#pragma once

#include <png.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/drawing/svg_reader.hpp"

extern char** environ;

namespace unicursal::test {

/// Bytes of red, green, blue, opacity for each pixel.
struct Raster {
  int width = 0, height = 0;
  std::vector<std::uint8_t> bytes;
};

/// Nullopt if it is not a picture.
inline std::optional<Raster> read_png(const std::filesystem::path& file) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_file(&image, file.c_str())) return std::nullopt;
  image.format = PNG_FORMAT_RGBA;
  Raster result{int(image.width), int(image.height), std::vector<std::uint8_t>(PNG_IMAGE_SIZE(image))};
  if (!png_image_finish_read(&image, nullptr, result.bytes.data(), 0, nullptr)) return std::nullopt;
  return result;
}

/// Lets librsvg draw a file; nullopt if it refuses. Throws if rsvg-convert is missing.
inline std::optional<Raster> drawn_by_librsvg(const std::filesystem::path& svg, int width, int height,
                                              const std::filesystem::path& folder) {
  const std::filesystem::path png = folder / "picture.png";
  std::filesystem::remove(png);
  std::vector<std::string> words{
      "rsvg-convert", "-w",         std::to_string(width), "-h", std::to_string(height),
      "-o",           png.string(), "--accept-language",   "en", svg.string()};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, 2, "/dev/null", 1, 0);
  pid_t child = 0;
  if (posix_spawnp(&child, "rsvg-convert", &files, nullptr, arguments.data(), environ) != 0)
    throw std::runtime_error("rsvg-convert is missing; host/install-packages --with-tests installs it");
  posix_spawn_file_actions_destroy(&files);
  int status = 0;
  waitpid(child, &status, 0);
  if (status != 0) return std::nullopt;
  return read_png(png);
}

/// The shapes as a drawing of the same page that needs nothing but plain paths.
inline std::string plain_svg(const core::Drawing& drawing) {
  const double w = drawing.page.x(), h = drawing.page.y();
  const auto number = [](double value) { return std::to_string(value); };
  std::string text = "<svg xmlns='http://www.w3.org/2000/svg' width='" + number(w) + "mm' height='" +
                     number(h) + "mm' viewBox='0 0 " + number(w) + " " + number(h) + "'>\n";
  for (const core::Shape& shape : drawing.shapes) {
    const auto ring = [&](const core::Ring& points) {
      char command = 'M';
      for (const core::Vec2& p : points) {
        text += command + number(p.x()) + " " + number(h - p.y());
        command = 'L';
      }
      text += "Z";
    };
    const bool server = shape.fill.starts_with("url");
    text += "<path fill-rule='evenodd' fill='" + (server ? std::string("#808080") : shape.fill) + "' d='";
    for (const core::Polygon& polygon : shape.region) {
      ring(polygon.outer);
      for (const core::Ring& hole : polygon.holes) ring(hole);
    }
    text += "'/>\n";
  }
  return text + "</svg>\n";
}

/// The area of each colour in pixels, with 16 levels of red, green and blue.
inline std::map<int, double> colour_areas(const Raster& raster) {
  std::map<int, double> areas;
  for (std::size_t i = 0; i + 3 < raster.bytes.size(); i += 4) {
    const double opacity = raster.bytes[i + 3] / 255.0;
    if (opacity <= 0) continue;
    const auto level = [&](std::size_t k) { return (raster.bytes[i + k] + 8) / 17; };
    areas[level(0) << 8 | level(1) << 4 | level(2)] += opacity;
  }
  return areas;
}

/// The area that has another colour in one picture than in the other, as a share of the larger coloured area.
/// The order of pixels does not count.
inline double difference(const Raster& a, const Raster& b) {
  std::map<int, double> areas = colour_areas(a);
  double sum_a = 0, sum_b = 0, excess = 0, lack = 0;
  for (const auto& [colour, area] : areas) sum_a += area;
  for (const auto& [colour, area] : colour_areas(b)) sum_b += area, areas[colour] -= area;
  for (const auto& [colour, area] : areas) (area > 0 ? excess : lack) += std::abs(area);
  const double whole = std::max(sum_a, sum_b);
  return whole > 0 ? std::max(excess, lack) / whole : 0;
}

struct Opinion {
  double difference = 0;  ///< share of the coloured area; from the nearer of two pictures, if there are two
  std::vector<std::string> notes;  ///< of the reader
  std::string trouble;             ///< why there is no comparison; empty: there is one
};

/// Reads a drawing and compares it with librsvg's picture. `pixels`: the longer side of the pictures.
/// Throws DataError if the reader refuses it.
inline Opinion second_opinion(const std::filesystem::path& svg, const std::filesystem::path& folder,
                              int pixels = 400) {
  core::Warnings first_notes, warnings;
  core::Drawing drawing = core::read_svg(svg, first_notes);
  // Curves become polygons by a tolerance in mm, which is coarse for an icon; it is compared as a larger one.
  constexpr double least_side = 200;  // mm
  if (const double side = drawing.page.maxCoeff(); side > 0 && side < least_side) {
    core::DrawingOptions larger;
    larger.turn *= least_side / side;
    drawing = core::read_svg(svg, warnings, larger);
    drawing.page *= least_side / side;
  } else {
    warnings = first_notes;
  }
  Opinion result;
  result.notes = warnings.sentences();
  if (!(drawing.page.minCoeff() > 0)) {
    result.trouble = "the page has no size";
    return result;
  }
  const core::Vec2 size = drawing.page / drawing.page.maxCoeff() * pixels;
  const int width = std::max(1, int(std::lround(size.x()))), height = std::max(1, int(std::lround(size.y())));
  const std::filesystem::path ours = folder / "ours.svg";
  std::ofstream(ours) << plain_svg(drawing);
  const auto first = drawn_by_librsvg(svg, width, height, folder),
             second = drawn_by_librsvg(ours, width, height, folder);
  if (!first || !second) {
    result.trouble = "librsvg refuses it";
    return result;
  }
  result.difference = difference(*first, *second);
  // Collections of test drawings have pictures of what is right beside them.
  std::filesystem::path right = svg;
  if (const auto expected = read_png(right.replace_extension(".png"))) {
    if (const auto mine = drawn_by_librsvg(ours, expected->width, expected->height, folder))
      result.difference = std::min(result.difference, difference(*expected, *mine));
  }
  return result;
}

}  // namespace unicursal::test
