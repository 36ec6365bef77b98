// Random input for a printer. A life depends only on its number, so it can be repeated. A violated condition
// throws an exception.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "bench.hpp"
#include "sim/printer.hpp"

namespace unicursal::sim {

struct Nothing : MoveSink {
  void moved(const ExecutedMove&) override {}
};

/// Texts that are nearly commands, with damage.
class Writer {
 public:
  explicit Writer(std::uint64_t seed) : random_(seed) {}

  std::string burst() {
    std::string text;
    for (std::uint64_t lines = pick(12) + 1; lines > 0; --lines) text += line();
    for (std::uint64_t hits = pick(4); hits > 0 && !text.empty(); --hits) damage(text);
    return text;
  }
  double seconds() { return pick(20) == 0 ? 1e4 : static_cast<double>(pick(1000)) / 100; }
  std::uint64_t pick(std::uint64_t below) { return random_() % below; }

 private:
  std::string line() {
    if (pick(50) == 0) return std::string(pick(400), static_cast<char>(pick(256)));
    std::string text = command();
    switch (pick(4)) {
      case 0:
        return text + "\n";
      case 1:
        return Bench::numbered(static_cast<std::int64_t>(random_()) >> pick(64), text) + "\r\n";
      default:
        return Bench::numbered(++number_, text) + "\n";
    }
  }
  std::string command() {
    static constexpr std::array letters{'G', 'M', 'T', 'g', 'N', ';'};
    static constexpr std::array codes{0,   1,   4,   28,  82,  83,  85,  90,  91,  92,  104, 105,
                                      106, 108, 109, 110, 112, 114, 115, 140, 155, 163, 164, 165,
                                      190, 201, 203, 204, 205, 220, 221, 400, 410, 999};
    std::string text(1, letters[pick(10) == 0 ? pick(letters.size()) : pick(2)]);
    text += std::to_string(pick(20) == 0 ? random_() : static_cast<std::uint64_t>(codes[pick(codes.size())]));
    for (std::uint64_t words = pick(6); words > 0; --words) text += word();
    return text;
  }
  std::string word() {
    static constexpr std::string_view letters = "XYZEFSPTNABCRDHI";
    std::string text{' ', letters[pick(letters.size())]};
    switch (pick(6)) {
      case 0:
        return text;
      case 1:
        return text + std::to_string(static_cast<std::int64_t>(random_()) >> pick(64));
      case 2:
        return text + "-." + std::to_string(pick(100));
      default:
        return text + fmt::format("{:.3f}", static_cast<double>(pick(200000)) / 1000 - 50);
    }
  }
  void damage(std::string& text) {
    const std::size_t at = pick(text.size());
    switch (pick(4)) {
      case 0:
        text[at] = static_cast<char>(pick(256));
        break;
      case 1:
        text.erase(at, pick(20));
        break;
      case 2:
        text.insert(at, text.substr(pick(text.size()), pick(40)));
        break;
      default:
        text.insert(at, std::string(pick(3), "\n\0\xff"[pick(3)]));
    }
  }

  std::mt19937_64 random_;
  std::int64_t number_ = 0;
};

inline FaultPlan every_fault(Writer& writer) {
  FaultPlan plan;
  plan.seed = writer.pick(1000);
  for (int i = 0; i <= static_cast<int>(FaultKind::fatal); ++i) {
    if (writer.pick(3) != 0) continue;
    Fault fault;
    fault.kind = static_cast<FaultKind>(i);
    fault.chance = static_cast<double>(writer.pick(100)) / 2000;
    fault.seconds = static_cast<double>(writer.pick(20));
    fault.text = "fuzz";
    if (fault.kind > FaultKind::slow) fault.time = static_cast<double>(writer.pick(5000));
    plan.faults.push_back(fault);
  }
  return plan;
}

inline void demand(bool held, const char* what) {
  if (!held) throw std::runtime_error(what);
}

/// Checks that the printer has survived: all its numbers are finite.
inline void demand_sound(const Firmware& firmware) {
  const Coordinates& at = firmware.coordinates();
  demand(firmware.planner().queued() <= Planner::usable_blocks, "more moves are queued than there is room");
  demand(std::isfinite(firmware.now()), "time is not a number");
  demand(std::isfinite(firmware.nozzle().temperature(firmware.now())), "the temperature is not a number");
  for (const Axis axis : {axis_x, axis_y, axis_z}) {
    demand(std::isfinite(at.logical(axis)), "the position is not a number");
  }
  demand(std::isfinite(at.e()), "E is not a number");
  demand(firmware.counts().accepted <= firmware.counts().received, "more lines were taken than came");
}

/// One printer's life. The number of events is bounded, so that a printer that never comes to rest is found.
inline void live(std::uint64_t seed) {
  constexpr std::uint64_t most_portions = 1'000'000;
  Writer writer(seed);
  static constexpr std::array names{"marlin", "marlin-8bit", "marlin-advanced-ok", "repetier",
                                    "reprapfirmware"};
  const WireModel wire{writer.pick(2) == 0 ? 0.0 : 115200.0, static_cast<Usb>(writer.pick(3))};
  const FaultPlan faults = writer.pick(3) == 0 ? every_fault(writer) : FaultPlan{};
  Nothing nothing;
  Printer printer(Machine{}, personality(names[writer.pick(names.size())]), wire, faults, nothing);
  printer.opened();
  for (int burst = 0; burst < 60; ++burst) {
    printer.write(writer.burst());
    const double until = printer.now() + writer.seconds();
    for (std::uint64_t portions = 0; printer.now() < until; ++portions) {
      printer.advance(until);
      if (printer.unplugged()) printer.plug_in();
      demand(portions < most_portions, "time does not get on");
      printer.take_output();
    }
    if (writer.pick(30) == 0) printer.opened();
    demand_sound(printer.firmware());
  }
  printer.run_down();
  demand_sound(printer.firmware());
}

}  // namespace unicursal::sim
