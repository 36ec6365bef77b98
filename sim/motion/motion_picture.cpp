#include "sim/motion/motion_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>

#include "core/picture/text.hpp"

namespace unicursal::sim {

namespace {

using picture::Colour;

constexpr Colour paper{255, 255, 255}, frame{120, 120, 120}, grid{228, 228, 228}, words{70, 70, 70};
constexpr Colour strong{38, 96, 196}, pale{178, 204, 240}, alarm{214, 40, 40};
constexpr std::size_t width = 1600, strip = 220, gap = 50, left = 90, right = 20;
constexpr std::size_t dot = 2;  // pixels of a dot of the labels' font
constexpr std::size_t plot = width - left - right;

using Value = std::function<std::optional<double>(const MotionSpan&)>;

struct Curve {
  Value value;
  Colour colour;
};

/// Returns 1, 2 or 5 times a power of ten, so that a range has two to five steps.
double step_for(double range) {
  const double rough = std::pow(10, std::floor(std::log10(range / 2)));
  for (const double factor : {5.0, 2.0}) {
    if (range / (factor * rough) >= 2) return factor * rough;
  }
  return rough;
}

double greatest(const std::vector<MotionSpan>& spans, const std::vector<Curve>& curves) {
  double most = 0;
  for (const MotionSpan& span : spans) {
    for (const Curve& curve : curves) most = std::max(most, curve.value(span).value_or(0));
  }
  return most > 0 ? most * 1.05 : 1;
}

class Diagram {
 public:
  Diagram(const MotionLog& log)
      : log_(log),
        image_(width, 3 * (strip + gap) + gap, paper),
        seconds_(std::max(1.0, static_cast<double>(log.spans().size()) * log.span_seconds())) {}

  void add(const std::string& title, const std::vector<Curve>& curves, std::optional<double> most = {}) {
    top_ = gap + strips_++ * (strip + gap);
    most_ = most.value_or(greatest(log_.spans(), curves));
    picture::write(image_, left, static_cast<std::ptrdiff_t>(top_) - 20, title, dot, words);
    rule_values();
    rule_times();
    for (const Curve& curve : curves) draw(curve);
    for (const Starvation& s : log_.starvations()) {
      const double x = at_time(s.time - log_.first_bead());
      line(x, static_cast<double>(top_), x, static_cast<double>(top_ + strip), 1, alarm);
    }
  }

  const picture::Image& image() const { return image_; }

 private:
  double at_time(double seconds) const { return left + seconds / seconds_ * static_cast<double>(plot); }
  double at_value(double value) const {
    return static_cast<double>(top_ + strip) - value / most_ * static_cast<double>(strip);
  }
  void line(double x0, double y0, double x1, double y1, double thickness, Colour colour) {
    image_.stroke(x0, y0, x1, y1, thickness, colour);
  }

  void rule_values() {
    const double step = step_for(most_);
    for (int i = 0; i * step <= most_; ++i) {
      const double y = at_value(i * step);
      line(left, y, left + plot, y, 1, i == 0 ? frame : grid);
      picture::write(image_, 20, static_cast<std::ptrdiff_t>(y) - 5, fmt::format("{:g}", i * step), dot,
                     words);
    }
  }

  void rule_times() {
    const auto [unit, name] = seconds_ > 7200  ? std::pair(3600.0, "h")
                              : seconds_ > 120 ? std::pair(60.0, "min")
                                               : std::pair(1.0, "s");
    const double step = step_for(seconds_ / unit / 2) * unit;
    for (int i = 0; i * step <= seconds_; ++i) {
      const double x = at_time(i * step);
      line(x, static_cast<double>(top_), x, static_cast<double>(top_ + strip), 1, i == 0 ? frame : grid);
      picture::write(image_, static_cast<std::ptrdiff_t>(x) + 3,
                     static_cast<std::ptrdiff_t>(top_ + strip) + 6,
                     fmt::format("{:g} {}", i * step / unit, name), dot, words);
    }
  }

  /// Spans that share a pixel are drawn over one another.
  void draw(const Curve& curve) {
    std::optional<std::pair<double, double>> last;
    for (std::size_t i = 0; i < log_.spans().size(); ++i) {
      const auto value = curve.value(log_.spans()[i]);
      if (!value) {
        last.reset();
        continue;
      }
      const double x = at_time((static_cast<double>(i) + 0.5) * log_.span_seconds()), y = at_value(*value);
      const auto from = last.value_or(std::pair(x, y));
      line(from.first, from.second, x, y, 1.6, curve.colour);
      last = {x, y};
    }
  }

  const MotionLog& log_;
  picture::Image image_;
  double seconds_;
  std::size_t strips_ = 0, top_ = 0;
  double most_ = 1;
};

template <class Get>
Value while_laying(Get get) {
  return [get](const MotionSpan& span) { return span.seconds > 0 ? std::optional(get(span)) : std::nullopt; };
}

template <class Get>
Value while_observed(Get get) {
  return
      [get](const MotionSpan& span) { return span.observed > 0 ? std::optional(get(span)) : std::nullopt; };
}

}  // namespace

picture::Image draw_motion(const MotionLog& log) {
  Diagram diagram(log);
  diagram.add("speed mm/s", {{while_laying([](const MotionSpan& s) { return s.fastest; }), pale},
                             {while_laying([](const MotionSpan& s) { return s.mean_speed(); }), strong}});
  diagram.add("flow mm3/s",
              {{while_laying([](const MotionSpan& s) { return s.volume / s.seconds; }), strong}});
  diagram.add(
      "moves in the queue",
      {{while_observed([](const MotionSpan& s) { return s.mean_fill(); }), strong},
       {while_observed([](const MotionSpan& s) { return static_cast<double>(s.least_fill); }), alarm}},
      static_cast<double>(Planner::usable_blocks) + 1);
  return diagram.image();
}

}  // namespace unicursal::sim
