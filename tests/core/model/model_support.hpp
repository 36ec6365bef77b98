// Shapes and files for the tests of core/model. Lengths in mm.
#pragma once

#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "core/model/part.hpp"
#include "core/model/read_part.hpp"
#include "core/model/stl_reader.hpp"
#include "tests/paths.hpp"

namespace unicursal::core {

/// A folder of its own that goes away with the test.
class TempFolder {
 public:
  TempFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "unicursal-model-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~TempFolder() { std::filesystem::remove_all(path_); }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

inline std::filesystem::path test_data(const std::string& name) {
  return unicursal::test::data_folder() / name;
}

/// A page of 100 mm × 80 mm whose user unit is 1 mm.
inline std::string drawing(const std::string& elements) {
  return "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 100 80' width='100mm' height='80mm'>" +
         elements + "</svg>";
}

inline std::vector<Zone> zones(const std::vector<std::string>& selects) {
  std::vector<Zone> result;
  for (const std::string& select : selects) result.push_back({select, {}, result.size()});
  return result;
}

inline std::unique_ptr<const Part> part(const std::vector<std::filesystem::path>& files,
                                        const std::vector<std::string>& selects, double layer_height = 0.2,
                                        double height = 1.0) {
  return read_part({files, height, layer_height, zones(selects)});
}

inline double zone_area(const Layer& layer, std::size_t zone) {
  double sum = 0;
  for (const Island& island : layer.islands) {
    for (const ZoneRegion& region : island.zones) sum += region.zone == zone ? area(region.polygons) : 0;
  }
  return sum;
}

inline double outline_area(const Layer& layer) {
  double sum = 0;
  for (const Island& island : layer.islands) sum += area(island.outline);
  return sum;
}

using Mesh = std::vector<Triangle>;

/// Two triangles, counter-clockwise for a, b, c, d in that order.
inline void add_quad(Mesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  mesh.push_back({a, b, c});
  mesh.push_back({a, c, d});
}

inline Mesh box_mesh(const Vec3& lo, const Vec3& hi) {
  const auto p = [&](int x, int y, int z) {
    return Vec3(x ? hi.x() : lo.x(), y ? hi.y() : lo.y(), z ? hi.z() : lo.z());
  };
  Mesh mesh;
  add_quad(mesh, p(0, 0, 0), p(0, 1, 0), p(1, 1, 0), p(1, 0, 0));
  add_quad(mesh, p(0, 0, 1), p(1, 0, 1), p(1, 1, 1), p(0, 1, 1));
  add_quad(mesh, p(0, 0, 0), p(1, 0, 0), p(1, 0, 1), p(0, 0, 1));
  add_quad(mesh, p(0, 1, 0), p(0, 1, 1), p(1, 1, 1), p(1, 1, 0));
  add_quad(mesh, p(0, 0, 0), p(0, 0, 1), p(0, 1, 1), p(0, 1, 0));
  add_quad(mesh, p(1, 0, 0), p(1, 1, 0), p(1, 1, 1), p(1, 0, 1));
  return mesh;
}

/// Axis along z, centre in the origin.
inline Mesh torus_mesh(double big, double small, int around, int across) {
  const auto p = [&](int i, int j) {
    const double u = 2 * std::numbers::pi * (i % around) / around,
                 v = 2 * std::numbers::pi * (j % across) / across;
    const double r = big + small * std::cos(v);
    return Vec3(r * std::cos(u), r * std::sin(u), small * std::sin(v));
  };
  Mesh mesh;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) add_quad(mesh, p(i, j), p(i + 1, j), p(i + 1, j + 1), p(i, j + 1));
  }
  return mesh;
}

inline void turn_over(Triangle& triangle) {
  std::swap(triangle[1], triangle[2]);
}

inline Mesh joined(Mesh a, const Mesh& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

inline void append_little_endian(std::string& bytes, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
}

inline std::string binary_stl(const Mesh& mesh, const std::string& header = "") {
  std::string bytes = header;
  bytes.resize(80, ' ');
  append_little_endian(bytes, std::uint32_t(mesh.size()));
  for (const Triangle& triangle : mesh) {
    bytes.append(12, '\0');
    for (const Vec3& corner : triangle) {
      for (const double value : corner)
        append_little_endian(bytes, std::bit_cast<std::uint32_t>(float(value)));
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

}  // namespace unicursal::core
