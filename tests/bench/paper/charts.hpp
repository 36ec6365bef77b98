// Small charts as SVG, to stand in a page.
#pragma once

#include <string>
#include <vector>

namespace unicursal::bench {

struct Series {
  std::string name;
  std::string colour;
  std::vector<double> x, y;
  bool dashed = false;
};

struct ChartLabels {
  std::string title, x, y;
};

/// Lines through points. Both axes may be logarithmic; all values must then be positive.
std::string line_chart(const ChartLabels& labels, const std::vector<Series>& series,
                       bool logarithmic = false);

/// A histogram over 0 … `bin` · shares.size(), with a mark at 1.
std::string histogram(const std::vector<double>& shares, double bin, const std::string& colour);

}  // namespace unicursal::bench
