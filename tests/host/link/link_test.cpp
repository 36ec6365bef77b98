#include "host/link/link.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <asio/co_spawn.hpp>
#include <asio/io_context.hpp>
#include <catch2/catch.hpp>
#include <chrono>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <thread>

#include "fake_printer.hpp"

using namespace unicursal;
using namespace unicursal::host;
using namespace std::chrono_literals;
using test::FakeBehaviour;
using test::FakePrinter;

namespace {

LinkOptions impatient() {
  LinkOptions options;
  options.boot = 50ms;
  options.silence = 150ms;
  options.no_ok = 3000ms;
  options.quiet = 5ms;
  return options;
}

std::vector<std::string> moves(std::size_t count) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < count; ++i) {
    lines.push_back(fmt::format("G1 X{:.3f} Y{} E.0123", 0.001 * static_cast<double>(i), i % 200));
  }
  return lines;
}

struct Delivery {
  std::string error;  ///< Message of a LinkError; empty after success.
  LinkStatistics statistics;
  std::string firmware;
  std::vector<std::string> messages;
};

/// Connects, sends and drains on a loop of its own.
Delivery stream(const std::string& path, std::vector<std::string> lines, LinkOptions options = impatient(),
                const std::function<void(Link&, const std::string&)>& on_message = {}) {
  asio::io_context loop;
  Delivery outcome;
  const auto talk = [&]() -> asio::awaitable<void> {
    Link link(loop.get_executor(), open_port(path, 250000), options);
    link.on_message([&](const std::string& message) {
      outcome.messages.push_back(message);
      if (on_message) on_message(link, message);
    });
    try {
      co_await link.connect();
      co_await link.send(lines);
      co_await link.drain();
    } catch (const LinkError& error) {
      outcome.error = error.what();
    }
    outcome.statistics = link.statistics();
    outcome.firmware = link.firmware();
  };
  std::exception_ptr other;
  asio::co_spawn(loop, talk, [&](std::exception_ptr error) { other = error; });
  loop.run();
  if (other) std::rethrow_exception(other);
  return outcome;
}

/// Flips one bit of one in `rarity` lines.
std::function<std::string(std::string)> bit_flips(unsigned seed, unsigned rarity) {
  return [random = std::mt19937(seed), rarity](std::string line) mutable {
    if (random() % rarity == 0) line[random() % line.size()] ^= static_cast<char>(1 << random() % 8);
    return line;
  };
}

/// Replaces the first line that begins with `start` by another text, possibly an empty one.
std::function<std::string(std::string)> replaced(std::string start, std::string by) {
  return [start, by, done = false](std::string line) mutable {
    if (done || !line.starts_with(start)) return line;
    done = true;
    return by;
  };
}

/// Replaces every seventh plain ok.
std::function<std::string(std::string)> some_oks_replaced(std::string by) {
  return [by, n = 0](std::string line) mutable {
    if (line.starts_with("ok\n") && ++n % 7 == 6) return by;
    return line;
  };
}

}  // namespace

TEST_CASE("every line arrives once and in order, within the window") {
  for (bool advanced : {false, true}) {
    FakePrinter printer({.advanced = advanced});
    const auto lines = moves(5000);
    const Delivery outcome = stream(printer.path(), lines);
    printer.stop();
    CHECK(outcome.error.empty());
    CHECK((printer.executed() == lines));
    CHECK(printer.errors() == 0);
    CHECK(printer.longest_burst() <= 127);
    CHECK(outcome.statistics.lines == lines.size());
    CHECK(outcome.statistics.sent == lines.size());
    CHECK(outcome.statistics.acknowledged == lines.size());
    CHECK(outcome.statistics.resends == 0);
    CHECK(outcome.statistics.probes == 0);
    CHECK(outcome.firmware.starts_with("FIRMWARE_NAME:Marlin"));
  }
}

TEST_CASE("a printer that is silent at boot is asked") {
  FakePrinter printer({.boots = false});
  CHECK(stream(printer.path(), {"G28"}).error.empty());
  printer.stop();
  CHECK(printer.executed() == std::vector<std::string>{"G28"});
}

