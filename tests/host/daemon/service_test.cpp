// The systemd service that is installed, as a text: its protections are not to be lost.
#include <algorithm>
#include <catch2/catch.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/host/support/temp_folder.hpp"
#include "tests/paths.hpp"

using namespace unicursal;

namespace {

/// The values of a key, in order.
std::vector<std::string> values(const std::string& key) {
  std::istringstream unit(
      test::read_text((test::source_folder() / "host/packaging/unicursal.service.in").string()));
  std::vector<std::string> found;
  for (std::string line; std::getline(unit, line);) {
    if (line.starts_with(key + "=")) found.push_back(line.substr(key.size() + 1));
  }
  return found;
}

}  // namespace

TEST_CASE("the service bounds the memory and the tasks of jobs, and is killed late when memory is short") {
  REQUIRE(values("MemoryMax").size() == 1);
  CHECK(values("MemoryMax").front().ends_with('%'));
  REQUIRE(values("TasksMax").size() == 1);
  CHECK(std::stoi(values("TasksMax").front()) <= 1000);
  REQUIRE(values("OOMScoreAdjust").size() == 1);
  CHECK(std::stoi(values("OOMScoreAdjust").front()) < 0);
}

TEST_CASE("the service may use the serial ports of adapters and of small boards, and no other device") {
  CHECK(values("DevicePolicy") == std::vector<std::string>{"closed"});
  std::vector<std::string> devices = values("DeviceAllow");
  std::sort(devices.begin(), devices.end());
  CHECK(devices ==
        std::vector<std::string>{"char-ttyACM rw", "char-ttyAMA rw", "char-ttyS rw", "char-ttyUSB rw"});
}

TEST_CASE("the service has time to park and cool its printer, and starts again after a crash") {
  REQUIRE(values("TimeoutStopSec").size() == 1);
  CHECK(std::stoi(values("TimeoutStopSec").front()) >= 60);
  CHECK(values("Restart") == std::vector<std::string>{"on-failure"});
  CHECK(values("User") == std::vector<std::string>{"unicursal"});
}
