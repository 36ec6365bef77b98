// The way of the nozzle through one layer as the page draws it: records of 9 bytes, little-endian (API.md,
// "GET /api/print/layers/N/path"): dx and dy in steps of 10 µm, a width in steps of 20 µm (0: nothing is
// laid), the mixture that was asked for, and the colour that leaves the nozzle.
//
// Places are rounded, not distances, so that errors do not add up: every end is right to 5 µm. mm.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/numeric/vec2.hpp"
#include "core/picture/image.hpp"

namespace unicursal::host {

class LaidPath {
 public:
  static constexpr std::size_t record = 9;  ///< bytes
  static constexpr std::uint8_t nothing_asked = 255;

  explicit LaidPath(const core::Vec2& from) : first_(on_grid(from)), last_(first_) {}

  /// Nothing is laid on the way.
  void travel(const core::Vec2& to);
  /// A bead; beads that are too short for the grid become a part of the next one.
  void lay(const core::Vec2& to, double width, std::uint8_t asked, picture::Colour colour);

  std::size_t size() const { return bytes_.size() / record; }
  /// Forgets the records behind the first `count`.
  void cut(std::size_t count);
  const std::string& bytes() const { return bytes_; }

  struct Place {
    std::int32_t x = 0, y = 0;  ///< 10 µm
    friend bool operator==(const Place&, const Place&) = default;
  };
  Place first() const { return first_; }
  Place last() const { return last_; }
  /// Where the record `index` begins, if the first one of `bytes` begins at `first`.
  static Place begin_of(const std::string& bytes, const Place& first, std::size_t index);

 private:
  static Place on_grid(const core::Vec2& place);
  void go(const Place& to, std::uint8_t width, std::uint8_t asked, picture::Colour colour);

  Place first_, last_;
  std::string bytes_;
};

}  // namespace unicursal::host