TEST_CASE("damaged, lost and merged lines are sent again") {
  const auto damage =
      GENERATE(as<std::string>{}, "N40 G1 X0.039 Y3", "\x8a", "", "F40 G1 X0.039 Y39 E.0123*7\n",
               "N40 G1 X0.0\n39 Y39 E.0123*84\n", "N40 G1 X0.039 Y39 E.9123*84\n");
  FakePrinter printer({.inwards = replaced("N40 ", damage)});
  const auto lines = moves(100);
  const Delivery outcome = stream(printer.path(), lines);
  printer.stop();
  CAPTURE(damage);
  CHECK(outcome.error.empty());
  CHECK((printer.executed() == lines));
  CHECK(outcome.statistics.resends + outcome.statistics.probes > 0);
}

TEST_CASE("the ok of another line does not stand in for that of the job's last line") {
  // Its N is damaged: the firmware reads an unknown command and says ok.
  FakePrinter printer({.inwards = replaced("N100 ", "F100 G1 X0.099 Y99 E.0123*7\n")});
  const auto lines = moves(100);
  CHECK(stream(printer.path(), lines).error.empty());
  printer.stop();
  CHECK((printer.executed() == lines));
}

TEST_CASE("lost and damaged oks do not stop the stream") {
  const auto instead = GENERATE(as<std::string>{}, "", "nk\n", "ok\x0b", "\xff\xfe\xfd\n");
  FakePrinter printer({.outwards = some_oks_replaced(instead)});
  const auto lines = moves(60);
  const Delivery outcome = stream(printer.path(), lines);
  printer.stop();
  CHECK(outcome.error.empty());
  CHECK((printer.executed() == lines));
  CHECK(outcome.statistics.acknowledged == lines.size());
}

TEST_CASE("an ok that is glued to a report counts") {
  const auto report =
      GENERATE(as<std::string>{}, "T:24.1 /0.0 B:23.9 /0.0 @:0", " T:24.1 /0.0 B:23.9 /0.0 @:0 ",
               " T:24.1 /210.0 B:23.9 /60.0 @:127 W:?", "X:1.00 Y:2.00 Z:3.00 E:0.00 Count X:80 ");
  FakePrinter printer({.outwards = some_oks_replaced(report + "ok\n")});
  const auto lines = moves(60);
  auto options = impatient();
  options.silence = 20000ms;  // without those oks, the test would take minutes
  const auto begun = std::chrono::steady_clock::now();
  const Delivery outcome = stream(printer.path(), lines, options);
  printer.stop();
  CAPTURE(report);
  CHECK(outcome.error.empty());
  CHECK((printer.executed() == lines));
  CHECK(outcome.statistics.probes == 0);
  CHECK(std::chrono::steady_clock::now() - begun < 15s);
}

TEST_CASE("a temperature that is not a number answers a question for it") {
  std::size_t probed = 0;
  // Without its last ok, the link asks with an M105 whether the printer has finished.
  FakePrinter printer({.outwards = [&, n = 0](std::string line) mutable -> std::string {
    if (line.starts_with("ok T:")) return ++probed, "ok T:nan /0.00 B:nan /0.00 @:0 B@:0\n";
    return line == "ok\n" && ++n == 32 ? "" : line;
  }});
  const auto lines = moves(30);
  const Delivery outcome = stream(printer.path(), lines);
  printer.stop();
  CHECK(outcome.error.empty());
  CHECK((printer.executed() == lines));
  CHECK(probed >= 1);
  CHECK(outcome.statistics.probes == 1);
}

TEST_CASE("a board may take several times the deadline of silence to boot, with or without a word") {
  const auto word = GENERATE(as<std::string>{}, "", "echo: probe self-test");
  const auto awake = std::chrono::steady_clock::now() + 1500ms;
  auto options = impatient();
  options.silence = 500ms;
  FakePrinter printer(
      {.inwards =
           [&](std::string line) { return std::chrono::steady_clock::now() < awake ? std::string() : line; },
       .on_tick =
           [&](FakePrinter& p) {
             if (!word.empty() && std::chrono::steady_clock::now() < awake) p.reply(word);
           },
       .boots = false});
  CHECK(stream(printer.path(), {"G28"}, options).error.empty());
  printer.stop();
  CHECK(printer.executed() == std::vector<std::string>{"G28"});
}

TEST_CASE("a resend may come twice, damaged or not at all") {
  const auto instead = GENERATE(as<std::string>{}, "Resend: 40\nok\nResend: 40\n", "Resend: 42\n",
                                "Resend: 38\n", "Resend: 4000\n", "Rese\x01\x02: 40\n", "");
  FakePrinter printer({.inwards = replaced("N40 ", "N40 G1 X0.039 Y39 E.9123*84\n"),
                       .outwards = replaced("Resend", instead)});
  const auto lines = moves(100);
  const Delivery outcome = stream(printer.path(), lines);
  printer.stop();
  CAPTURE(instead);
  CHECK(outcome.error.empty());
  CHECK((printer.executed() == lines));
}

