// The whole printer with its cable, and every fault.
#include "sim/printer.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <sstream>

#include "bench.hpp"

using namespace unicursal::sim;

namespace {

/// A printer that has booted, and a host that writes and reads.
class Desk {
 public:
  explicit Desk(const std::vector<std::string>& faults = {}, std::string_view who = "marlin",
                const WireModel& wire = {250000, Usb::none}, std::uint64_t seed = 1)
      : printer(Machine{}, personality(who), wire, plan(faults, seed), moves) {
    printer.opened();
    listen(2);
    heard.clear();
  }

  /// Lets `seconds` of printer time pass.
  void listen(double seconds) {
    const double until = printer.now() + seconds;
    while (printer.now() < until && !printer.unplugged()) {
      printer.advance(until);
      heard += printer.take_output();
    }
  }
  void send(const std::string& text, double seconds = 1) {
    printer.write(text);
    listen(seconds);
  }
  void send(std::int64_t number, const std::string& command) {
    send(Bench::numbered(number, command) + "\n");
  }

  std::size_t count(const std::string& line) const {
    std::istringstream all(heard);
    std::size_t found = 0;
    for (std::string one; std::getline(all, one);) found += one == line ? 1 : 0;
    return found;
  }
  bool said(const std::string& text) const { return heard.find(text) != std::string::npos; }
  const LineCounts& lines() const { return printer.firmware().counts(); }
  std::uint64_t struck(const std::string& name) const {
    const auto found = printer.faults().counts().find(name);
    return found == printer.faults().counts().end() ? 0 : found->second;
  }

  MoveList moves;
  Printer printer;
  std::string heard;

 private:
  static FaultPlan plan(const std::vector<std::string>& faults, std::uint64_t seed) {
    FaultPlan plan;
    plan.seed = seed;
    for (const std::string& fault : faults) plan.faults.push_back(parse_fault(fault));
    return plan;
  }
};

}  // namespace

// ---- cable and boot

TEST_CASE("input while the board boots is lost") {
  MoveList moves;
  Printer printer(Machine{}, personality("marlin-8bit"), {250000, Usb::none}, {}, moves);
  printer.opened();
  printer.write("G28\n");
  printer.advance(1.4);
  CHECK_FALSE(printer.has_output());
  printer.advance(10);
  CHECK(printer.take_output() == "start\n");
  CHECK(printer.now() == Approx(1.5).margin(0.01));
  for (; printer.next_event(); printer.take_output()) printer.advance(100);
  CHECK(printer.firmware().counts().received == 0);
  CHECK(printer.firmware().counts().while_booting == 4);
}

TEST_CASE("an answer takes the time of the line in both directions, and that of the chip") {
  const auto seconds = [](const WireModel& wire) {
    Desk desk({}, "marlin", wire);
    const double before = desk.printer.now();
    desk.printer.write("G90\n");
    desk.printer.advance(100);
    CHECK(desk.printer.take_output() == "ok\n");
    return desk.printer.now() - before;
  };
  CHECK(seconds({250000, Usb::none}) == Approx(7 * 10 / 250000.0));
  CHECK(seconds({115200, Usb::none}) == Approx(7 * 10 / 115200.0));
  CHECK(seconds({250000, Usb::ftdi}) == Approx(5 * 10 / 250000.0 + 0.016));
  CHECK(seconds({250000, Usb::cdc}) <= 0.00128);
}

TEST_CASE("300 lines without waiting: most bytes are lost silently, and the next newline causes a resend") {
  Desk desk;
  std::string blast;
  for (int i = 1; i <= 300; ++i) blast += Bench::numbered(i, fmt::format("G1 X{} F600", i % 2 * 150)) + "\n";
  desk.send(blast, 600);
  CHECK(desk.printer.firmware().buffer().lost() > blast.size() / 2);
  CHECK_FALSE(desk.said("Error"));
  desk.heard.clear();
  desk.listen(3600);
  CHECK(desk.heard.empty());
  desk.send("\n");
  CHECK(desk.said("Resend: "));
}

