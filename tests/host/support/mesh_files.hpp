// Files of meshes for tests of the host. Lengths in mm.
#pragma once

#include <array>
#include <string>
#include <utility>

namespace unicursal::test {

/// A box in an OBJ file, with one corner at (x, 0, 0); `first`: the number of its first vertex.
inline std::string box_obj(const std::array<double, 3>& size, double x = 0, int first = 1) {
  std::string text;
  for (int corner = 0; corner < 8; ++corner) {
    text += "v " + std::to_string(x + (corner & 1) * size[0]) + ' ' +
            std::to_string((corner >> 1 & 1) * size[1]) + ' ' + std::to_string((corner >> 2) * size[2]) +
            '\n';
  }
  for (const std::array<int, 4>& side :
       {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    text += "f";
    for (const int corner : side) text += ' ' + std::to_string(first + corner);
    text += '\n';
  }
  return text;
}

}  // namespace unicursal::test