TEST_CASE("a bit is flipped in one of 200 lines, in both directions") {
  const auto seed = GENERATE(1u, 2u, 3u);
  FakePrinter printer({.inwards = bit_flips(seed, 200), .outwards = bit_flips(seed + 100, 200)});
  const auto lines = moves(5000);
  const Delivery outcome = stream(printer.path(), lines);
  printer.stop();
  CAPTURE(seed, outcome.error);
  CHECK(outcome.error.empty());
  CHECK((printer.executed() == lines));
  CHECK(outcome.statistics.resends > 5);
  CHECK(outcome.statistics.acknowledged == lines.size());
}

TEST_CASE("long and noisy streams", "[long]") {
  const auto seed = GENERATE(range(0u, 60u));
  FakePrinter printer({.inwards = bit_flips(seed, 40 + 10 * seed),
                       .outwards = bit_flips(seed + 100, 40 + 10 * seed),
                       .advanced = seed % 2 == 1});
  const auto lines = moves(20000);
  const Delivery outcome = stream(printer.path(), lines);
  printer.stop();
  CAPTURE(seed, outcome.error);
  CHECK(outcome.error.empty());
  CHECK((printer.executed() == lines));
  CHECK(outcome.statistics.acknowledged == lines.size());
}

TEST_CASE("a kill ends the job with the printer's reason") {
  FakePrinter printer({.instead = [](FakePrinter& p, std::size_t n, const std::string&) {
    if (n != 50) return false;
    p.reply("Error:Thermal Runaway, system stopped! Heater_ID: 0");
    p.reply("Error:Printer halted. kill() called!");
    p.fall_silent();
    return true;
  }});
  const Delivery outcome = stream(printer.path(), moves(1000));
  printer.stop();
  CHECK_THAT(outcome.error, Catch::Contains("stopped itself") && Catch::Contains("Thermal Runaway"));
  CHECK(printer.executed().size() == 50);
}

TEST_CASE("after a reset in mid-print no line is sent again") {
  FakePrinter printer({.instead = [](FakePrinter& p, std::size_t n, const std::string&) {
    if (n != 200) return false;
    p.forget_numbers();
    p.reply("start");
    return true;
  }});
  const Delivery outcome = stream(printer.path(), moves(1000));
  printer.stop();
  CHECK_THAT(outcome.error, Catch::Contains("reset itself"));
  CHECK(printer.executed().size() == 200);
}

TEST_CASE("after a reset whose start was lost no line is sent again") {
  FakePrinter printer({.instead = [](FakePrinter& p, std::size_t n, const std::string&) {
    if (n == 200) p.forget_numbers();
    return n == 200;
  }});
  const Delivery outcome = stream(printer.path(), moves(1000));
  printer.stop();
  CHECK_THAT(outcome.error, Catch::Contains("reset"));
  CHECK(printer.executed().size() == 200);
}

TEST_CASE("a printer that falls silent is probed and then given up") {
  FakePrinter printer({.instead = [](FakePrinter& p, std::size_t n, const std::string&) {
    if (n == 50) p.fall_silent();
    return n == 50;
  }});
  const Delivery outcome = stream(printer.path(), moves(1000));
  CHECK_THAT(outcome.error, Catch::Contains("silent"));
  CHECK(outcome.statistics.probes >= 2);
}

TEST_CASE("a port without a printer is an error, not a hang") {
  FakePrinter printer({.inwards = [](const std::string&) { return std::string(); }, .boots = false});
  CHECK_THAT(stream(printer.path(), {"G28"}).error, Catch::Contains("does not answer"));
}

TEST_CASE("the link waits for a busy printer beyond the deadline of silence") {
  auto options = impatient();
  options.silence = 1000ms;
  bool homing = false;
  FakePrinter printer(
      {.instead = [&](FakePrinter&, std::size_t, const std::string&) { return homing = true; },
       .on_tick =
           [&, ticks = 0](FakePrinter& p) mutable {
             if (!homing || ++ticks > 8) return;
             p.reply(ticks < 8 ? "echo:busy: processing" : "ok");
           }});
  const Delivery outcome = stream(printer.path(), {"G28"}, options);
  CHECK(outcome.error.empty());
  CHECK(outcome.statistics.probes == 0);
  CHECK(std::count(outcome.messages.begin(), outcome.messages.end(), "echo:busy: processing") == 7);
}

