#include "tests/bench/paper/charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace unicursal::bench {
namespace {

constexpr double chart_width = 460, chart_height = 300, chart_left = 74, chart_bottom = 44, chart_top = 26;
constexpr double legend_line = 16;
constexpr int ticks = 4;
constexpr double bars_width = 220, bars_height = 90;

/// One axis: from values to pixels.
struct Axis {
  double low = 0, high = 1, from = 0, to = 1;
  bool logarithmic = false;

  double scaled(double v) const { return logarithmic ? std::log(v) : v; }
  double operator()(double v) const {
    return from + (scaled(v) - scaled(low)) / (scaled(high) - scaled(low)) * (to - from);
  }
  double tick(int k) const {
    const double t = static_cast<double>(k) / ticks;
    return logarithmic ? low * std::pow(high / low, t) : low + t * (high - low);
  }
};

Axis axis_over(const std::vector<double>& values, double from, double to, bool logarithmic) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  Axis axis{logarithmic ? *low : std::min(0.0, *low), *high, from, to, logarithmic};
  if (!(axis.high > axis.low)) axis.high = axis.low + 1;
  return axis;
}

std::string curve_of(const Series& s, const Axis& x, const Axis& y) {
  std::string points, dots;
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    points += fmt::format("{:.1f},{:.1f} ", x(s.x[i]), y(s.y[i]));
    dots += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='3' fill='{}'/>", x(s.x[i]), y(s.y[i]), s.colour);
  }
  return fmt::format("<polyline points='{}' fill='none' stroke='{}' stroke-width='2'{}/>", points, s.colour,
                     s.dashed ? " stroke-dasharray='5 4'" : "") +
         dots;
}

}  // namespace

std::string line_chart(const ChartLabels& labels, const std::vector<Series>& series, bool logarithmic) {
  std::vector<double> xs, ys;
  for (const Series& s : series) {
    xs.insert(xs.end(), s.x.begin(), s.x.end());
    ys.insert(ys.end(), s.y.begin(), s.y.end());
  }
  if (xs.empty()) return "";
  const Axis x = axis_over(xs, chart_left, chart_width - 12, logarithmic);
  const Axis y = axis_over(ys, chart_height - chart_bottom, chart_top, logarithmic);
  std::string svg =
      fmt::format("<svg width='{0}' height='{1}' viewBox='0 0 {0} {1}' role='img' aria-label='{2}'>",
                  chart_width, chart_height, labels.title);
  svg += fmt::format("<text x='{}' y='16' class='t'>{}</text>", chart_left, labels.title);
  for (int k = 0; k <= ticks; ++k) {
    const double vx = x.tick(k), vy = y.tick(k);
    svg += fmt::format("<line x1='{0}' x2='{1}' y1='{2:.1f}' y2='{2:.1f}' class='g'/>", chart_left,
                       chart_width - 12, y(vy));
    svg += fmt::format("<text x='{}' y='{:.1f}' class='n e'>{:.3g}</text>", chart_left - 6, y(vy) + 4, vy);
    svg += fmt::format("<text x='{:.1f}' y='{}' class='n m'>{:.3g}</text>", x(vx),
                       chart_height - chart_bottom + 16, vx);
  }
  for (const Series& s : series) svg += curve_of(s, x, y);
  // The names stand where falling or rising lines leave room.
  const bool falling = series.front().y.front() > series.front().y.back();
  double at = chart_top + 14;
  for (const Series& s : series) {
    svg +=
        fmt::format("<text x='{}' y='{}' class='n{}' fill='{}'>{}</text>",
                    falling ? chart_width - 20 : chart_left + 10, at, falling ? " e" : "", s.colour, s.name);
    at += legend_line;
  }
  svg += fmt::format("<text x='{}' y='{}' class='n m'>{}</text>", (chart_left + chart_width) / 2,
                     chart_height - 8, labels.x);
  svg += fmt::format("<text x='12' y='{0}' class='n m' transform='rotate(-90 12 {0})'>{1}</text></svg>",
                     chart_height / 2 - 8, labels.y);
  return svg;
}

std::string histogram(const std::vector<double>& shares, double bin, const std::string& colour) {
  const double most = std::max(1e-9, *std::max_element(shares.begin(), shares.end()));
  const double step = bars_width / static_cast<double>(shares.size());
  std::string svg = fmt::format(
      "<svg width='{0}' height='{1}' viewBox='0 0 {0} {1}' role='img' "
      "aria-label='Histogram of the spacing'>",
      bars_width, bars_height + 18);
  for (std::size_t k = 0; k < shares.size(); ++k) {
    const double height = shares[k] / most * bars_height;
    svg += fmt::format("<rect x='{:.1f}' y='{:.1f}' width='{:.1f}' height='{:.1f}' fill='{}'/>",
                       static_cast<double>(k) * step, bars_height - height, step - 0.6, height, colour);
  }
  for (double v = 0.5; v < bin * static_cast<double>(shares.size()); v += 0.5) {
    svg +=
        fmt::format("<text x='{:.1f}' y='{}' class='n m'>{:.1f}</text>", v / bin * step, bars_height + 14, v);
  }
  return svg + fmt::format("<line x1='{0:.1f}' x2='{0:.1f}' y1='0' y2='{1}' class='one'/></svg>",
                           1 / bin * step, bars_height);
}

}  // namespace unicursal::bench
