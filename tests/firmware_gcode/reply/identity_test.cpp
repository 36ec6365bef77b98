#include "firmware_gcode/reply/identity.hpp"

#include <catch2/catch.hpp>

#include "firmware_gcode/reply/reply.hpp"

using namespace unicursal::gcode;

TEST_CASE("firmwares identify themselves, each in its own way") {
  const Identity marlin = identify(
      "FIRMWARE_NAME:Marlin 2.1.2.1 (Mar 1 2023 12:30:00) SOURCE_CODE_URL:https://example.org "
      "PROTOCOL_VERSION:1.0 MACHINE_TYPE:My Diamond EXTRUDER_COUNT:1 UUID:0000-11");
  CHECK(marlin.firmware == "Marlin 2.1.2.1 (Mar 1 2023 12:30:00)");
  CHECK(marlin.family == Family::marlin);
  CHECK(marlin.version == Version{2, 1, 2});
  CHECK(marlin.machine == "My Diamond");
  CHECK(marlin.extruders == 1u);
  const Identity repetier =
      identify("FIRMWARE_NAME:Repetier_1.0.4 COMPILED:Jan MACHINE_TYPE:Mendel EXTRUDER_COUNT:3");
  CHECK(repetier.family == Family::repetier);
  CHECK(repetier.version == Version{1, 0, 4});
  CHECK(repetier.extruders == 3u);
  const Identity duet = identify(
      "FIRMWARE_NAME: RepRapFirmware for Duet 2 WiFi/Ethernet FIRMWARE_VERSION: 3.4.5 ELECTRONICS: Duet");
  CHECK(duet.family == Family::reprapfirmware);
  CHECK(duet.firmware == "RepRapFirmware for Duet 2 WiFi/Ethernet");
  CHECK(duet.version == Version{3, 4, 5});
  CHECK(duet.firmware.find("Duet 2") != std::string::npos);
  const Identity bugfix = identify("FIRMWARE_NAME:Marlin bugfix-2.1.x (Jan 1 2024)");
  CHECK(bugfix.family == Family::marlin);
  CHECK(bugfix.version == Version{2, 1, 0});
}

TEST_CASE("versions compare as numbers, not as text") {
  CHECK(Version{2, 0, 9} < Version{2, 0, 10});
  CHECK(Version{1, 1, 9} < Version{2, 0, 0});
}

TEST_CASE("capabilities are those that were announced") {
  Identity identity;
  CHECK_FALSE(identity.can("AUTOREPORT_TEMP"));
  identity.learn("AUTOREPORT_TEMP", true);
  identity.learn("EMERGENCY_PARSER", false);
  CHECK(identity.can("AUTOREPORT_TEMP"));
  CHECK_FALSE(identity.can("EMERGENCY_PARSER"));
  for (int i = 0; i < 1000; ++i) identity.learn("NOISE" + std::to_string(i), true);
  CHECK(identity.capabilities.size() == Identity::most_capabilities);

  const Reply parsed = parse_reply("Cap:AUTOREPORT_TEMP:1");
  REQUIRE(std::holds_alternative<reply::Capability>(parsed));
  CHECK(std::get<reply::Capability>(parsed).name == "AUTOREPORT_TEMP");
  CHECK(std::get<reply::Capability>(parsed).on);
  CHECK_FALSE(std::get<reply::Capability>(parse_reply("Cap:EEPROM:0")).on);
  for (const char* damaged : {"Cap:", "Cap::1", "Cap:EEPROM", "Cap:EEPROM:", "Cap:EEPROM:2", "Cap:EEPROM:1x"})
    CHECK(std::holds_alternative<reply::Unknown>(parse_reply(damaged)));
}

TEST_CASE("a senseless or endless answer does no harm") {
  for (const std::string& line :
       std::vector<std::string>{"", "FIRMWARE_NAME:", std::string(100000, 'A'), "FIRMWARE_NAME:9.",
                                "FIRMWARE_NAME:.1.99999999999.3 \xff\x1b"}) {
    const Identity identity = identify(line);
    CHECK(identity.family == Family::unknown);
    CHECK(identity.firmware.size() < 4096);
  }
}

TEST_CASE("Repetier's reply to an unknown command is understood") {
  const Reply parsed = parse_reply("Unknown command:M9999");
  REQUIRE(std::holds_alternative<reply::Echo>(parsed));
  CHECK(std::get<reply::Echo>(parsed).unknown_command);
}
