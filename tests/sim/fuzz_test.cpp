// Anything at all as input: the printer neither crashes nor hangs, and a reset always brings it back.
#include <catch2/catch.hpp>

#include <chrono>
#include <random>

#include "bench.hpp"
#include "sim/printer.hpp"

using namespace unicursal::sim;

namespace {

struct Nothing : MoveSink {
  void moved(const ExecutedMove&) override {}
};

/// Texts that are nearly commands, and damage done to them.
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

FaultPlan every_fault(Writer& writer) {
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

/// One printer's life. Time is bounded by events, so that a printer which never comes to rest shows.
void live(std::uint64_t seed) {
  Writer writer(seed);
  static constexpr std::array names{"marlin", "marlin-8bit", "marlin-advanced-ok", "repetier"};
  const WireModel wire{writer.pick(2) == 0 ? 0.0 : 115200.0, static_cast<Usb>(writer.pick(3))};
  const FaultPlan faults = writer.pick(3) == 0 ? every_fault(writer) : FaultPlan{};
  Nothing nothing;
  Printer printer(Machine{}, personality(names[writer.pick(names.size())]), wire, faults, nothing);
  printer.opened();
  for (int burst = 0; burst < 60; ++burst) {
    printer.write(writer.burst());
    const double until = printer.now() + writer.seconds();
    std::uint64_t portions = 0;
    for (; printer.now() < until; ++portions) {
      printer.advance(until);
      if (printer.unplugged()) printer.plug_in();
      if (portions > 1'000'000) FAIL("time does not get on");
      printer.take_output();
    }
    if (writer.pick(30) == 0) printer.opened();
    REQUIRE(printer.firmware().planner().queued() <= Planner::usable_blocks);
  }
  REQUIRE(std::isfinite(printer.now()));
  REQUIRE(std::isfinite(printer.firmware().nozzle().temperature(printer.now())));
}

}  // namespace

TEST_CASE("any input at all is survived") {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    INFO("seed " << seed);
    live(seed);
  }
}

TEST_CASE("any input at all is survived for ten minutes", "[long]") {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(10);
  std::uint64_t seed = std::random_device{}();
  for (; std::chrono::steady_clock::now() < end; ++seed) {
    INFO("seed " << seed);
    live(seed);
  }
}