TEST_CASE("only a board with its reset on DTR resets when DTR rises") {
  Desk eight_bit({}, "marlin-8bit"), thirty_two({}, "marlin");
  for (Desk* desk : {&eight_bit, &thirty_two}) {
    desk->printer.opened(false);
    desk->listen(3);
    CHECK_FALSE(desk->said("start"));
    desk->printer.opened(true);
    desk->listen(3);
  }
  CHECK(eight_bit.count("start") == 1);
  CHECK_FALSE(thirty_two.said("start"));
}

TEST_CASE("it does not matter in which steps time advances") {
  const auto story = [](double portion) {
    Desk desk({"bitflip:0.002", "noise:0.05"}, "marlin-advanced-ok");
    desk.printer.write("M155 S1\nM104 S50\nG28\nG1 X20 F1200\nM105\n");
    for (double until = desk.printer.now(); until < 30; until += portion) {
      while (desk.printer.now() < until) {
        desk.printer.advance(until);
        desk.heard += desk.printer.take_output();
      }
    }
    desk.listen(35 - desk.printer.now());
    return desk.heard;
  };
  CHECK(story(30) == story(0.37));
}

// ---- faults on the way to the printer

TEST_CASE("bit flips: damaged lines are requested again, and those with a matching checksum are counted") {
  Desk desk({"bitflip:0.02"});
  std::uint64_t sent = 0;
  for (std::int64_t number = 1; desk.struck("bitflip") < 3000; ++sent) {
    desk.send(Bench::numbered(number, "G1 X10 Y10") + "\n", 0.01);
    number = desk.printer.firmware().last_line() + 1;
    if (number > 100000) number = 1;
  }
  CHECK(desk.lines().checksum_errors > 500);
  CHECK(desk.lines().disguised > 0);      // an N became another letter
  CHECK(desk.lines().unseen_damage > 0);  // the same bit was flipped twice
  CHECK(desk.lines().unseen_damage < sent / 100);
}

TEST_CASE("damage that an 8-bit exclusive or cannot detect is accepted, and counted separately") {
  std::string line = Bench::numbered(1, "G1 X12 Y12") + "\n";
  std::vector<WireByte> bytes;
  for (const char byte : line) bytes.push_back({byte, false});
  for (const char axis : {'X', 'Y'}) {  // the same bit in both: X12 Y12 becomes X02 Y02
    WireByte& tens = bytes[line.find(axis) + 1];
    tens = {static_cast<char>(tens.value ^ 1), true};
  }
  MoveList moves;
  const auto firmware = make_firmware(Machine{}, personality("marlin"), moves, [](std::string_view) {});
  firmware->receive(bytes);
  CHECK(firmware->counts().accepted == 1);
  CHECK(firmware->counts().unseen_damage == 1);
  firmware->run_down();
  CHECK(moves.moves.at(0).to.x == 2);
}

TEST_CASE("lost bytes: the line no longer matches its checksum") {
  Desk desk({"lostbyte@line=1"});
  desk.send(1, "G90");
  desk.send(2, "M83");  // its first byte is lost, so that it looks like a line without a number
  CHECK(desk.struck("lostbyte") == 1);
  CHECK(desk.lines().accepted == 1);
  CHECK(desk.lines().disguised == 1);
}

TEST_CASE("merged lines: a line that lost its newline spoils the next one") {
  Desk desk({"merge@line=1"});
  desk.send(1, "G90");
  desk.send(2, "M83");
  CHECK(desk.count("ok") == 1);
  desk.send(3, "M84");
  CHECK(desk.struck("merge") == 1);
  CHECK(desk.said("Error:"));
  CHECK(desk.said("Resend: 2"));
}

TEST_CASE("false alarms: a good line is requested again") {
  Desk desk({"falsealarm@line=2"});
  desk.send(1, "G90");
  desk.send(2, "M83");
  CHECK(desk.said("Error:checksum mismatch, Last Line: 1\nResend: 2\nok\n"));
  desk.send(2, "M83");
  CHECK(desk.lines().accepted == 2);
}