TEST_CASE("a printer that keeps asking for lines is given up") {
  FakePrinter printer({.instead = [](FakePrinter& p, std::size_t n, const std::string&) {
    if (n < 50) return false;
    p.reply("Resend: " + std::to_string(40 + n % 5));
    p.reply("ok");
    p.forget_numbers(40 + static_cast<long>(n % 5) - 1);
    return true;
  }});
  CHECK_THAT(stream(printer.path(), moves(1000)).error, Catch::Contains("too noisy"));
}

TEST_CASE("a pulled cable is reported as such") {
  FakePrinter printer({.instead = [](FakePrinter& p, std::size_t n, const std::string&) {
    if (n == 20) p.hang_up();
    return n == 20;
  }});
  CHECK_THAT(stream(printer.path(), moves(1000)).error,
             Catch::Contains("connection to the printer was lost"));
}

TEST_CASE("an emergency stop overtakes the queue") {
  FakePrinter printer({.instead = [](FakePrinter& p, std::size_t n, const std::string&) {
    if (n == 30) p.reply("//action:pause");
    return n >= 30;  // no further ok: the queue is stuck
  }});
  const Delivery outcome =
      stream(printer.path(), moves(1000), impatient(), [](Link& link, const std::string& message) {
        if (message == "//action:pause") link.emergency_stop();
      });
  printer.stop();
  CHECK_THAT(outcome.error, Catch::Contains("emergency"));
  CHECK(printer.killed());
}

TEST_CASE("lines that would break the numbering are refused before anything is sent") {
  FakePrinter printer({});
  for (const std::string bad :
       {"", "G1 X1;comment", "G1 X1\nG1 X2", "M110 N5", "N5 G1", "G1*3", "G1 X\xc3\xa9"}) {
    CHECK_THROWS_AS(stream(printer.path(), {"G28", bad}), std::invalid_argument);
  }
  CHECK_THROWS_AS(stream(printer.path(), {std::string(81, 'G')}), std::invalid_argument);
  printer.stop();
  CHECK(printer.executed().empty());
}

TEST_CASE("hostile text is made safe before it is shown") {
  FakePrinter printer({.instead = [](FakePrinter& p, std::size_t, const std::string&) {
    p.reply("\x1b[2J" + std::string(100000, 'x') + std::string("\0\xff", 2));
    return false;
  }});
  const Delivery outcome = stream(printer.path(), moves(3));
  CHECK(outcome.error.empty());
  for (const std::string& message : outcome.messages) {
    CHECK(message.size() < 1000);
    CHECK(std::all_of(message.begin(), message.end(), [](char c) { return c >= ' ' && c <= '~'; }));
  }
}

TEST_CASE("a carriage return at the end of a line is not shown") {
  FakePrinter printer({.instead = [](FakePrinter& p, std::size_t, const std::string&) {
    p.reply("Error:the filament is tangled\r");
    return false;
  }});
  const Delivery outcome = stream(printer.path(), {"G28"});
  CHECK(std::find(outcome.messages.begin(), outcome.messages.end(), "Error:the filament is tangled") !=
        outcome.messages.end());
}

TEST_CASE("the message about a port that cannot be opened names the remedy") {
  const auto file = std::filesystem::temp_directory_path() / fmt::format("unicursal-no-port-{}", ::getpid());
  std::ofstream(file) << "text";
  CHECK_THROWS_WITH(open_port("/dev/no-such-port", 250000),
                    Catch::Contains("this port does not exist; plug the printer in"));
  CHECK_THROWS_WITH(open_port(file.string(), 250000), Catch::Contains("not a serial port"));
  std::filesystem::remove(file);
}

TEST_CASE("listing ports does not fail if there are none") {
  for (const PortInfo& port : list_ports()) CHECK(port.path.starts_with("/dev/"));
}

TEST_CASE("when a printer is given up in mid-print, its heaters are switched off and the user is warned") {
  // It finishes no more commands, but reads and reports that it is busy.
  std::string heard;
  bool stuck = false;
  auto options = impatient();
  options.silence = 5000ms;
  options.no_ok = 1000ms;
  FakePrinter printer(
      {.inwards =
           [&](std::string line) {
             heard += line;
             return line;
           },
       .instead = [&](FakePrinter&, std::size_t n, const std::string&) { return stuck = n >= 20; },
       .on_tick =
           [&](FakePrinter& p) {
             if (stuck) p.reply("echo:busy: processing");
           }});
  const Delivery outcome = stream(printer.path(), moves(1000), options);
  printer.stop();
  CHECK_THAT(outcome.error, Catch::Contains("heaters may still be on"));
  CHECK_THAT(heard, Catch::EndsWith("\nM108\nM104 S0\nM140 S0\n"));
}

