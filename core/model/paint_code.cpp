#include "core/model/paint_code.hpp"

#include <cstdint>

#include "core/text/malformed.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {
namespace {

constexpr std::size_t most_leaves = 100000;
constexpr int deepest = 64;  ///< levels; the sides are halved each time, so that no real tree is half as deep

class Decoder {
 public:
  explicit Decoder(std::string_view code) : code_(code) {}

  std::vector<PaintedLeaf> decode() {
    read({Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}, 0);
    if (!code_.empty()) refuse();
    return std::move(leaves_);
  }

 private:
  [[noreturn]] static void refuse() { throw Malformed("its paint is not a tree of painted pieces"); }

  unsigned digit() {
    if (code_.empty()) refuse();
    const char c = code_.back();
    code_.remove_suffix(1);
    if (c >= '0' && c <= '9') return unsigned(c - '0');
    if (c >= 'A' && c <= 'F') return unsigned(c - 'A' + 10);
    if (c >= 'a' && c <= 'f') return unsigned(c - 'a' + 10);
    refuse();
  }

  void read(const Triangle& t, int depth) {
    const unsigned code = digit(), sides = code & 3, high = code >> 2;
    if (sides == 0) return leaf(t, high);
    if (depth >= deepest || high > 2) refuse();
    const std::vector<Triangle> parts = divided(t, sides, high);
    for (auto part = parts.rbegin(); part != parts.rend(); ++part) read(*part, depth + 1);
  }

  void leaf(const Triangle& t, std::size_t filament) {
    if (filament == 3) {
      unsigned more = digit();
      // Only newer versions of Bambu Studio continue; a 15 means that another digit follows.
      while (more == 15) filament += more, more = digit();
      filament += more;
    }
    if (filament == 0) return;
    if (leaves_.size() >= most_leaves) refuse();
    leaves_.push_back({filament, t});
  }

  static std::vector<Triangle> divided(const Triangle& t, unsigned sides, unsigned first) {
    if (sides == 3) first = 0;
    const Vec3 &i = t[first], &j = t[(first + 1) % 3], &k = t[(first + 2) % 3];
    const Vec3 ij = (i + j) / 2, jk = (j + k) / 2, ki = (k + i) / 2;
    if (sides == 1) return {{i, j, jk}, {jk, k, i}};
    if (sides == 2) return {{i, ij, ki}, {ij, j, ki}, {j, k, ki}};
    return {{i, ij, ki}, {ij, j, jk}, {jk, k, ki}, {ij, jk, ki}};
  }

  std::string_view code_;
  std::vector<PaintedLeaf> leaves_;
};

}  // namespace

std::vector<PaintedLeaf> painted_leaves(std::string_view code) {
  return Decoder(code).decode();
}

}  // namespace unicursal::core
