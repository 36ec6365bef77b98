// The filament that the feeders were asked to feed, by mixture. Moves that print are counted apart from those
// that only retract, prime or purge in place. mm of filament, steps.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/motion/move.hpp"

namespace unicursal::sim {

struct MixtureUse {
  Mix mix;  ///< The factors, and the first virtual tool that had them.
  double extruded = 0;
  PerFeeder<std::int64_t> feeder_steps{};
};

class FeedLog : public MoveSink {
 public:
  void moved(const ExecutedMove& move) override;

  /// One entry for each distinct set of factors among the moves that lay a bead, in the order of first use.
  const std::vector<MixtureUse>& mixtures() const { return mixtures_; }
  double extruded() const { return extruded_; }          ///< Fed by moves that lay a bead.
  double fed_in_place() const { return fed_in_place_; }  ///< Fed forward without a bead.
  double retracted() const { return retracted_; }        ///< Fed backward, as a positive length.
  /// Steps of moves without a bead.
  const PerFeeder<std::int64_t>& idle_steps() const { return idle_steps_; }

 private:
  MixtureUse& use_of(const Mix& mix);

  std::vector<MixtureUse> mixtures_;
  double extruded_ = 0, fed_in_place_ = 0, retracted_ = 0;
  PerFeeder<std::int64_t> idle_steps_{};
};

}  // namespace unicursal::sim
