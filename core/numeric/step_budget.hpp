// How many steps the optimisers may take. core knows no clock: between two steps the caller of a plan is
// asked whether the budget is spent, and the number of steps taken is recorded. The same number of steps
// gives the same bytes again, on any number of threads.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "core/stopping.hpp"

namespace unicursal::core {

/// Asked before every step of a stage; false ends the stage, Stopped (core/stopping.hpp) the whole work. An
/// empty function means always true.
using MayContinue = std::function<bool()>;

class StepBudget {
 public:
  /// `budget_spent` is asked between steps; if it is empty, stages end by themselves. If `recorded` is given,
  /// `budget_spent` is not asked: every stage takes as many steps as recorded.
  explicit StepBudget(std::function<bool()> budget_spent = {}, const std::vector<int>* recorded = nullptr)
      : budget_spent_(std::move(budget_spent)), recorded_(recorded) {}

  /// Begins the next stage. The returned function refers to this object and is valid until the stage after it
  /// begins. The first `kept` steps are always granted, even after the budget is spent, so that the final
  /// stage can finish.
  MayContinue stage(int kept = 0) {
    steps_.push_back(0);
    return [this, kept] { return may_continue(kept); };
  }

  /// The steps that each stage took, in the order in which the stages ran.
  const std::vector<int>& steps() const { return steps_; }

 private:
  bool may_continue(int kept) {
    stop_point();
    int& taken = steps_.back();
    if (recorded_ != nullptr) {
      const std::size_t stage = steps_.size() - 1;
      if (stage >= recorded_->size() || taken >= (*recorded_)[stage]) return false;
    } else if (taken >= kept && budget_spent_ && budget_spent_()) {
      return false;
    }
    ++taken;
    return true;
  }

  std::function<bool()> budget_spent_;
  const std::vector<int>* recorded_;
  std::vector<int> steps_;
};

}  // namespace unicursal::core
