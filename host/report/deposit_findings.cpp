#include "host/report/deposit_findings.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace unicursal::host {

void AreaHistogram::add(double value, double area) {
  constexpr double most_bins = 1e6;
  areas_[static_cast<int>(std::clamp(std::floor(value / bin_), -most_bins, most_bins))] += area;
  total_ += area;
}

AreaHistogram& AreaHistogram::operator+=(const AreaHistogram& more) {
  for (const auto& [bin, area] : more.areas_) areas_[bin] += area;
  total_ += more.total_;
  return *this;
}

double AreaHistogram::percentile(double part) const {
  double below = 0;
  for (const auto& [bin, area] : areas_) {
    if (below + area >= part * total_ && area > 0)
      return bin_ * (bin + std::clamp((part * total_ - below) / area, 0.0, 1.0));
    below += area;
  }
  // Rounding may leave the sum just below the total.
  return areas_.empty() ? 0 : bin_ * (areas_.rbegin()->first + 1);
}

double DepositFindings::fill_deviation() const {
  if (area <= 0) return 0;
  const double mean = fill_moment / area;
  return std::sqrt(std::max(0.0, fill_squares / area - mean * mean));
}

DepositFindings& DepositFindings::operator+=(const DepositFindings& more) {
  area += more.area;
  gaps += more.gaps;
  overfill += more.overfill;
  spilled += more.spilled;
  outside += more.outside;
  prime += more.prime;
  skirt += more.skirt;
  fill += more.fill;
  fill_moment += more.fill_moment;
  fill_squares += more.fill_squares;
  transition += more.transition;
  wrong += more.wrong;
  wrong_distance += more.wrong_distance;
  mixture_error += more.mixture_error;
  return *this;
}

nlohmann::json to_json(const DepositFindings& f) {
  return {{"area_mm2", f.area},
          {"gap_mm2", f.gaps},
          {"gap_fraction", f.gap_fraction()},
          {"overfill_mm2", f.overfill},
          {"overfill_fraction", f.overfill_fraction()},
          {"spilled_mm2", f.spilled},
          {"outside_mm3", f.outside},
          {"prime_mm3", f.prime},
          {"skirt_mm3", f.skirt},
          {"height",
           {{"deviation", f.fill_deviation()},
            {"p05", f.fill.percentile(0.05)},
            {"p50", f.fill.percentile(0.5)},
            {"p95", f.fill.percentile(0.95)}}},
          {"mixture",
           {{"transition_mm2", f.transition},
            {"wrong_mm2", f.wrong},
            {"wrong_fraction", f.wrong_fraction()},
            {"error_mm2", f.mixture_error},
            {"distance_from_border_mm",
             {{"p50", f.wrong_distance.percentile(0.5)},
              {"p90", f.wrong_distance.percentile(0.9)},
              {"p95", f.wrong_distance.percentile(0.95)},
              {"p99", f.wrong_distance.percentile(0.99)},
              {"greatest", f.wrong_distance.percentile(1)}}}}}};
}

}  // namespace unicursal::host
