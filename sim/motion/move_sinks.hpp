// Passes everything that the machine does to several sinks, in the order of the list.
#pragma once

#include <utility>
#include <vector>

#include "sim/motion/move.hpp"

namespace unicursal::sim {

class MoveSinks : public MoveSink {
 public:
  explicit MoveSinks(std::vector<MoveSink*> sinks) : sinks_(std::move(sinks)) {}

  void moved(const ExecutedMove& move) override {
    for (MoveSink* sink : sinks_) sink->moved(move);
  }
  void starved(const Starvation& starvation) override {
    for (MoveSink* sink : sinks_) sink->starved(starvation);
  }
  void queue_changed(double time, std::size_t queued) override {
    for (MoveSink* sink : sinks_) sink->queue_changed(time, queued);
  }

 private:
  std::vector<MoveSink*> sinks_;
};

}  // namespace unicursal::sim
