// What a simulation came to, as JSON: lines, time, filament by feeder and by mixture, the deposit by layer.
// Facts only; what the job wanted is not known here. mm, mm³, °C, printer seconds.
#pragma once

#include <string>

#include "sim/bed/deposit.hpp"
#include "sim/firmware/firmware.hpp"
#include "sim/nozzle/feed_log.hpp"

namespace unicursal::sim {

std::string report_json(const Machine& machine, const Firmware& firmware, const FeedLog& feed,
                        const Deposit& deposit);

}  // namespace unicursal::sim
