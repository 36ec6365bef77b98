#include "tests/camera/lit_bed.hpp"

#include <algorithm>
#include <cmath>

namespace unicursal::camera {
namespace {

constexpr double margin_around = 12;   ///< mm of the bed around the print that are drawn finely
constexpr double bed_edge = 15;        ///< mm from the print to the front and the sides of the bed
constexpr double table_reach = 180;    ///< mm beyond the bed, the room is dark
constexpr double coarse_pixel = 0.25;  ///< mm
constexpr std::size_t coarsest = 5;    ///< halvings
constexpr double round_side = 0.1;     ///< mm; the width of a round side: half a usual layer height
constexpr double sharpness = 45;       ///< exponent of shine
constexpr std::size_t changes = 256, thicknesses = 16;

using Vector = std::array<double, 3>;

/// Each place becomes the mean of itself and its neighbours in a square of nine; the border stays.
void smooth(std::vector<float>& heights, std::size_t columns, std::size_t rows) {
  std::vector<float> across(heights.size());
  for (std::size_t i = 1; i + 1 < heights.size(); ++i)
    across[i] = (heights[i - 1] + heights[i] + heights[i + 1]) / 3;
  for (std::size_t i = columns; i + columns < columns * rows; ++i)
    heights[i] = (across[i - columns] + across[i] + across[i + columns]) / 3;
}

/// The surface of the plastic, in layer heights, with round sides.
std::vector<float> rounded(const PrintedLayer& layer) {
  std::vector<float> heights(layer.fill.size());
  for (std::size_t i = 0; i < heights.size(); ++i)
    heights[i] = static_cast<float>(layer.fill[i]) * static_cast<float>(1 / PrintedLayer::full);
  for (long pass = std::lround(round_side / layer.pixel); pass > 0; --pass)
    smooth(heights, layer.columns, layer.rows);
  return heights;
}

/// The colours of all mixtures and thicknesses on one ground.
class ColourTable {
 public:
  ColourTable(const FilamentPair& pair, const PrintedLayer& layer, const Spectrum& ground) {
    const Pigment first = pigment_named(pair.from), second = pigment_named(pair.to),
                  third = pigment_named(pair.others);
    for (std::size_t c = 0; c < changes; ++c) {
      const Pigment both = mixed(first, second, static_cast<double>(c) / (changes - 1));
      const Pigment here = mixed(both, third, layer.others);
      for (std::size_t t = 0; t <= thicknesses; ++t) {
        const double thickness = layer.height * static_cast<double>(t) / thicknesses;
        colours_[c * (thicknesses + 1) + t] = recorded(reflected(here, thickness, ground));
      }
    }
  }

  /// `height`: 0 to 1 layer heights.
  Rgb at(double change, double height) const {
    const double c = change * (changes - 1), t = std::clamp(height, 0.0, 1.0) * thicknesses;
    const auto column = std::min(static_cast<std::size_t>(c), changes - 2);
    const auto row = std::min(static_cast<std::size_t>(t), thicknesses - 1);
    const auto u = static_cast<float>(c - static_cast<double>(column));
    const auto v = static_cast<float>(t - static_cast<double>(row));
    const Rgb* low = &colours_[column * (thicknesses + 1) + row];
    const Rgb* high = low + thicknesses + 1;
    Rgb mean{};
    for (std::size_t i = 0; i < 3; ++i)
      mean[i] = (1 - u) * ((1 - v) * low[0][i] + v * low[1][i]) + u * ((1 - v) * high[0][i] + v * high[1][i]);
    return mean;
  }

