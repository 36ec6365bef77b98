#include "firmware_gcode/print/mixture.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <numeric>

#include "core/error.hpp"

namespace unicursal::gcode {
namespace {

double sum(const Shares& shares) {
  return std::accumulate(shares.begin(), shares.end(), 0.0);
}

}  // namespace

Mixture::Mixture(const Shares& shares) : shares_(shares) {
  for (double share : shares) {
    if (!(share >= 0) || !std::isfinite(share)) {
      throw core::DataError("", "mixture", "a share is negative or not a number", "give shares of 0 or more");
    }
  }
  const double total = sum(shares);
  if (!std::isfinite(total)) {
    throw core::DataError("", "mixture", "the shares are too large", "give shares such as 1 or 0.5");
  }
  if (!(total > 0)) {
    throw core::DataError("", "mixture", "all shares are zero, which would hang the firmware",
                          "give at least one feeder a share above 0");
  }
  for (double& share : shares_) share /= total;
}

Mixture Mixture::with_floor(double floor) const {
  assert(floor >= 0 && floor <= 1.0 / static_cast<double>(feeders()));
  // Shares at the floor are fixed; the others share what is left in proportion, until none falls below.
  std::array<bool, most_feeders> fixed{};
  Shares result = shares_;
  for (bool changed = true; changed;) {
    changed = false;
    double free_share = 1, free_weight = 0;
    for (std::size_t i = 0; i < feeders(); ++i) {
      if (fixed[i])
        free_share -= floor;
      else
        free_weight += shares_[i];
    }
    for (std::size_t i = 0; i < feeders(); ++i) {
      if (fixed[i]) continue;
      result[i] = shares_[i] / free_weight * free_share;
      if (result[i] < floor) result[i] = floor, fixed[i] = changed = true;
    }
  }
  return Mixture(result);
}

Mixture Mixture::quantised(int decimals) const {
  const double scale = std::pow(10, decimals);
  // Remainders nearer to each other than this are taken to be equal, so that rounding decides nothing.
  constexpr double noise = 1e-9;
  Shares units = shares_;
  for (double& share : units) share = std::floor(share * scale + noise);
  for (double left = scale - sum(units); left > 0.5; --left) {
    std::size_t most = 0;
    const auto lacks = [&](std::size_t i) { return shares_[i] * scale - units[i]; };
    for (std::size_t i = 1; i < feeders(); ++i) {
      if (lacks(i) > lacks(most) + noise) most = i;
    }
    ++units[most];
  }
  return Mixture(units);
}

std::string shares_text(const Mixture& mixture) {
  constexpr double unit = 1e4;  // finer than any firmware keeps shares: noise decides no rounding
  std::string text;
  for (const double share : mixture.shares())
    text += fmt::format("{}{:.2f}", text.empty() ? "" : " : ", std::round(share * unit) / unit);
  return text;
}

}  // namespace unicursal::gcode
