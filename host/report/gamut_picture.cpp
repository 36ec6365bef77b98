#include "host/report/gamut_picture.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <string>
#include <vector>

#include "core/picture/text.hpp"

namespace unicursal::host {
namespace {

using picture::Colour;

constexpr Colour paper{255, 255, 255}, ink{60, 60, 60};
constexpr double side = 220, border = 30;  ///< pixels
constexpr std::size_t dot = 3, triangles_across = 4;

struct Corner {
  double x = 0, y = 0;
  std::size_t feeder = 0;
};

/// The shares of the three corners at a place; negative outside.
std::array<double, 3> shares_at(const std::array<Corner, 3>& c, double x, double y) {
  const double whole = (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[2].x - c[0].x) * (c[1].y - c[0].y);
  const double b = ((x - c[0].x) * (c[2].y - c[0].y) - (c[2].x - c[0].x) * (y - c[0].y)) / whole;
  const double d = ((c[1].x - c[0].x) * (y - c[0].y) - (x - c[0].x) * (c[1].y - c[0].y)) / whole;
  return {1 - b - d, b, d};
}

void label(picture::Image& image, double x, double y, std::size_t feeder) {
  picture::write(image, std::lround(x - dot * 1.5), std::lround(y - dot * 2.5), std::to_string(feeder + 1),
                 dot, ink);
}

void draw_triangle(picture::Image& image, double left, double top, const std::array<std::size_t, 3>& feeders,
                   const picture::Filaments& filaments) {
  const double height = side * std::sqrt(3.0) / 2;
  const std::array<Corner, 3> corners{{{left, top + height, feeders[0]},
                                       {left + side, top + height, feeders[1]},
                                       {left + side / 2, top, feeders[2]}}};
  std::vector<double> shares(filaments.size());
  for (double y = top; y <= top + height; ++y) {
    for (double x = left; x <= left + side; ++x) {
      const std::array<double, 3> parts = shares_at(corners, x, y);
      if (*std::min_element(parts.begin(), parts.end()) < 0) continue;
      for (std::size_t i = 0; i < 3; ++i) shares[corners[i].feeder] = parts[i];
      image.set(static_cast<std::size_t>(x), static_cast<std::size_t>(y),
                picture::colour_of(shares, filaments));
    }
  }
  label(image, left - 12, top + height, feeders[0]);
  label(image, left + side + 12, top + height, feeders[1]);
  label(image, left + side / 2, top - 12, feeders[2]);
}

picture::Image bar(const picture::Filaments& filaments, std::size_t feeders) {
  picture::Image image(std::size_t(side + 2 * border), std::size_t(side / 3 + 2 * border), paper);
  std::vector<double> shares(filaments.size());
  for (double x = 0; x < side; ++x) {
    shares[0] = feeders == 1 ? 1 : 1 - x / (side - 1);
    shares[1] = 1 - shares[0];
    for (double y = 0; y < side / 3; ++y)
      image.set(static_cast<std::size_t>(border + x), static_cast<std::size_t>(border + y),
                picture::colour_of(shares, filaments));
  }
  for (std::size_t f = 0; f < feeders; ++f)
    label(image, f == 0 ? border - 12 : border + side + 12, border + side / 6, f);
  return image;
}

}  // namespace

picture::Image gamut_picture(const picture::Filaments& filaments, std::size_t feeders) {
  assert(feeders >= 1 && feeders <= 8);
  if (feeders < 3) return bar(filaments, feeders);
  std::vector<std::array<std::size_t, 3>> triples;
  for (std::size_t a = 0; a < feeders; ++a) {
    for (std::size_t b = a + 1; b < feeders; ++b) {
      for (std::size_t c = b + 1; c < feeders; ++c) triples.push_back({a, b, c});
    }
  }
  const std::size_t across = std::min(triangles_across, triples.size()),
                    down = (triples.size() + across - 1) / across;
  const double cell = side + 2 * border, height = side * std::sqrt(3.0) / 2 + 2 * border;
  picture::Image image(static_cast<std::size_t>(cell * double(across)),
                       static_cast<std::size_t>(std::ceil(height * double(down))), paper);
  for (std::size_t i = 0; i < triples.size(); ++i) {
    const std::size_t row = i / across, column = i % across;
    draw_triangle(image, cell * double(column) + border, height * double(row) + border, triples[i],
                  filaments);
  }
  return image;
}

}  // namespace unicursal::host