TEST_CASE("a good line is refused for its correct number, or for its checksum that is there") {
  const auto [fault, reason] = GENERATE(table<std::string, std::string>({
      {"falsenumber@line=2", "Line Number is not Last Line Number+1"},
      {"falsemissing@line=2", "No Checksum with line number"},
  }));
  Desk desk({fault});
  desk.send(1, "G90");
  desk.send(2, "M83");
  CHECK(desk.said("Error:" + reason + ", Last Line: 1\nResend: 2\nok\n"));
  desk.send(2, "M83");
  CHECK(desk.count("ok") == 3);
  CHECK(desk.lines().accepted == 2);
}

TEST_CASE("rewind: a line is accepted and requested again, so that it is executed twice") {
  const std::string who = GENERATE("marlin", "repetier");
  Desk desk({"rewind@line=3"}, who);
  desk.send(1, "G91");
  desk.send(2, "G1 X1 F600");
  desk.send(3, "G1 X10");
  CHECK(desk.said(who == "marlin" ? "Last Line: 2\nResend: 3\nok\n" : "\nResend:3\nok\n"));
  desk.send(3, "G1 X10");
  desk.send(4, "M114");
  desk.listen(5);
  CHECK(desk.said("X:21.00"));
  CHECK_FALSE(desk.lines().executed_in_order);
}

// ---- faults on the way back

TEST_CASE("oks are lost, doubled, misspelt") {
  const auto [fault, oks] = GENERATE(table<std::string, std::size_t>({
      {"lostok@line=2", 2},
      {"doubleok@line=2", 4},
  }));
  Desk desk({fault});
  for (int i = 1; i <= 3; ++i) desk.send(i, "G90");
  CHECK(desk.count("ok") == oks);
}

TEST_CASE("a misspelt ok does not count as ok") {
  Desk desk({"brokenok:1"});
  for (int i = 1; i <= 40; ++i) desk.send(i, "G90");
  CHECK(desk.struck("brokenok") == 40);
  CHECK(desk.count("ok") < 20);
  CHECK(desk.lines().accepted == 40);
}

TEST_CASE("the next ok reads as the fault says") {
  Desk desk({"answer:ok 17 ready@line=2"});
  for (int i = 1; i <= 3; ++i) desk.send(i, "G90");
  CHECK(desk.heard == "ok\nok 17 ready\nok\n");
}

TEST_CASE("requests to resend are lost, or doubled") {
  const auto [fault, resends] = GENERATE(table<std::string, std::size_t>({
      {"lostresend:1", 0},
      {"doubleresend:1", 2},
  }));
  Desk desk({fault});
  desk.send("N1 G28*0\n");
  CHECK(desk.count("Resend: 1") == resends);
  CHECK(desk.count("ok") == 1);
}

TEST_CASE("noise, invalid UTF-8 and NULs come between lines, and the lines stay whole") {
  const std::string fault = GENERATE("noise:1", "badutf8:1", "nul:1");
  Desk desk({fault});
  for (int i = 1; i <= 20; ++i) desk.send(i, "G90");
  CHECK(desk.count("ok") == 20);
  CHECK(desk.heard.size() > 20 * 5);
  if (fault == "nul:1") CHECK(desk.heard.find('\0') != std::string::npos);
  if (fault == "badutf8:1") CHECK(desk.said("\xff\xfe"));
}

TEST_CASE("bytes of replies are flipped or lost") {
  Desk flipped({"replyflip:0.2"}), lost({"lostreply:0.2"});
  for (int i = 1; i <= 100; ++i) {
    flipped.send(i, "G90");
    lost.send(i, "G90");
  }
  CHECK(flipped.heard.size() == 300);
  CHECK(flipped.count("ok") < 80);
  CHECK(lost.heard.size() < 270);
  CHECK(lost.heard.size() > 210);
}

TEST_CASE("slow replies are late by up to the given time, and stay in order") {
  Desk desk({"slow:2"});
  const double before = desk.printer.now();
  for (int i = 0; i < 20; ++i) desk.printer.write("M114\n");
  desk.listen(60);
  CHECK(desk.count("ok") == 20);
  CHECK(desk.struck("slow") == 40 + 7);
  CHECK(before > 0);
}

// ---- faults of the printer itself