 private:
  std::vector<Rgb> colours_ = std::vector<Rgb>(changes * (thicknesses + 1));
};

Vector unit_vector(double x, double y, double z) {
  const double length = std::sqrt(x * x + y * y + z * z);
  return {x / length, y / length, z / length};
}

}  // namespace

/// Draws the place of the print and its surroundings.
class Painter {
 public:
  Painter(const PrintedLayer& layer, const FilamentPair& pair, Bed bed, const Lamp& lamp,
          const Vector& towards_camera)
      : layer_(layer),
        bed_(bed),
        colours_(colours_of(bed)),
        bare_first_(recorded(colours_.first)),
        bare_second_(recorded(colours_.second)),
        on_first_(pair, layer, colours_.first),
        on_second_(pair, layer, colours_.second),
        heights_(rounded(layer)),
        lamp_{std::cos(lamp.elevation) * std::cos(lamp.towards),
              std::cos(lamp.elevation) * std::sin(lamp.towards), std::sin(lamp.elevation)},
        half_way_(unit_vector(lamp_[0] + towards_camera[0], lamp_[1] + towards_camera[1],
                              lamp_[2] + towards_camera[2])),
        gloss_(lamp.gloss) {
    const double right = layer.left + layer.pixel * static_cast<double>(layer.columns);
    const double top = layer.bottom + layer.pixel * static_cast<double>(layer.rows);
    const double left = layer.left - bed_edge, front = layer.bottom - bed_edge,
                 side = right + bed_edge - left;
    bed_place_ = {left, front, left + side, std::max(front + side, top + bed_edge)};
    near_ = {layer.left - margin_around, layer.bottom - margin_around, right + margin_around,
             top + margin_around};
  }

  LitBed::Level near() const {
    LitBed::Level level = LitBed::level(near_, layer_.pixel);
    const auto left = static_cast<std::ptrdiff_t>(std::lround((layer_.left - level.left) / layer_.pixel));
    const auto bottom =
        static_cast<std::ptrdiff_t>(std::lround((layer_.bottom - level.bottom) / layer_.pixel));
    for (std::size_t row = 0; row < level.rows; ++row) {
      for (std::size_t column = 0; column < level.columns; ++column) {
        const Place here = place(level, column, row);
        const auto x = static_cast<std::ptrdiff_t>(column) - left,
                   y = static_cast<std::ptrdiff_t>(row) - bottom;
        set(level, column, row, covered(x, y) ? plastic(here, x, y) : bare(here));
      }
    }
    return level;
  }

  LitBed::Level around(const Rectangle& visible) const {
    const Rectangle reach = {std::max(visible.left, bed_place_.left - table_reach),
                             std::max(visible.bottom, bed_place_.bottom - table_reach),
                             std::min(visible.right, bed_place_.right + table_reach),
                             std::min(visible.top, bed_place_.top + table_reach)};
    LitBed::Level level = LitBed::level(reach, coarse_pixel);
    for (std::size_t row = 0; row < level.rows; ++row) {
      for (std::size_t column = 0; column < level.columns; ++column) {
        const Place here = place(level, column, row);
        if (!well_within(near_, here)) set(level, column, row, bare(here));
      }
    }
    return level;
  }

 private:
  struct Place {
    double x, y;
  };

  static Place place(const LitBed::Level& level, std::size_t column, std::size_t row) {
    return {level.left + level.pixel * (static_cast<double>(column) + 0.5),
            level.bottom + level.pixel * (static_cast<double>(row) + 0.5)};
  }

  /// Where the coarser pictures of the surroundings are never looked at.
  static bool well_within(const Rectangle& near, const Place& here) {
    constexpr double overlap = 4;
    return here.x > near.left + overlap && here.x < near.right - overlap && here.y > near.bottom + overlap &&
           here.y < near.top - overlap;
  }

  static void set(LitBed::Level& level, std::size_t column, std::size_t row, const Rgb& light) {
    auto& pixel = level.light[row * level.columns + column];
    for (std::size_t i = 0; i < 3; ++i)
      pixel[i] = static_cast<std::uint16_t>(std::clamp(light[i] * LitBed::unit + 0.5F, 0.0F, 65535.0F));
  }

