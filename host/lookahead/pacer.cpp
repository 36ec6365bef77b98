#include "host/lookahead/pacer.hpp"

#include <algorithm>

namespace unicursal::host {
namespace {

constexpr double enough_ahead = 30;       ///< look-ahead that need not grow any more, s
constexpr double spent_of_surplus = 0.5;  ///< share of the look-ahead beyond that which may be spent
constexpr double caution = 1.3;           ///< factor on the longest tail so far
constexpr double least_cells = 1;         ///< islands with fewer cells say nothing about the time per cell
constexpr double memory = 0.8;            ///< weight of earlier islands in the mean of full steps

}  // namespace

double Pacer::allowance(double slack, double print, double share) const {
  if (slack == no_hurry) return no_hurry;
  const double ahead = std::max(slack, 0.0);
  const double sustained = print * std::min(1.0, ahead / enough_ahead);
  const double surplus = spent_of_surplus * std::max(0.0, ahead - enough_ahead);
  return std::min(ahead, threads_ * share * (sustained + surplus));
}

void Pacer::learn_tail(double cells, double seconds) {
  if (cells < least_cells || rate_ <= 0) return;
  tail_per_cell_ = std::max(tail_per_cell_, caution * seconds / (rate_ * cells));
}

double Pacer::part_of_full(double steps) const {
  return full_steps_ > 0 ? std::min(1.0, steps / full_steps_) : 1;
}

void Pacer::learn_full(double steps) {
  full_steps_ = full_known_ ? memory * full_steps_ + (1 - memory) * steps : steps;
  full_known_ = true;
}

}  // namespace unicursal::host
