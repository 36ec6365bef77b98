#include "tests/camera/pinhole.hpp"

#include <algorithm>
#include <cmath>

namespace unicursal::camera {
namespace {

using Vector = std::array<double, 3>;

constexpr double focal_part = 0.72;  ///< focal length ÷ longer side of the photo: the main camera of a phone
constexpr int edge_samples = 8;      ///< of the subject's outline, for each side

double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector scaled_sum(double s, const Vector& a, double t, const Vector& b) {
  return {s * a[0] + t * b[0], s * a[1] + t * b[1], s * a[2] + t * b[2]};
}

}  // namespace

Pinhole::Pinhole(const View& view, std::size_t width, std::size_t height, const Rectangle& subject)
    : width_(static_cast<double>(width)),
      height_(static_cast<double>(height)),
      focal_(focal_part * std::max(width_, height_)),
      k1_(view.k1),
      k2_(view.k2),
      middle_{(subject.left + subject.right) / 2, (subject.bottom + subject.top) / 2} {
  const double s = std::sin(view.slant), c = std::cos(view.slant);
  const double x = std::cos(view.slant_towards), y = std::sin(view.slant_towards);
  towards_ = {s * x, s * y, c};
  ahead_ = {-s * x, -s * y, -c};
  // Upright is the picture whose upper edge is at the back of the bed, tilted about the axis (−y, x, 0).
  const Vector level = {-y, x, 0}, uphill = {c * x, c * y, -s};
  const Vector right = scaled_sum(-y, level, x, uphill), up = scaled_sum(x, level, y, uphill);
  const double cos_turn = std::cos(view.turn), sin_turn = std::sin(view.turn);
  right_ = scaled_sum(cos_turn, right, sin_turn, up);
  down_ = scaled_sum(sin_turn, right, -cos_turn, up);
  double near = 1, far = 1e5;
  for (int i = 0; i < 60; ++i) {
    const double distance = std::sqrt(near * far);
    stand_at(distance);
    (overhang(subject) > view.framing ? near : far) = distance;
  }
  stand_at(far);
}

void Pinhole::stand_at(double distance) {
  eye_ = {middle_.x + distance * towards_[0], middle_.y + distance * towards_[1], distance * towards_[2]};
}

/// How far the subject reaches from the middle of the photo, in halves of its sides; infinite if a part of it
/// is behind the camera or too far from the axis.
double Pinhole::overhang(const Rectangle& subject) const {
  double most = 0;
  for (int i = 0; i <= edge_samples; ++i) {
    const double along = static_cast<double>(i) / edge_samples;
    const double x = subject.left + along * subject.width(), y = subject.bottom + along * subject.height();
    for (const Place& place :
         {Place{x, subject.bottom}, Place{x, subject.top}, Place{subject.left, y}, Place{subject.right, y}}) {
      const Vector ray = {place.x - eye_[0], place.y - eye_[1], -eye_[2]};
      const double depth = dot(ray, ahead_);
      if (depth <= 0 || std::hypot(dot(ray, right_), dot(ray, down_)) > 1.2 * depth) return HUGE_VAL;
      const Place pixel = pixel_of(place);
      most = std::max({most, std::abs(2 * pixel.x / width_ - 1), std::abs(2 * pixel.y / height_ - 1)});
    }
  }
  return most;
}

Place Pinhole::pixel_of(const Place& place) const {
  const Vector ray = {place.x - eye_[0], place.y - eye_[1], -eye_[2]};
  const double depth = dot(ray, ahead_);
  const double u = dot(ray, right_) / depth, v = dot(ray, down_) / depth;
  const double r2 = u * u + v * v, stretch = 1 + k1_ * r2 + k2_ * r2 * r2;
  return {width_ / 2 + focal_ * u * stretch, height_ / 2 + focal_ * v * stretch};
}

Place Pinhole::place_of(const Place& pixel) const {
  const double u = (pixel.x - width_ / 2) / focal_, v = (pixel.y - height_ / 2) / focal_;
  const double distorted = std::hypot(u, v);
  double r = distorted;
  for (int i = 0; i < 8; ++i) {
    const double r2 = r * r;
    r -= (r * (1 + k1_ * r2 + k2_ * r2 * r2) - distorted) / (1 + 3 * k1_ * r2 + 5 * k2_ * r2 * r2);
  }
  const double back = distorted > 0 ? r / distorted : 1;
  const Vector ray = scaled_sum(1, ahead_, 1, scaled_sum(u * back, right_, v * back, down_));
  const double length = -eye_[2] / std::min(ray[2], -1e-3);
  return {eye_[0] + length * ray[0], eye_[1] + length * ray[1]};
}

Rectangle Pinhole::visible() const {
  constexpr int samples = 32;
  Rectangle around = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (int i = 0; i <= samples; ++i) {
    const double x = width_ * i / samples, y = height_ * i / samples;
    for (const Place& pixel : {Place{x, 0}, Place{x, height_}, Place{0, y}, Place{width_, y}}) {
      const Place place = place_of(pixel);
      around.left = std::min(around.left, place.x - 1), around.right = std::max(around.right, place.x + 1);
      around.bottom = std::min(around.bottom, place.y - 1), around.top = std::max(around.top, place.y + 1);
    }
  }
  return around;
}

}  // namespace unicursal::camera
