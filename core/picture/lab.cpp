#include "core/picture/lab.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace unicursal::picture {
namespace {

using Row = std::array<double, 3>;

// Linear sRGB to XYZ (IEC 61966-2-1, amendment 1), and back.
constexpr std::array<Row, 3> to_xyz{{{0.4124564, 0.3575761, 0.1804375},
                                     {0.2126729, 0.7151522, 0.0721750},
                                     {0.0193339, 0.1191920, 0.9503041}}};
constexpr std::array<Row, 3> from_xyz{{{3.2404542, -1.5371385, -0.4985314},
                                       {-0.9692660, 1.8760108, 0.0415560},
                                       {0.0556434, -0.2040259, 1.0572252}}};
constexpr double epsilon = 216.0 / 24389, kappa = 24389.0 / 27;

double white(std::size_t axis) {
  return to_xyz[axis][0] + to_xyz[axis][1] + to_xyz[axis][2];
}

std::array<double, 3> product(const std::array<Row, 3>& rows, const std::array<double, 3>& v) {
  std::array<double, 3> result{};
  for (std::size_t i = 0; i < 3; ++i) result[i] = rows[i][0] * v[0] + rows[i][1] * v[1] + rows[i][2] * v[2];
  return result;
}

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

/// The hue angle in degrees, 0…360; 0 for grey.
double hue(double a, double b) {
  if (a == 0 && b == 0) return 0;
  const double angle = std::atan2(b, a) * 180 / std::numbers::pi;
  return angle < 0 ? angle + 360 : angle;
}

/// Chroma's part in the correction of a: √(C⁷ / (C⁷ + 25⁷)).
double chroma_part(double chroma) {
  const double power = std::pow(chroma, 7);
  return std::sqrt(power / (power + std::pow(25.0, 7)));
}

/// The bytes of sRGB for linear light. Pictures ask this for each pixel, so it takes no powers.
class Bytes {
 public:
  Bytes() {
    for (std::size_t byte = 0; byte + 1 < from_.size(); ++byte)
      from_[byte] = byte == 0 ? 0 : decoded((double(byte) - 0.5) / 255);
    from_.back() = std::numeric_limits<double>::infinity();
    for (std::size_t step = 0; step < first_.size(); ++step)
      first_[step] = static_cast<std::uint8_t>(searched(double(step) / steps));
  }

  /// The nearest one.
  std::uint8_t of(double linear) const {
    if (!(linear > 0)) return 0;
    if (linear >= 1) return 255;
    std::size_t byte = first_[static_cast<std::size_t>(linear * steps)];
    while (linear >= from_[byte + 1]) ++byte;
    return static_cast<std::uint8_t>(byte);
  }

 private:
  static constexpr std::size_t steps = 4096;

  std::size_t searched(double linear) const {
    return static_cast<std::size_t>(std::upper_bound(from_.begin(), from_.end(), linear) - from_.begin()) - 1;
  }

  std::array<double, 257> from_{};           ///< the least light of each byte
  std::array<std::uint8_t, steps> first_{};  ///< the byte of the least light of each step
};

}  // namespace

double decoded(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double encoded(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

Light light_of(Colour colour) {
  return {decoded(colour.r / 255.0), decoded(colour.g / 255.0), decoded(colour.b / 255.0)};
}

Colour colour_of(const Light& light) {
  static const Bytes bytes;
  return {bytes.of(light[0]), bytes.of(light[1]), bytes.of(light[2])};
}

Lab lab_of(const Light& light) {
  std::array<double, 3> f = product(to_xyz, light);
  for (std::size_t i = 0; i < 3; ++i) {
    const double part = f[i] / white(i);
    f[i] = part > epsilon ? std::cbrt(part) : (kappa * part + 16) / 116;
  }
  return {116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])};
}

Light light_of(const Lab& lab) {
  const double fy = (lab.lightness + 16) / 116;
  std::array<double, 3> xyz{fy + lab.a / 500, fy, fy - lab.b / 200};
  for (std::size_t i = 0; i < 3; ++i) {
    const double cube = xyz[i] * xyz[i] * xyz[i];
    xyz[i] = (cube > epsilon ? cube : (116 * xyz[i] - 16) / kappa) * white(i);
  }
  return product(from_xyz, xyz);
}

double difference(const Lab& one, const Lab& other) {
  const double stretch =
      1.5 - 0.5 * chroma_part((std::hypot(one.a, one.b) + std::hypot(other.a, other.b)) / 2);
  const double a1 = one.a * stretch, a2 = other.a * stretch;
  const double c1 = std::hypot(a1, one.b), c2 = std::hypot(a2, other.b);
  const double h1 = hue(a1, one.b), h2 = hue(a2, other.b);
  const bool grey = c1 * c2 == 0;
  double turn = grey ? 0 : h2 - h1;
  if (turn > 180) turn -= 360;
  if (turn < -180) turn += 360;
  const double dl = other.lightness - one.lightness, dc = c2 - c1;
  const double dh = 2 * std::sqrt(c1 * c2) * std::sin(radians(turn / 2));
  const double l = (one.lightness + other.lightness) / 2, c = (c1 + c2) / 2;
  double h = h1 + h2;
  if (!grey) h = std::abs(h1 - h2) <= 180 ? h / 2 : (h < 360 ? (h + 360) / 2 : (h - 360) / 2);
  const double t = 1 - 0.17 * std::cos(radians(h - 30)) + 0.24 * std::cos(radians(2 * h)) +
                   0.32 * std::cos(radians(3 * h + 6)) - 0.20 * std::cos(radians(4 * h - 63));
  const double middle = (l - 50) * (l - 50);
  const double sl = 1 + 0.015 * middle / std::sqrt(20 + middle), sc = 1 + 0.045 * c, sh = 1 + 0.015 * c * t;
  const double far = (h - 275) / 25;
  const double rt = -2 * chroma_part(c) * std::sin(radians(60 * std::exp(-far * far)));
  const double x = dl / sl, y = dc / sc, z = dh / sh;
  return std::sqrt(std::max(0.0, x * x + y * y + z * z + rt * y * z));
}

std::string in_words(double difference) {
  if (difference <= 1) return "the same to the eye";
  if (difference <= 3) return "very near";
  if (difference <= 6) return "near";
  return difference <= 12 ? "a similar colour" : "another colour";
}

}  // namespace unicursal::picture
