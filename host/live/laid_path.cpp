#include "host/live/laid_path.hpp"

#include <algorithm>
#include <cmath>

namespace unicursal::host {
namespace {

constexpr double grid = 0.01;             ///< mm
constexpr double width_step = 0.02;       ///< mm
constexpr std::int32_t farthest = 30000;  ///< steps of a record
constexpr double widest_bed = 1e4;        ///< mm; what is beyond is cut off

void put16(std::string& bytes, std::int32_t value) {
  const auto word = static_cast<std::uint16_t>(static_cast<std::int16_t>(value));
  bytes.push_back(static_cast<char>(word & 0xff));
  bytes.push_back(static_cast<char>(word >> 8));
}

std::int32_t int16_at(const std::string& bytes, std::size_t at) {
  const auto low = static_cast<unsigned char>(bytes[at]), high = static_cast<unsigned char>(bytes[at + 1]);
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(low | high << 8));
}

}  // namespace

LaidPath::Place LaidPath::on_grid(const core::Vec2& place) {
  const auto steps = [](double at) {
    return static_cast<std::int32_t>(std::lround(std::clamp(at, -widest_bed, widest_bed) / grid));
  };
  return {steps(place.x()), steps(place.y())};
}

void LaidPath::travel(const core::Vec2& to) {
  go(on_grid(to), 0, nothing_asked, {});
}

void LaidPath::lay(const core::Vec2& to, double width, std::uint8_t asked, picture::Colour colour) {
  const double steps = std::clamp(std::round(width / width_step), 1.0, 255.0);
  go(on_grid(to), static_cast<std::uint8_t>(steps), asked, colour);
}

void LaidPath::go(const Place& to, std::uint8_t width, std::uint8_t asked, picture::Colour colour) {
  const std::int32_t dx = to.x - last_.x, dy = to.y - last_.y;
  if (dx == 0 && dy == 0) return;
  const std::int32_t pieces = (std::max(std::abs(dx), std::abs(dy)) + farthest - 1) / farthest;
  for (std::int32_t piece = 1; piece <= pieces; ++piece) {
    const auto part = [&](std::int32_t whole) {
      return static_cast<std::int32_t>(std::int64_t{whole} * piece / pieces -
                                       std::int64_t{whole} * (piece - 1) / pieces);
    };
    put16(bytes_, part(dx));
    put16(bytes_, part(dy));
    for (const std::uint8_t byte : {width, asked, colour.r, colour.g, colour.b})
      bytes_.push_back(static_cast<char>(byte));
  }
  last_ = to;
}

LaidPath::Place LaidPath::begin_of(const std::string& bytes, const Place& first, std::size_t index) {
  Place place = first;
  for (std::size_t i = 0; i < index; ++i) {
    place.x += int16_at(bytes, i * record);
    place.y += int16_at(bytes, i * record + 2);
  }
  return place;
}

void LaidPath::cut(std::size_t count) {
  bytes_.resize(std::min(count, size()) * record);
  last_ = begin_of(bytes_, first_, size());
}

}  // namespace unicursal::host
