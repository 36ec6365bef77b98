// The printer's own display.
#include <catch2/catch.hpp>

#include "../bench.hpp"

using namespace unicursal::sim;
using Replies = Bench::Replies;

TEST_CASE("M117 shows the rest of the line, up to an asterisk, as long as the firmware keeps it") {
  const std::string twenty = "12345678901234567890";
  const auto [who, length] =
      GENERATE(table<std::string, std::size_t>({{"marlin", 63}, {"repetier", 20}, {"reprapfirmware", 80}}));
  CAPTURE(who);
  Bench bench(who);
  bench.send(1, "M117  Layer 3/9 13:42 ");
  CHECK(bench.firmware.screen().text == "Layer 3/9 13:42");
  bench.send("M117 stars * are the end");
  CHECK(bench.firmware.screen().text == "stars");
  bench.send(who == "repetier" ? "M117 semicolon (and brackets)" : "M117 semicolon ; is the end");
  CHECK(bench.firmware.screen().text == "semicolon");
  bench.send("M117 " + twenty + twenty + twenty + twenty);
  CHECK(bench.firmware.screen().text.size() == length);
  bench.send("M117");
  CHECK(bench.firmware.screen().text.empty());
  CHECK(bench.firmware.screen().texts == 5);
  bench.firmware.reset();
  CHECK(bench.firmware.screen().texts == 0);
}

TEST_CASE("A character of several bytes is not cut, and quotes of RepRapFirmware are not shown") {
  Bench marlin;
  marlin.send("M117 " + std::string(62, 'a') + "ß");
  CHECK(marlin.firmware.screen().text == std::string(62, 'a'));
  marlin.send("M117 \"a\"");
  CHECK(marlin.firmware.screen().text == "\"a\"");
  Bench reprap("reprapfirmware");
  reprap.send("M117 \"G1 says \"\"M2\"\"\" rest");
  CHECK(reprap.firmware.screen().text == "G1 says \"M2\"");
}

TEST_CASE("A Marlin that prompts through the host sends back what it shows") {
  Bench bench("marlin-host");
  CHECK(bench.send("M117 hello") == Replies{"//action:notification hello", "ok"});
  CHECK(Bench().send("M117 hello") == Replies{"ok"});
}

TEST_CASE("M73 exists where M115 lists BUILD_PERCENT") {
  Bench bench("marlin-host");
  bench.send("M115");
  CHECK(std::count(bench.replies.begin(), bench.replies.end(), "Cap:BUILD_PERCENT:1") == 1);
  CHECK(bench.send("M73 P42.9 R17") == Replies{"ok"});
  CHECK(bench.firmware.screen().percent == 42);
  CHECK(bench.firmware.screen().minutes_left == 17);
  bench.send("M73 P300");
  CHECK(bench.firmware.screen().percent == 100);
  CHECK(bench.firmware.screen().minutes_left == 17);
  Bench stock;
  stock.send("M115");
  CHECK(std::count(stock.replies.begin(), stock.replies.end(), "Cap:BUILD_PERCENT:0") == 1);
  CHECK(stock.send("M73 P1") == Replies{"echo:Unknown command: \"M73 P1\"", "ok"});
  CHECK_FALSE(stock.firmware.screen().percent);
}

TEST_CASE("Repetier does not know M73, and RepRapFirmware takes the minutes only") {
  Bench repetier("repetier");
  repetier.send(1, "M73 P1 R2");
  CHECK(repetier.replies == Replies{"ok 1", "Unknown command:N1 M73 P1 R2 "});
  Bench reprap("reprapfirmware");
  CHECK(reprap.send("M73 P1 R2") == Replies{"ok"});
  CHECK_FALSE(reprap.firmware.screen().percent);
  CHECK(reprap.firmware.screen().minutes_left == 2);
}

TEST_CASE("A Marlin without a report of its capabilities lists none") {
  Bench bench("marlin-plain");
  CHECK(bench.send("M115").size() == 2);
  CHECK(bench.send("M155 S1").front().find("Unknown command") != std::string::npos);
}
