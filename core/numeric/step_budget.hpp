// How many steps the optimisers may take. core knows no clock: between two steps it asks the caller whether
// to stop, and records how many steps each stage took. The same numbers of steps give the same bytes again,
// on any number of threads.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace unicursal::core {

/// Asked before every step of a stage; false ends the stage. Empty means always true.
using MayContinue = std::function<bool()>;

class StepBudget {
 public:
  /// `enough` is asked between steps: true ends the stage; it may be empty. With a recorded effort it is not
  /// asked: every stage takes as many steps as recorded.
  explicit StepBudget(std::function<bool()> enough = {}, const std::vector<int>* recorded = nullptr)
      : enough_(std::move(enough)), recorded_(recorded) {}

  /// Begins the next stage. The result refers to this object and is valid until the next stage begins. The
  /// first `kept` steps are always granted, even after the budget is spent, so that the final stage can
  /// finish.
  MayContinue stage(int kept = 0) {
    spent_.push_back(0);
    return [this, kept] { return may_continue(kept); };
  }

  const std::vector<int>& spent() const { return spent_; }

 private:
  bool may_continue(int kept) {
    const std::size_t stage = spent_.size() - 1;
    if (recorded_ != nullptr) {
      if (stage >= recorded_->size() || spent_[stage] >= (*recorded_)[stage]) return false;
    } else if (spent_[stage] >= kept && enough_ && enough_()) {
      return false;
    }
    ++spent_[stage];
    return true;
  }

  std::function<bool()> enough_;
  const std::vector<int>* recorded_;
  /// Steps per stage, in the order in which the stages ran.
  std::vector<int> spent_;
};

}  // namespace unicursal::core
