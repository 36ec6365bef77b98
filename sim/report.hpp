// The result of a simulation as JSON: lines, time, motion, filament by feeder and by mixture, the chamber,
// the deposit by layer. It holds facts only; the simulator does not know the job. mm, mm³, °C, printer
// seconds.
#pragma once

#include <optional>
#include <string>

#include "sim/bed/bead_pictures.hpp"
#include "sim/bed/deposit.hpp"
#include "sim/motion/motion_log.hpp"
#include "sim/nozzle/feed_log.hpp"
#include "sim/nozzle/nozzle.hpp"
#include "sim/printer.hpp"

namespace unicursal::sim {

/// Everything that recorded the moves.
struct Outcome {
  const FeedLog& feed;
  const Nozzle& nozzle;
  const Deposit& deposit;
  const MotionLog& motion;
  const Strikes& strikes;
  std::optional<PicturePlace> pictures = {};  ///< of the layers, if they are drawn
};

std::string report_json(const Machine& machine, const Printer& printer, const Outcome& outcome);

}  // namespace unicursal::sim