TEST_CASE("a stall: nothing is read or answered, but moves continue, afterwards everything is answered") {
  Desk desk({"stall:5@line=2"});
  desk.send(1, "G91");
  desk.send(Bench::numbered(2, "G1 X10 F600") + "\n", 0.01);
  desk.heard.clear();
  desk.send(3, "M114");
  desk.listen(2);
  CHECK(desk.heard.empty());
  CHECK(desk.moves.moves.size() == 1);
  desk.listen(3);
  CHECK(desk.said("X:10.00"));
}

TEST_CASE("silence: the printer never answers again") {
  Desk desk({"silence@line=2"});
  desk.send(1, "G90");
  desk.send(2, "G90");
  desk.heard.clear();
  for (int i = 3; i < 10; ++i) desk.send(i, "G90");
  desk.listen(3600);
  CHECK(desk.heard.empty());
}

TEST_CASE("a pulled cable loses the bytes in transit, while the printer continues") {
  Desk desk({"disconnect:10@line=2"});
  desk.send(1, "G91");
  desk.send(Bench::numbered(2, "G1 X10 F600") + "\n", 5);
  REQUIRE(desk.printer.unplugged());
  const double pulled = desk.printer.now();
  CHECK(desk.printer.plug_time() == Approx(pulled + 10));
  desk.printer.write("M112\n");
  desk.printer.advance(desk.printer.plug_time());
  CHECK(desk.moves.moves.size() == 1);
  CHECK_FALSE(desk.printer.has_output());
  desk.printer.plug_in();
  desk.heard.clear();
  desk.send("M114\n");
  CHECK(desk.said("X:10.00"));  // this has not reset a 32-bit board on USB
}

TEST_CASE("a reset in mid-print: it says start and has forgotten the line number") {
  Desk desk({"reset@line=2"});
  desk.send(1, "G90");
  desk.send(2, "G90");
  CHECK(desk.count("start") == 1);
  desk.heard.clear();
  desk.send(3, "G90");
  CHECK(desk.said("Last Line: 0\nResend: 1\nok\n"));
}

TEST_CASE("heaters and thermistor fail at their moment, and the firmware stops itself with the reason") {
  const auto [fault, reason] = GENERATE(table<std::string, std::string>({
      {"heaterfail@t=400", "Error:Thermal Runaway, system stopped! Heater_ID: 0"},
      {"bedfail@t=400", "Error:Thermal Runaway, system stopped! Heater_ID: bed"},
      {"runaway@t=400", "Error:MAXTEMP triggered, system stopped! Heater_ID: 0"},
      {"thermistor@t=400", "Error:MINTEMP triggered, system stopped! Heater_ID: 0"},
  }));
  Desk desk({fault});
  desk.send("M104 S210\nM140 S60\n", 390);
  CHECK_FALSE(desk.said("Error:"));
  desk.listen(200);
  CHECK(desk.count(reason) == 1);
  CHECK(desk.count("//action:poweroff") == 1);
}

TEST_CASE("filament runs out, and the printer announces it with host actions") {
  Desk desk({"runout@line=2"});
  desk.send(1, "G90");
  desk.send(2, "G90");
  CHECK(desk.count("//action:out_of_filament T0") == 1);
}

TEST_CASE("say and fatal take any text, at every command of a kind") {
  Desk desk({"say://action:pause@command=G28", "fatal:Fan stopped@t=100"});
  desk.send("G28\n", 10);
  desk.send(Bench::numbered(1, "G28 X") + "\n", 10);
  desk.send("G280\n", 10);
  CHECK(desk.count("//action:pause") == 2);
  desk.listen(100);
  CHECK(desk.said("Error:Fan stopped\nError:Printer halted. kill() called!\n"));
}

TEST_CASE("a report loses its newline, and the next ok is glued to it, never another line") {
  Desk desk({"gluedok:1"});
  desk.send("M155 S1\n", 1.5);
  CHECK(desk.count("ok") == 1);
  desk.heard.clear();
  desk.send("M400\n", 0.2);
  CHECK(desk.heard.starts_with(" T:"));
  CHECK(desk.heard.ends_with("ok\n"));
  CHECK(desk.count("ok") == 0);
  desk.heard.clear();
  desk.send("M118 hello\n", 0.01);
  desk.listen(2);
  desk.send("M118 hello\n", 0.2);
  CHECK(desk.count("hello") >= 1);
  CHECK(desk.struck("gluedok") >= 3);
}

