#include "firmware_gcode/review/review.hpp"

#include <utility>

namespace unicursal::gcode {

Review::Review(const Printer& printer, const Dialect& dialect) : check_(printer, dialect), time_(printer) {}

void Review::operator()(Chunk& chunk, const std::string& place) {
  TimeEstimate time = time_;
  double first = before_first_;
  bool laid = false;  // the last move was a bead
  double last = last_bead_;
  MoveListener listener;
  listener.move = [&](const PerAxis& d, double speed) {
    const bool bead = d[3] > 0 && (d[0] != 0 || d[1] != 0);
    if (bead && first < 0) first = time.seconds();
    if (!bead && std::exchange(laid, false)) last = time.seconds();
    laid = laid || bead;
    time.move(d, speed);
  };
  listener.stop = [&] { time.stop(); };
  check_.read(chunk, place, listener);
  time_ = std::move(time);
  before_first_ = first;
  const double now = time_.seconds();
  last_bead_ = laid ? now : last;
  chunk.seconds = now - std::exchange(assigned_, now);
}

double Review::laying_seconds() const {
  return before_first_ < 0 ? 0 : last_bead_ - before_first_;
}

}  // namespace unicursal::gcode