  Rgb bare(const Place& here) const {
    if (!bed_place_.holds(here.x, here.y)) return table_at(here.x, here.y);
    return on_ground(bed_at(bed_, here.x, here.y), bare_first_, bare_second_);
  }

  static Rgb on_ground(const BedPlace& ground, const Rgb& first, const Rgb& second) {
    Rgb light{};
    const auto part = static_cast<float>(ground.second);
    for (std::size_t i = 0; i < 3; ++i)
      light[i] = ((1 - part) * first[i] + part * second[i]) * static_cast<float>(ground.brightness);
    return light;
  }

  bool within(std::ptrdiff_t x, std::ptrdiff_t y) const {
    return x >= 0 && y >= 0 && x < static_cast<std::ptrdiff_t>(layer_.columns) &&
           y < static_cast<std::ptrdiff_t>(layer_.rows);
  }
  /// Layer heights.
  float height(std::ptrdiff_t x, std::ptrdiff_t y) const {
    return within(x, y) ? heights_[layer_.index(static_cast<std::size_t>(x), static_cast<std::size_t>(y))]
                        : 0;
  }
  bool covered(std::ptrdiff_t x, std::ptrdiff_t y) const { return height(x, y) > 0.002F; }

  /// The round sides of a bead reach a little beyond the plastic that the raster knows; its colour is that
  /// beside it.
  double change(std::ptrdiff_t x, std::ptrdiff_t y) const {
    for (std::ptrdiff_t away = 0; away <= 5; ++away) {
      for (const auto& [dx, dy] :
           {std::pair{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}}) {
        const std::ptrdiff_t column = x + dx * away, row = y + dy * away;
        if (!within(column, row)) continue;
        const std::size_t i = layer_.index(static_cast<std::size_t>(column), static_cast<std::size_t>(row));
        if (layer_.fill[i] > 0) return layer_.change[i] / PrintedLayer::whole;
      }
    }
    return 0;
  }

  Rgb plastic(const Place& here, std::ptrdiff_t x, std::ptrdiff_t y) const {
    const double h = height(x, y), part = change(x, y);
    const BedPlace ground = bed_at(bed_, here.x, here.y);
    Rgb light = on_ground({ground.second, 1}, on_first_.at(part, h), on_second_.at(part, h));
    const auto grain = static_cast<float>(1 + (ground.brightness - 1) * std::max(0.0, 1 - h));
    const double slope = layer_.height / (2 * layer_.pixel);
    const Vector normal = unit_vector((height(x - 1, y) - height(x + 1, y)) * slope,
                                      (height(x, y - 1) - height(x, y + 1)) * slope, 1);
    const double facing = normal[0] * lamp_[0] + normal[1] * lamp_[1] + normal[2] * lamp_[2];
    const auto lit = static_cast<float>(0.35 + 0.65 * std::max(0.0, facing) / lamp_[2]) * shadow(x, y);
    const double mirrored = normal[0] * half_way_[0] + normal[1] * half_way_[1] + normal[2] * half_way_[2];
    const auto shine =
        static_cast<float>(gloss_ * std::min(1.0, 2 * h) * std::pow(std::max(mirrored, 0.0), sharpness));
    for (float& channel : light) channel = channel * grain * lit + shine;
    return light;
  }

  /// 1, or less where plastic hides the lamp.
  float shadow(std::ptrdiff_t x, std::ptrdiff_t y) const {
    const double along = std::hypot(lamp_[0], lamp_[1]);
    if (along < 1e-6) return 1;
    const double h = height(x, y) * layer_.height;
    double hidden = 0;
    for (int step = 2; step <= 6; step += 2) {
      const auto dx = static_cast<std::ptrdiff_t>(std::lround(step * lamp_[0] / along));
      const auto dy = static_cast<std::ptrdiff_t>(std::lround(step * lamp_[1] / along));
      const double ray = h + step * layer_.pixel * lamp_[2] / along;
      hidden = std::max(hidden, (height(x + dx, y + dy) * layer_.height - ray) / 0.05);
    }
    return static_cast<float>(1 - 0.45 * std::min(1.0, hidden));
  }

