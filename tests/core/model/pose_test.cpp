// Turning, mirroring and scaling parts.
#include <catch2/catch.hpp>

#include <Eigen/Geometry>

#include "core/error.hpp"
#include "core/model/largest_face.hpp"
#include "core/model/read_part.hpp"
#include "model_support.hpp"

namespace unicursal::core {
namespace {

using Catch::Matchers::Contains;

Eigen::Matrix3d about(double degrees, const Vec3& axis) {
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis.normalized()).toRotationMatrix();
}

Mesh turned(Mesh mesh, const Eigen::Matrix3d& rotation) {
  for (Triangle& triangle : mesh) {
    for (Vec3& corner : triangle) corner = rotation * corner;
  }
  return mesh;
}

struct Posed {
  Vec3 size;
  double volume;
  std::vector<std::string> notes;
};

Posed read(const std::filesystem::path& file, const Pose& pose) {
  const PartSource source{{file}, 2.0, 0.1, zones({file.filename().string()})};
  const auto part = read_part(source, {pose});
  double volume = 0;
  for (std::size_t i = 0; i < part->layer_count(); ++i)
    volume += outline_area(part->layer(i)) * part->layer(i).height;
  return {{part->extent().size().x(), part->extent().size().y(), part->height()}, volume, part->warnings()};
}

}  // namespace

TEST_CASE("Scale, mirror and rotation act in this order, and change neither volume nor outside") {
  const TempFolder folder;
  // An L: mirrored without care its facets would face inwards.
  const auto file = folder.write(
      "l.stl", binary_stl(joined(box_mesh({0, 0, 0}, {20, 5, 4}), box_mesh({0, 5, 0}, {5, 15, 4}))));
  const double volume = (100 + 50) * 4;
  Pose pose;
  pose.scale = {-1, 1, 1};
  const Posed mirrored = read(file, pose);
  CHECK(mirrored.size.isApprox(Vec3(20, 15, 4)));
  CHECK(mirrored.volume == Approx(volume));
  CHECK(mirrored.notes.empty());
  pose.scale = {2, 1, 0.5};
  pose.rotation = about(90, Vec3::UnitX());
  const Posed laid = read(file, pose);
  CHECK(laid.size.isApprox(Vec3(40, 2, 15), 1e-6));
  CHECK(laid.volume == Approx(volume));
  pose.scale = Vec3::Constant(1e9);
  CHECK_THROWS_WITH(read(file, pose), Contains("100 m away") && Contains("write smaller ones"));
}

TEST_CASE("A part lies on the largest face of its hull") {
  const TempFolder folder;
  Pose pose;
  pose.on_largest_face = true;
  const Mesh box = box_mesh({0, 0, 0}, {3, 20, 50});
  const Posed standing = read(folder.write("box.stl", binary_stl(box)), pose);
  CHECK(standing.size.z() == Approx(3));
  CHECK(standing.volume == Approx(3000));
  const Posed tilted =
      read(folder.write("tilted.stl", binary_stl(turned(box, about(37, Vec3(1, 2, 3))))), pose);
  CHECK(tilted.size.z() == Approx(3).epsilon(0.04));  // layers of 0.1 mm
  CHECK(tilted.volume == Approx(3000).epsilon(0.04));
  // A table on four legs stands on them or on its top, not on the underside of its top.
  Mesh table = box_mesh({0, 0, 20}, {40, 30, 22});
  for (const double x : {0.0, 38.0}) {
    for (const double y : {0.0, 28.0}) table = joined(table, box_mesh({x, y, 0}, {x + 2, y + 2, 20}));
  }
  const Posed upright = read(folder.write("table.stl", binary_stl(table)), pose);
  CHECK(upright.size.isApprox(Vec3(40, 30, 22), 1e-6));
}

TEST_CASE("Of faces of the same size the one that is down stays down") {
  std::vector<Vec3> cube;
  for (int i = 0; i < 8; ++i) cube.emplace_back(i & 1, i >> 1 & 1, i >> 2);
  CHECK(largest_face_down(cube) == Eigen::Matrix3d::Identity());
  CHECK(largest_face_down({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}) == Eigen::Matrix3d::Identity());
  CHECK(largest_face_down({}) == Eigen::Matrix3d::Identity());
}

TEST_CASE("A drawing is turned, mirrored and brought to a width") {
  const TempFolder folder;
  const auto file =
      folder.write("d.svg", drawing("<path d='M 0 0 H 20 V 5 H 0 Z'/><circle cx='50' cy='50' r='4'/>"));
  Pose pose;
  CHECK(read(file, pose).size.head<2>().isApprox(Vec2(54, 54), 1e-3));
  pose.rotation = about(90, Vec3::UnitZ());
  pose.scale = {2, 1, 1};
  CHECK(read(file, pose).size.head<2>().isApprox(Vec2(54, 108), 1e-3));
  pose.width = 10.8;
  CHECK(read(file, pose).size.head<2>().isApprox(Vec2(10.8, 21.6), 1e-3));
}

}  // namespace unicursal::core
