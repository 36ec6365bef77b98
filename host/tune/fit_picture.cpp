#include "host/tune/fit_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/picture/text.hpp"

namespace unicursal::host {
namespace {

using core::Vec2;
using picture::Colour;

constexpr Colour sheet_white{255, 255, 255}, grey{150, 150, 150}, point_colour{60, 60, 60},
    line_colour{0, 150, 60};
constexpr double picture_scale = 8;    ///< pixels per mm of the straightened photo
constexpr double largest_side = 2400;  ///< pixels
constexpr double graph_height = 320, graph_margin = 40;
constexpr std::size_t label_dot = 3;

/// The bed's rectangle that the straightened photo shows.
core::Box shown_box(const Strip& strip) {
  const double around = 2 * MarkSizes(strip.line_width).ring_outer;
  return {strip.round_marks[0] - Vec2(around, around), strip.round_marks[2] + Vec2(around, around)};
}

class FitPicture {
 public:
  FitPicture(const Photo& photo, const Sheet& sheet, const Strip& strip)
      : strip_(strip),
        box_(shown_box(strip)),
        scale_(std::min(picture_scale, largest_side / box_.size().maxCoeff())),
        image_(static_cast<std::size_t>(scale_ * box_.size().x()),
               static_cast<std::size_t>(scale_ * box_.size().y() + graph_height + 2 * graph_margin),
               sheet_white) {
    straighten(photo, sheet);
  }

  void mark(double share, const CurveFit& fit) {
    const double whole = gamma_quantile(fit.tanks.value, 0.95);
    const double passed = fit.dead.value + fit.mixing.value * gamma_quantile(fit.tanks.value, share) / whole;
    const auto after = std::find_if(strip_.points.begin(), strip_.points.end(),
                                    [&](const Strip::Point& point) { return point.passed >= passed; });
    if (after == strip_.points.begin() || after == strip_.points.end()) return;
    const Strip::Point &a = *(after - 1), &b = *after;
    const double part = (passed - a.passed) / (b.passed - a.passed);
    const Vec2 place = a.place + part * (b.place - a.place), along = (b.place - a.place).normalized();
    const Vec2 across(-along.y(), along.x());
    const double reach = 3.5 * strip_.line_width;
    const Vec2 from = at(place - reach * across), to = at(place + reach * across);
    image_.stroke(from.x(), from.y(), to.x(), to.y(), 3, line_colour);
    const std::string text = fmt::format("{:.0f}%", 100 * share);
    picture::write(image_, std::lround(to.x()) + 4, std::lround(to.y()) - 16, text, label_dot, line_colour);
  }

  void graph(const StripCurve& curve, const CurveFit& fit) {
    most_ = std::min(strip_.volume(), 2 * (fit.dead.value + fit.mixing.value) + 1);
    const Vec2 origin = in_graph(0, 0), end = in_graph(most_, 0), top = in_graph(0, 1);
    image_.stroke(origin.x(), origin.y(), end.x(), end.y(), 1.5, grey);
    image_.stroke(origin.x(), origin.y(), top.x(), top.y(), 1.5, grey);
    const double spacing = most_ > 20 ? 10 : most_ > 6 ? 2 : 1;
    for (double volume = 0; volume <= most_; volume += spacing) {
      const Vec2 foot = in_graph(volume, 0);
      image_.stroke(foot.x(), foot.y(), foot.x(), foot.y() + 6, 1.5, grey);
      picture::write(image_, std::lround(foot.x()) - 6, std::lround(foot.y()) + 10,
                     fmt::format("{:g}", volume), label_dot, grey);
    }
    const ColourAnswer answer(curve.references);
    for (const CurvePoint& point : curve.points) {
      if (point.passed < 0 || point.passed > most_ || point.trust == 0) continue;
      const Vec2 place = in_graph(point.passed, answer.change(point.colour, point.fat));
      image_.stroke(place.x(), place.y(), place.x(), place.y(), 4, point_colour);
    }
    for (std::size_t i = 0; i + 1 < curve.points.size(); ++i) {
      const CurvePoint &from = curve.points[i], &to = curve.points[i + 1];
      if (from.passed < 0) continue;
      if (to.passed > most_) break;
      const Vec2 a = in_graph(from.passed, answer.change(fit.foretold[i], from.fat)),
                 b = in_graph(to.passed, answer.change(fit.foretold[i + 1], to.fat));
      image_.stroke(a.x(), a.y(), b.x(), b.y(), 2, line_colour);
    }
  }

  picture::Image take() { return std::move(image_); }

 private:
  Vec2 at(const Vec2& place) const {
    return {scale_ * (place.x() - box_.min.x()), scale_ * (box_.max.y() - place.y())};
  }
  Vec2 in_graph(double volume, double change) const {
    const double width = static_cast<double>(image_.width()) - 2 * graph_margin;
    const double bottom = static_cast<double>(image_.height()) - graph_margin;
    return {graph_margin + width * volume / most_, bottom - graph_height * std::clamp(change, -0.1, 1.1)};
  }

  void straighten(const Photo& photo, const Sheet& sheet) {
    const auto rows = static_cast<std::size_t>(scale_ * box_.size().y());
    for (std::size_t y = 0; y < rows; ++y) {
      for (std::size_t x = 0; x < image_.width(); ++x) {
        const Vec2 place = box_.min + Vec2((static_cast<double>(x) + 0.5) / scale_,
                                           box_.size().y() - (static_cast<double>(y) + 0.5) / scale_);
        const Vec2 pixel = sheet.view().pixel_of(place);
        if (!photo.holds(pixel)) continue;
        const auto seen = photo.between(pixel);
        const auto byte = [](double value) { return static_cast<std::uint8_t>(std::lround(255 * value)); };
        image_.set(x, y, {byte(seen[0]), byte(seen[1]), byte(seen[2])});
      }
    }
  }

  const Strip& strip_;
  const core::Box box_;
  const double scale_;
  picture::Image image_;
  double most_ = 1;  ///< mm³ at the right end of the graph
};

}  // namespace

picture::Image fit_picture(const Photo& photo, const Sheet& sheet, const Strip& strip,
                           const StripCurve& curve, const CurveFit& fit) {
  FitPicture picture(photo, sheet, strip);
  for (const double share : {perception.began, perception.half, perception.stopped}) picture.mark(share, fit);
  picture.graph(curve, fit);
  return picture.take();
}

}  // namespace unicursal::host