  const PrintedLayer& layer_;
  Bed bed_;
  BedColours colours_;
  Rgb bare_first_, bare_second_;
  ColourTable on_first_, on_second_;
  std::vector<float> heights_;
  Vector lamp_, half_way_;
  double gloss_;
  Rectangle bed_place_, near_;
};

LitBed::LitBed(const PrintedLayer& layer, const FilamentPair& pair, Bed bed, const Lamp& lamp,
               const std::array<double, 3>& towards_camera, const Rectangle& visible) {
  const Painter painter(layer, pair, bed, lamp, towards_camera);
  near_.push_back(painter.near());
  around_.push_back(painter.around(visible));
  add_halves(near_);
  add_halves(around_);
}

LitBed::Level LitBed::level(const Rectangle& place, double pixel) {
  Level made{place.left, place.bottom, pixel, 0, 0, {}};
  made.columns = static_cast<std::size_t>(std::ceil(place.width() / pixel));
  made.rows = static_cast<std::size_t>(std::ceil(place.height() / pixel));
  made.light.resize(made.columns * made.rows);
  return made;
}

void LitBed::add_halves(Levels& levels) {
  while (levels.size() <= coarsest) {
    const Level& fine = levels.back();
    Level half{fine.left, fine.bottom, 2 * fine.pixel, fine.columns / 2, fine.rows / 2, {}};
    half.light.resize(half.columns * half.rows);
    for (std::size_t row = 0; row < half.rows; ++row) {
      for (std::size_t column = 0; column < half.columns; ++column) {
        const auto* low = &fine.light[2 * row * fine.columns + 2 * column];
        const auto* high = low + fine.columns;
        for (std::size_t i = 0; i < 3; ++i)
          half.light[row * half.columns + column][i] =
              static_cast<std::uint16_t>((low[0][i] + low[1][i] + high[0][i] + high[1][i] + 2) / 4);
      }
    }
    levels.push_back(std::move(half));
  }
}

const LitBed::Level& LitBed::nearest(const Levels& levels, double size) {
  std::size_t best = 0;
  while (best + 1 < levels.size() && levels[best].pixel * 1.41 < size) ++best;
  return levels[best];
}

bool LitBed::Level::holds(double x, double y) const {
  return x >= left + pixel && y >= bottom + pixel && x < left + pixel * (static_cast<double>(columns) - 1) &&
         y < bottom + pixel * (static_cast<double>(rows) - 1);
}

Rgb LitBed::Level::at(double x, double y) const {
  const double u = (x - left) / pixel - 0.5, v = (y - bottom) / pixel - 0.5;
  const auto column = static_cast<std::size_t>(u), row = static_cast<std::size_t>(v);
  const auto right = static_cast<float>(u - static_cast<double>(column));
  const auto up = static_cast<float>(v - static_cast<double>(row));
  const auto* low = &light[row * columns + column];
  const auto* high = low + columns;
  const float a = (1 - right) * (1 - up) / unit, b = right * (1 - up) / unit, c = (1 - right) * up / unit,
              d = right * up / unit;
  Rgb mean{};
  for (std::size_t i = 0; i < 3; ++i)
    mean[i] = a * low[0][i] + b * low[1][i] + c * high[0][i] + d * high[1][i];
  return mean;
}

Rgb LitBed::at(double x, double y, double size) const {
  const Level& fine = nearest(near_, size);
  if (fine.holds(x, y)) return fine.at(x, y);
  const Level& coarse = nearest(around_, size);
  if (coarse.holds(x, y)) return coarse.at(x, y);
  return {0.1F, 0.1F, 0.1F};
}

}  // namespace unicursal::camera