TEST_CASE("heating may take longer than any other command") {
  auto options = impatient();
  options.silence = options.no_ok = 1000ms;
  options.slow_ok = 60000ms;
  bool heating = false;
  FakePrinter printer(
      {.instead = [&](FakePrinter&, std::size_t, const std::string&) { return heating = true; },
       .on_tick =
           [&, ticks = 0](FakePrinter& p) mutable {
             if (!heating || ++ticks > 12) return;
             p.reply(ticks < 12 ? " T:24.1 /210.0 B:23.9 /60.0 @:127 W:?" : "ok");
           }});
  CHECK(stream(printer.path(), {"M109 S210"}, options).error.empty());
}

TEST_CASE("a slow command may be silent, or say anything, for many times the deadline of silence") {
  const auto slow =
      GENERATE(as<std::string>{}, "M190 S60", "G29", "G34", "M48 P10", "M303 E0 S200 C8", "M600", "G28X");
  const auto chatter = GENERATE(as<std::string>{}, "", "Bed X: 10.000 Y: 20.000 Z: 0.123",
                                "T:24.10 E:0 B:40.1", "Mean: 0.01 Min: 0.0 Max: 0.02 Range: 0.02");
  FakePrinter printer({.instead = [&](FakePrinter& p, std::size_t, const std::string& command) {
    for (int i = 0; command == slow && i < 12; ++i) {
      std::this_thread::sleep_for(100ms);
      if (!chatter.empty()) p.say(chatter);
    }
    return false;
  }});
  auto lines = moves(30);
  lines.insert(lines.begin() + 10, slow);
  auto options = impatient();
  options.silence = 100ms;
  const Delivery outcome = stream(printer.path(), lines, options);
  printer.stop();
  CAPTURE(slow, chatter);
  CHECK(outcome.error.empty());
  CHECK((printer.executed() == lines));
}

TEST_CASE("a printer that is dead is given up even during a slow command") {
  FakePrinter printer({.instead = [](FakePrinter& p, std::size_t n, const std::string&) {
    if (n == 5) p.fall_silent();
    return n >= 5;
  }});
  auto lines = moves(30);
  lines[4] = "G28";
  auto options = impatient();
  options.no_ok = 1000ms;
  CHECK_THAT(stream(printer.path(), lines, options).error, Catch::Contains("silent"));
}

TEST_CASE("a cool-down ends every wait for heat, and lines without a number are not sent") {
  // M190 and M109 wait until M108 arrives, as if the target were never reached.
  std::string heard;
  std::size_t waits = 0;
  FakePrinter printer({.inwards =
                           [&](std::string line) {
                             heard += line;
                             return line;
                           },
                       .instead =
                           [&](FakePrinter& p, std::size_t, const std::string& command) {
                             if (command[0] != 'M' || command == "M84") return false;
                             ++waits;
                             p.reply(" T:24.1 /210.0 B:23.9 /60.0 @:127 W:?");
                             return true;
                           },
                       .on_tick =
                           [&](FakePrinter& p) {
                             if (waits > 0 && heard.find("M108\n") != std::string::npos) {
                               heard.clear();
                               --waits;
                               p.reply("ok");
                               if (waits > 0) p.reply(" T:24.1 /210.0 B:23.9 /60.0 @:127 W:?");
                             }
                           }});
  std::vector<std::string> lines = {"M190 S60", "M109 S210"};
  for (const std::string& line : moves(100)) lines.push_back(line);
  bool cooled = false;
  auto options = impatient();
  options.silence = 2000ms;
  const Delivery outcome =
      stream(printer.path(), lines, options, [&](Link& link, const std::string& message) {
        if (!std::exchange(cooled, message.find("W:") != std::string::npos || cooled)) {
          if (cooled) link.cool_down();
        }
      });
  printer.stop();
  CHECK(outcome.error.empty());
  CHECK(printer.executed().size() < 20);
  CHECK(outcome.statistics.lines < 20);
}

TEST_CASE("a port belongs to one print") {
  FakePrinter printer({});
  const int first = open_port(printer.path(), 250000);
  CHECK_THROWS_WITH(open_port(printer.path(), 250000), Catch::Contains("another program is using it"));
  ::close(first);
}
