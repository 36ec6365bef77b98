#include "host/link/serial_log.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <sstream>

#include "core/error.hpp"
#include "tests/host/support/temp_folder.hpp"
#include "virtual_printer.hpp"

using namespace unicursal;
using namespace unicursal::host;
using namespace std::chrono_literals;

namespace {

/// The bytes of one direction, read back from the log.
std::string unescaped(const std::string& log, char way) {
  std::string bytes;
  std::istringstream text(log);
  for (std::string line; std::getline(text, line);) {
    REQUIRE(line.size() > 16);
    if (line[14] != way) continue;
    for (std::size_t i = 16; i < line.size(); ++i) {
      if (line[i] != '\\') {
        bytes += line[i];
      } else if (line[++i] == 'x') {
        bytes += static_cast<char>(std::stoi(line.substr(i + 1, 2), nullptr, 16));
        i += 2;
      } else {
        bytes += line[i] == 'n' ? '\n' : line[i] == 'r' ? '\r' : line[i];
      }
    }
  }
  return bytes;
}

}  // namespace

TEST_CASE("a serial log holds every byte, so that it can be read back") {
  const test::TempFolder folder;
  std::string all;
  for (int c = 0; c < 256; ++c) all += static_cast<char>(c);
  {
    SerialLog log(folder / "log");
    log.add(SerialLog::Way::out, TimePoint(5s), "N1 G28*18\n");
    log.add(SerialLog::Way::in, TimePoint(5s + 1500us), all);
    log.add(SerialLog::Way::out, TimePoint(66s), "half");
  }
  const std::string text = test::read_text(folder / "log");
  CHECK(text.starts_with("     0.000000 > N1 G28*18\\n\n     0.001500 < \\x00\\x01"));
  CHECK(text.ends_with("    61.000000 > half\n"));
  CHECK(std::all_of(text.begin(), text.end(), [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); }));
  CHECK(unescaped(text, '>') == "N1 G28*18\nhalf");
  CHECK(unescaped(text, '<') == all);
}

TEST_CASE("a serial log stays within its size, and keeps the newest entries") {
  const test::TempFolder folder;
  {
    SerialLog log(folder / "log", {1000, 3, 1 << 20});
    for (int i = 0; i < 1000; ++i) log.add(SerialLog::Way::out, TimePoint(1ms * i), std::to_string(i) + "\n");
  }
  CHECK(test::read_text(folder / "log").ends_with("999\\n\n"));
  std::string all;
  for (const char* name : {"log.2", "log.1", "log"}) {
    const std::string part = test::read_text(folder / name);
    CHECK(part.size() <= 1000);
    all += part;
  }
  CHECK_FALSE(std::filesystem::exists(folder / "log.3"));
  const std::string bytes = unescaped(all, '>');
  CHECK(bytes.ends_with("997\n998\n999\n"));
  CHECK(std::count(bytes.begin(), bytes.end(), '\n') > 80);
}

TEST_CASE("a serial log that is too slow leaves entries out, and says so") {
  const test::TempFolder folder;
  std::uint64_t dropped = 0;
  const std::string big(900, 'x');
  {
    SerialLog log(folder / "log", {1 << 20, 2, 1000});
    for (int i = 0; i < 2000; ++i) log.add(SerialLog::Way::in, TimePoint(), big);
    dropped = log.dropped();
  }
  const std::string text = test::read_text(folder / "log");
  const auto kept = static_cast<std::uint64_t>(std::count(text.begin(), text.end(), 'x'));
  CHECK(kept + dropped == 2000 * 900);
  CHECK((dropped == 0 || text.find("bytes left out") != std::string::npos));
}

TEST_CASE("a log in a missing folder is refused before anything is opened") {
  CHECK_THROWS_AS(SerialLog("/no/such/folder/log"), core::DataError);
}

TEST_CASE("the link's log holds what the simulated printer received and sent") {
  const test::TempFolder folder;
  test::VirtualPrinter printer;
  LinkOptions options;
  options.log = std::make_shared<SerialLog>(folder / "log");
  const test::Talk talk = printer.print({"G28", "M114"}, options);
  options.log.reset();
  CHECK(talk.error.empty());
  const std::string text = test::read_text(folder / "log");
  CHECK(unescaped(text, '>').size() == talk.statistics.bytes);
  CHECK(unescaped(text, '>').find("N1 G28*18\n") != std::string::npos);
  CHECK(unescaped(text, '<').find("\nok\n") != std::string::npos);
  CHECK(unescaped(text, '<').starts_with("start\n"));
}
