#include "tests/fuzz/photos.hpp"

#include <cmath>
#include <fstream>
#include <stdexcept>

#include "core/text/file_bytes.hpp"
#include "host/photo/read_photo.hpp"
#include "host/photo/sheet.hpp"
#include "tests/camera/photo.hpp"
#include "tests/fuzz/damage.hpp"

namespace unicursal::test {
namespace {

namespace fs = std::filesystem;

const core::Box box{{0, 0}, {50, 30}};  // mm
constexpr double line = 0.8;            // mm

/// What fuzzed photos are taken for.
host::SheetPlan plan() {
  host::SheetPlan plan;
  plan.marks = host::mark_places(box);
  plan.line = line;
  plan.strokes.push_back({{8, 10}, {42, 10}, line, 2});
  return plan;
}

using Shade = std::uint8_t;

struct Canvas {
  camera::Photo photo;

  void paint(std::size_t column, std::size_t row, Shade shade) {
    for (std::size_t channel = 0; channel < 3; ++channel)
      photo.bytes[3 * (row * photo.width + column) + channel] = shade;
  }
  /// A disk within a ring.
  void mark(const core::Vec2& centre, double radius, double squeezed, Shade ink) {
    for (std::size_t row = 0; row < photo.height; ++row) {
      for (std::size_t column = 0; column < photo.width; ++column) {
        const double across = static_cast<double>(column) + 0.5 - centre.x();
        const double down = (static_cast<double>(row) + 0.5 - centre.y()) / squeezed;
        const double away = std::hypot(across, down) / radius;
        if (away <= 5.0 / 14 || (away >= 10.0 / 14 && away <= 1)) paint(column, row, ink);
      }
    }
  }
};

Canvas bed(core::Random& random, std::size_t least) {
  Canvas canvas{{least + random.below(160), least + random.below(160), {}}};
  canvas.photo.bytes.assign(3 * canvas.photo.width * canvas.photo.height,
                            static_cast<Shade>(random.below(256)));
  return canvas;
}

/// A bed with up to nine marks, in places and sizes of their own.
camera::Photo strange_marks(core::Random& random) {
  Canvas canvas = bed(random, 120);
  for (std::size_t marks = random.below(10); marks > 0; --marks) {
    const core::Vec2 centre{random.uniform() * static_cast<double>(canvas.photo.width),
                            random.uniform() * static_cast<double>(canvas.photo.height)};
    canvas.mark(centre, random.uniform(3, 18), random.uniform(0.6, 1), static_cast<Shade>(random.below(256)));
  }
  return canvas.photo;
}

/// The marks of the plan, turned, and here and there one more or one too few.
camera::Photo planned_marks(core::Random& random) {
  Canvas canvas = bed(random, 300);
  const double scale = random.uniform(4.1, 5), turn = random.uniform(-0.3, 0.3);
  const core::Vec2 middle{static_cast<double>(canvas.photo.width) / 2,
                          static_cast<double>(canvas.photo.height) / 2};
  const auto seen = [&](const core::Vec2& place) {
    const core::Vec2 from = scale * (place - core::Vec2{25, 15});
    return core::Vec2{middle + core::Vec2{std::cos(turn) * from.x() + std::sin(turn) * from.y(),
                                          std::sin(turn) * from.x() - std::cos(turn) * from.y()}};
  };
  const auto ink = static_cast<Shade>(random.below(256));
  for (const core::Vec2& mark : plan().marks) {
    if (random.below(40) > 0) canvas.mark(seen(mark), scale * 7 * line, 1, ink);
  }
  if (random.below(8) == 0) canvas.mark(seen({random.uniform(0, 50), 15}), scale * 7 * line, 1, ink);
  for (double x = 8; x <= 42; x += 0.1) {
    const core::Vec2 at = seen({x, 10});  // a stroke, thinner than the plan has it
    canvas.paint(static_cast<std::size_t>(at.x()), static_cast<std::size_t>(at.y()), ink);
  }
  return canvas.photo;
}

/// Damage in the headers, which say how to read the rest, and anywhere.
void damage(const fs::path& file, core::Random& random) {
  std::string bytes = core::file_bytes(file);
  const std::size_t head = std::min<std::size_t>(bytes.size(), 700);
  if (random.below(2) == 0) bytes = damaged(bytes.substr(0, head), random) + bytes.substr(head);
  if (random.below(2) == 0) bytes = damaged(bytes, random);
  std::ofstream(file, std::ios::binary) << bytes;
}

}  // namespace

void photo(const fs::path& folder, core::Random& random) {
  const fs::path file = folder / (random.below(2) == 0 ? "photo.jpg" : "photo.png");
  const bool planned = random.below(2) == 0;
  camera::write_photo(file, planned ? planned_marks(random) : strange_marks(random),
                      40 + static_cast<int>(random.below(60)), 1 + static_cast<int>(random.below(8)));
  if (random.below(3) > 0) damage(file, random);
  const host::Photo read = host::read_photo(file);
  if (read.width() * read.height() > 400'000)
    return;  // finding marks in it would take the other rounds' time
  const host::Sheet sheet(read, plan(), std::nullopt, file);
  const host::SeenLight seen = sheet.light({25, 15}, {1, 0}, 2, 0.4);
  if (!(seen.clipped >= 0 && seen.clipped <= 1)) throw std::runtime_error("a share of pixels is not a share");
}

}  // namespace unicursal::test
