#include "tests/fuzz/simulator.hpp"

#include <fmt/format.h>

#include <fstream>

#include "core/error.hpp"
#include "sim/host_wait.hpp"
#include "tests/fuzz/damage.hpp"
#include "tests/sim/hostile_life.hpp"

namespace unicursal::test {
namespace {

namespace fs = std::filesystem;

const std::string& kept(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
  return bytes;
}

const char* some_firmware(core::Random& random) {
  static constexpr std::array names{"marlin", "marlin-8bit", "marlin-advanced-ok", "repetier",
                                    "reprapfirmware"};
  return names[random.below(names.size())];
}

std::string sound_print(std::size_t moves) {
  std::vector<std::string> commands{
      "M110 N0",       "M85 S600",   "M104 S205",    "M109 S205",  "G28",     "G21",      "G90",
      "M83",           "M163 S0 P1", "M163 S1 P0.5", "M163 S2 P2", "M164 S3", "T3",       "M155 S2",
      "M220 S100",     "M221 S95",   "M204 P1500",   "M203 X150",  "G92 E0",  "M190 S40", "G4 P20",
      "M205 X8 J0.02", "M201 Z90",   "M92 E400",     "G91",        "G90",     "M82",      "M83"};
  for (std::size_t i = 0; i < moves; ++i) {
    commands.push_back(fmt::format("G1 X{:.3f} Y{:.3f} Z{:.2f} E{:.5f} F{}",
                                   20 + 0.7 * static_cast<double>(i), 30 + 11.5 * static_cast<double>(i % 2),
                                   0.2, 0.0421, 1200));
  }
  std::string text;
  for (std::size_t i = 0; i < commands.size(); ++i) {
    text += sim::Bench::numbered(static_cast<std::int64_t>(i), commands[i]) + "\n";
  }
  return text + "M105\nM114\nM115\n";
}

/// Lets the printer work until it is idle; so little text can only cause a limited number of events.
void work_off(sim::Printer& printer) {
  constexpr std::uint64_t most_steps = 200'000'000;
  constexpr double longest = 1e7;  // s
  printer.opened();
  for (std::uint64_t steps = 0; printer.now() < longest && (printer.busy() || steps < 10); ++steps) {
    if (!printer.advance(printer.next_event().value_or(longest), most_steps))
      throw std::runtime_error("time does not get on");
    printer.take_output();
    if (printer.unplugged()) printer.plug_in();
  }
}

}  // namespace

void printer(const fs::path& folder, core::Random& random) {
  const std::uint64_t life = random.below(1'000'000'000);
  kept(folder / "life.txt", std::to_string(life));
  sim::live(life);
}

void lines(const fs::path& folder, core::Random& random) {
  std::string text = sound_print(5 + random.below(40));
  for (std::uint64_t n = random.below(6); n > 0; --n) text = damaged(text, random);
  kept(folder / "lines.gcode", text);
  sim::Nothing nothing;
  const auto firmware = sim::make_firmware(sim::Machine{}, sim::personality(some_firmware(random)), nothing,
                                           [](std::string_view) {});
  // In small pieces, as a real host does, so that the buffer does not overflow at once.
  for (std::size_t at = 0; at < text.size(); at += 64) {
    firmware->receive(std::string_view(text).substr(at, 64));
    for (int i = 0; i < 100 && firmware->blocked() && firmware->next_event(); ++i) {
      firmware->advance(*firmware->next_event());
    }
  }
  firmware->run_down();
  sim::demand_sound(*firmware);
}

void faults(const fs::path& folder, core::Random& random) {
  static const std::string sound =
      "# what may go wrong\nseed 7\nbitflip:1e-3\nlostbyte:0.001\nmerge@line=3\nlostok:0.05\n"
      "answer:ok 12@line=5\nslow:0.5\nstall:5@t=20\ndisconnect:3@t=30\nsay://action:pause@command=G28\n"
      "reset@line=9  # a loose plug\nrewind:0.01\nfalsenumber:0.01\nfatal:Fan stopped@t=200\n"
      "heaterfail@t=9\nnul:0.1\nreplyflip:1e-3\ndoubleresend@line=4\nrunout@t=12\n";
  const std::string script = kept(folder / "faults.txt", damaged(sound, random));
  sim::FaultPlan plan;
  try {
    plan = sim::parse_faults(script, "faults.txt");
  } catch (const std::invalid_argument& refused) {
    throw core::DataError("faults.txt", "", refused.what(), "");
  }
  sim::Nothing nothing;
  sim::Printer printer(sim::Machine{}, sim::personality(some_firmware(random)), {}, plan, nothing);
  printer.write(sound_print(5));
  work_off(printer);
  sim::demand_sound(printer.firmware());
}

void control(const fs::path& folder, core::Random& random) {
  const std::string sound = fmt::format(
      "wait {} {}", static_cast<std::int64_t>(random.below(1'000'000'000'000)) - 1, random.below(1'000'000));
  std::string message = damaged(sound, random);
  message.resize(std::min(message.find('\n'), message.size()));
  kept(folder / "control.txt", message);
  const auto wait = sim::parse_wait(message);
  if (!wait) throw core::DataError("control.txt", "", "is not a message", "");
  constexpr double countable = 1e6;  // s; beyond this a double does not resolve 1 ns
  if (std::isfinite(wait->until) && wait->until > countable) return;
  const std::string until =
      std::isfinite(wait->until) ? std::to_string(std::llround(wait->until * 1e9)) : "-1";
  const auto again = sim::parse_wait(fmt::format("wait {} {}", until, wait->bytes));
  sim::demand(again == wait, "a message does not mean what it says");
}

}  // namespace unicursal::test
