// How long the optimisers may go on. core knows no clock: whoever asks for a plan says, between two steps,
// whether it is enough, and how many steps were taken is written down. The same number of steps gives the
// same bytes again, on any number of threads.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace unicursal::core {

/// Asked before every step of a stage; false ends the stage. Empty: always true.
using MayContinue = std::function<bool()>;

class StepBudget {
 public:
  /// `enough` is asked between steps and may be empty. With a recorded effort it is not asked: stages take
  /// as many steps as they did then.
  explicit StepBudget(std::function<bool()> enough = {}, const std::vector<int>* recorded = nullptr)
      : enough_(std::move(enough)), recorded_(recorded) {}

  /// Begins the next stage. The result refers to this object and is used up before the next stage begins.
  /// The first `kept` steps are granted even when it is enough: a stage that all before it were for.
  MayContinue stage(int kept = 0) {
    spent_.push_back(0);
    return [this, kept] { return another(kept); };
  }

  const std::vector<int>& spent() const { return spent_; }

 private:
  bool another(int kept) {
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
  /// Per stage, in the order in which they ran.
  std::vector<int> spent_;
};

}  // namespace unicursal::core
