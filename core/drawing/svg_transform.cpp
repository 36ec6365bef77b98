#include "core/drawing/svg_transform.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "core/text/malformed.hpp"
#include "core/text/number_scanner.hpp"

namespace unicursal::core {
namespace {

struct Argument {
  double value = 0;
  std::string unit;
};

double radians(const Argument& angle) {
  constexpr double degree = std::numbers::pi / 180;
  if (angle.unit.empty() || angle.unit == "deg") return angle.value * degree;
  if (angle.unit == "grad") return angle.value * degree * 0.9;
  if (angle.unit == "rad") return angle.value;
  if (angle.unit == "turn") return angle.value * degree * 360;
  throw Malformed("the angle's unit " + in_quotes(angle.unit) + " is not one of deg, grad, rad, turn");
}

Eigen::Affine2d linear_map(double a, double b, double c, double d, double e, double f) {
  Eigen::Affine2d map;
  map.matrix() << a, c, e, b, d, f, 0, 0, 1;
  return map;
}

class SingleTransform {
 public:
  SingleTransform(std::string_view name, const std::vector<Argument>& arguments, const TransformFrame& frame)
      : name_(lower(name)), v_(arguments), frame_(frame) {}

  Eigen::Affine2d map() const {
    const std::size_t n = v_.size();
    if (name_ == "matrix" && n == 6)
      return linear_map(plain(0), plain(1), plain(2), plain(3), plain(4), plain(5));
    if (name_ == "translate" && (n == 1 || n == 2)) return move(along(0, 0), n == 2 ? along(1, 1) : 0);
    if (name_ == "translatex" && n == 1) return move(along(0, 0), 0);
    if (name_ == "translatey" && n == 1) return move(0, along(0, 1));
    if (name_ == "scale" && (n == 1 || n == 2)) return stretch(plain(0), plain(n - 1));
    if (name_ == "scalex" && n == 1) return stretch(plain(0), 1);
    if (name_ == "scaley" && n == 1) return stretch(1, plain(0));
    if (name_ == "rotate" && (n == 1 || n == 3)) return rotation();
    if (name_ == "skew" && (n == 1 || n == 2))
      return linear_map(1, n == 2 ? std::tan(radians(v_[1])) : 0, std::tan(radians(v_[0])), 1, 0, 0);
    if (name_ == "skewx" && n == 1) return linear_map(1, 0, std::tan(radians(v_[0])), 1, 0, 0);
    if (name_ == "skewy" && n == 1) return linear_map(1, std::tan(radians(v_[0])), 0, 1, 0, 0);
    throw Malformed(fmt::format("the transform {} with {} numbers is unknown", in_quotes(name_), n));
  }

 private:
  double plain(std::size_t i) const { return v_[i].unit == "%" ? v_[i].value / 100 : v_[i].value; }
  double along(std::size_t i, int axis) const {
    const auto px = px_per_unit(v_[i].unit, {frame_.box.size()[axis], frame_.font_size});
    if (!px) throw Malformed("the unit " + in_quotes(v_[i].unit) + " is not one of a length");
    return v_[i].value * *px;
  }
  static Eigen::Affine2d move(double x, double y) { return linear_map(1, 0, 0, 1, x, y); }
  static Eigen::Affine2d stretch(double x, double y) { return linear_map(x, 0, 0, y, 0, 0); }
  Eigen::Affine2d rotation() const {
    const Eigen::Affine2d turn(Eigen::Rotation2Dd(radians(v_[0])));
    if (v_.size() == 1) return turn;
    const Vec2 center(along(1, 0), along(2, 1));
    return Eigen::Translation2d(center) * turn * Eigen::Translation2d(-center);
  }

  std::string name_;
  const std::vector<Argument>& v_;
  const TransformFrame& frame_;
};

Argument argument(NumberScanner& scanner) {
  Argument result{scanner.required(), {}};
  if (scanner.peek() == '%') {
    result.unit = "%";
    scanner.advance();
  } else {
    result.unit = lower(scanner.word());
  }
  return result;
}

std::vector<Argument> arguments(NumberScanner& scanner) {
  scanner.skip_spaces();
  if (scanner.peek() != '(') throw Malformed("a transform lacks its opening parenthesis");
  scanner.advance();
  std::vector<Argument> values;
  scanner.skip_spaces();
  while (scanner.peek() != ')') {
    if (values.size() >= 6) throw Malformed("a transform has more than six numbers");
    values.push_back(argument(scanner));
    scanner.skip_spaces();
  }
  scanner.advance();
  return values;
}

}  // namespace

Eigen::Affine2d transform(std::string_view text, const TransformFrame& frame) {
  Eigen::Affine2d result = Eigen::Affine2d::Identity();
  NumberScanner scanner(text);
  scanner.skip_separator();
  if (text == "none") return result;
  while (!scanner.at_end()) {
    const std::string_view name = scanner.word();
    if (name.empty()) throw Malformed("a transform should start at " + in_quotes(scanner.rest()));
    result = result * SingleTransform(name, arguments(scanner), frame).map();
    scanner.skip_separator();
  }
  return result;
}

Vec2 transform_origin(std::string_view text, const TransformFrame& frame) {
  const Box& box = frame.box;
  Vec2 point = box.center();
  NumberScanner scanner(text);
  int axis = 0;
  for (scanner.skip_spaces(); !scanner.at_end() && axis < 2; scanner.skip_spaces()) {
    if (scanner.starts_number()) {
      const Argument shift = argument(scanner);
      const auto px = px_per_unit(shift.unit, {box.size()[axis], frame.font_size});
      if (!px) throw Malformed("the unit " + in_quotes(shift.unit) + " is not one of a length");
      point[axis] = box.min[axis] + shift.value * *px;
    } else {
      const std::string word = lower(scanner.word());
      if (word == "left") {
        point.x() = box.min.x();
      } else if (word == "right") {
        point.x() = box.max.x();
      } else if (word == "top") {
        point.y() = box.min.y();
      } else if (word == "bottom") {
        point.y() = box.max.y();
      } else if (word != "center") {
        throw Malformed(in_quotes(text) + " is not a point");
      }
    }
    ++axis;
  }
  return point;
}

}  // namespace unicursal::core