TEST_CASE("a long command says nothing, or reports probed points, and is never busy") {
  const bool chatty = GENERATE(true, false);
  Desk desk({chatty ? "chattywork:10@command=G29" : "silentwork:10@command=G29"});
  desk.send("G29\n", 9.9);
  CHECK(desk.count("Bed X: 100.000 Y: 100.000 Z: 0.012") == (chatty ? 3 : 0));
  CHECK_FALSE(desk.said("busy"));
  CHECK_FALSE(desk.said("ok"));
  CHECK_FALSE(desk.said("Unknown"));
  desk.listen(0.3);
  CHECK(desk.count("ok") == 1);
  desk.send("G290\n", 0.2);  // another command
  CHECK(desk.said("Unknown command: \"G290\""));
  Desk homing({"silentwork:30@command=G28"});
  homing.send("G28\n", 60);
  CHECK(homing.said("X:0.00 Y:0.00 Z:0.00"));  // it does its work, too
  CHECK(homing.count("ok") == 1);
}

TEST_CASE("a board boots as slowly as it is asked to, also after a reset") {
  MoveList moves;
  FaultPlan plan;
  plan.faults = {parse_fault("slowboot:20"), parse_fault("reset@t=30")};
  Printer printer(Machine{}, personality("marlin"), {250000, Usb::none}, plan, moves);
  printer.opened();
  const auto spoken = [&](double until) {
    std::string text;
    while (printer.now() < until) {
      printer.advance(until);
      text += printer.take_output();
    }
    return text;
  };
  CHECK(spoken(19.9).empty());
  CHECK(spoken(21).starts_with("start\n"));
  CHECK(spoken(49.9).empty());
  CHECK(spoken(51).starts_with("start\n"));
}

TEST_CASE("filament that runs out while its sensor is off is not noticed, and M412 switches it on again") {
  Desk desk({"filamentchange@t=10", "filamentchange@t=100", "filamentchange@t=200"}, "marlin-host");
  const auto choose = [&](const std::string& answer) {
    desk.listen(10);
    desk.send("M876 S0\n", 10);
    CHECK(desk.said("//action:prompt_button DisableRunout"));
    desk.send(answer, 1);
    CHECK(desk.said("//action:resumed"));
    desk.heard.clear();
  };
  desk.listen(8);
  choose("M876 S1\n");
  desk.send("M412\n");
  CHECK(desk.said("echo:Filament runout OFF"));
  desk.heard.clear();
  desk.listen(120);
  CHECK_FALSE(desk.said("out_of_filament"));
  desk.send("M412 S1\n");
  CHECK_FALSE(desk.said("runout"));  // Marlin says nothing then
  desk.listen(60);
  CHECK(desk.said("//action:out_of_filament T0"));
}

TEST_CASE("the same seed gives the same faults, and an additional fault does not change the others") {
  const auto errors = [](const std::vector<std::string>& faults, std::uint64_t seed) {
    Desk desk(faults, "marlin", {250000, Usb::none}, seed);
    std::vector<std::string> heard;
    for (int i = 1; i <= 200; ++i) desk.send(fmt::format("M117 {}\n", i));
    return desk.heard;
  };
  CHECK(errors({"lostok:0.1"}, 3) == errors({"lostok:0.1"}, 3));
  CHECK(errors({"lostok:0.1"}, 3) != errors({"lostok:0.1"}, 4));
  CHECK(errors({"lostok:0.1"}, 3) == errors({"lostok:0.1", "replyflip:0"}, 3));
  // An alarm at every line keeps the next kind from striking, but its random numbers are still drawn.
  const auto forgotten = [](const std::vector<std::string>& faults) {
    Desk desk(faults);
    for (int i = 1; i <= 100; ++i) desk.send(i, "G90");
    return desk.struck("falsenumber");
  };
  CHECK(forgotten({"falsenumber:0.3"}) == forgotten({"falsenumber:0.3", "falsealarm:1"}));
}
