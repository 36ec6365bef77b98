#include "host/job/placing.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/model/file_kind.hpp"

namespace unicursal::host {
namespace {

constexpr double least_scale = 1e-4, greatest_scale = 1e4;
constexpr double greatest_width = 10000;  // mm

bool has_drawing(const core::PartSource& source) {
  return std::any_of(source.files.begin(), source.files.end(), core::is_drawing_file);
}

double read_units(const Section& part, const core::PartSource& source) {
  const toml::node* node = part.find("units");
  if (!node) return 1;
  static const std::vector<std::pair<std::string, double>> units{
      {"micron", 0.001}, {"mm", 1}, {"cm", 10}, {"inch", 25.4}, {"foot", 304.8}, {"m", 1000}};
  std::vector<std::string> names;
  for (const auto& [name, size] : units) names.push_back(name);
  const std::string unit = part.choice("units", *node, names);
  if (!std::all_of(source.files.begin(), source.files.end(), core::is_unitless_file)) {
    part.fail("units", "is only for .stl and .obj files; all others name their unit themselves",
              "leave it out, or write for example scale = 25.4");
  }
  return std::find_if(units.begin(), units.end(), [&](const auto& known) { return known.first == unit; })
      ->second;
}

Eigen::Vector3d read_scale(const Section& part, const core::PartSource& source) {
  const Range range = between(least_scale, greatest_scale, "");
  const char* const remedy = "write a factor, for example scale = 2.0, or one for each of x, y and z";
  const toml::node* node = part.find("scale");
  if (!node) return Eigen::Vector3d::Ones();
  if (!node->is_array()) {
    const double factor = part.number("scale", range, remedy);
    return Eigen::Vector3d::Constant(factor);
  }
  const auto factors = part.numbers_or<3>("scale", {1, 1, 1}, range, remedy);
  if (has_drawing(source) && factors[2] != 1) {
    part.fail("scale", "stretches a drawing in z, where it is flat", "write 1 for z, and set height");
  }
  return {factors[0], factors[1], factors[2]};
}

Eigen::Vector3d read_mirror(const Section& part, const core::PartSource& source) {
  Eigen::Vector3d signs = Eigen::Vector3d::Ones();
  const toml::node* node = part.find("mirror");
  if (!node) return signs;
  const std::string axis = part.choice("mirror", *node, {"x", "y", "z"});
  if (axis == "z" && has_drawing(source))
    part.fail("mirror", "is \"z\", but a drawing is flat", "write \"x\" or \"y\"");
  signs[axis[0] - 'x'] = -1;
  return signs;
}

Eigen::Matrix3d read_rotation(const Section& part, const core::PartSource& source) {
  const toml::node* node = part.find("rotate");
  if (!node) return Eigen::Matrix3d::Identity();
  const Range range = between(-360, 360, "°");
  const char* const remedy =
      "write degrees about x, y and z, for example rotate = [90, 0, 0], or one number for z";
  std::array<double, 3> degrees{};
  if (node->is_array()) {
    degrees = part.numbers_or<3>("rotate", degrees, range, remedy);
  } else {
    degrees[2] = part.number("rotate", range, remedy);
  }
  if (has_drawing(source) && (degrees[0] != 0 || degrees[1] != 0)) {
    part.fail("rotate", "tilts a drawing, which is flat", "write one number, the degrees about z");
  }
  const auto about = [&](std::size_t axis, const Eigen::Vector3d& direction) {
    return Eigen::AngleAxisd(degrees[axis] * std::numbers::pi / 180, direction).toRotationMatrix();
  };
  Eigen::Matrix3d turn = about(2, Eigen::Vector3d::UnitZ()) * about(1, Eigen::Vector3d::UnitY()) *
                         about(0, Eigen::Vector3d::UnitX());
  // Quarter turns are exact, so that flat sides stay flat.
  return turn.unaryExpr([](double x) { return std::abs(x - std::round(x)) < 1e-15 ? std::round(x) : x; });
}

bool read_lie_on(const Section& part, const core::PartSource& source) {
  const toml::node* node = part.find("lie_on");
  if (!node) return false;
  const bool largest = part.choice("lie_on", *node, {"file-underside", "largest-face"}) == "largest-face";
  if (largest && has_drawing(source)) part.fail("lie_on", "turns a drawing, which is flat", "leave it out");
  return largest;
}

}  // namespace

core::Pose read_pose(const Section& part, const core::PartSource& source) {
  core::Pose pose;
  pose.scale = read_units(part, source) * read_scale(part, source).cwiseProduct(read_mirror(part, source));
  pose.on_largest_face = read_lie_on(part, source);
  pose.rotation = read_rotation(part, source);
  if (!part.has("width")) return pose;
  if (!has_drawing(source)) part.fail("width", "is only for drawings", "write scale for meshes");
  pose.width =
      part.number("width", {0, greatest_width, true, "mm"}, "write how wide the drawing is to be, in mm");
  return pose;
}

}  // namespace unicursal::host
