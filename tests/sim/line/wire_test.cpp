#include "sim/line/wire.hpp"

#include <catch2/catch.hpp>

using namespace unicursal::sim;

namespace {

std::vector<WireByte> intact(std::string_view text) {
  std::vector<WireByte> bytes;
  for (const char byte : text) bytes.push_back({byte, false});
  return bytes;
}

std::string text_of(const std::vector<WireByte>& bytes) {
  std::string text;
  for (const WireByte& byte : bytes) text += byte.value;
  return text;
}

}  // namespace

TEST_CASE("a byte takes ten bits, and bytes queue behind each other") {
  Wire wire({1000, Usb::none});  // 10 ms a byte
  wire.write(1, intact("ab\nc"));
  CHECK(*wire.next_arrival() == Approx(1.03));
  CHECK(wire.arrive(1.0099).empty());
  CHECK(text_of(wire.arrive(1.0301)) == "ab\n");
  CHECK(*wire.next_arrival() == Approx(1.04));
  wire.write(1.035, intact("d"));
  CHECK(*wire.next_arrival() == Approx(1.05));
  wire.write(9, intact("\n"));
  CHECK(*wire.next_arrival() == Approx(9.01));
}

TEST_CASE("at 250 000 baud a line of 40 bytes takes 1.6 ms: 625 lines per second") {
  Wire wire({250000, Usb::none});
  wire.write(0, intact(std::string(39, 'x') + '\n'));
  CHECK(*wire.next_arrival() == Approx(1.0 / 625));
}

TEST_CASE("the two directions are independent") {
  Wire wire({1000, Usb::none});
  wire.write(0, intact(std::string(100, 'x')));
  wire.speak(0, "ok\n");
  CHECK(*wire.next_delivery() == Approx(0.03));
}

TEST_CASE("without a chip the computer gets whole lines, or what there is when the printer pauses") {
  Wire wire({1000, Usb::none});
  wire.speak(0, "ok\nec");
  CHECK(wire.deliver(0.029, 1024).empty());
  CHECK(wire.deliver(0.031, 1024) == "ok\n");
  CHECK(*wire.next_delivery() == Approx(0.05));
  CHECK(wire.deliver(0.051, 1024) == "ec");
  CHECK_FALSE(wire.next_delivery());
}

TEST_CASE("CDC delivers at frames of 1 ms") {
  Wire wire({250000, Usb::cdc});
  wire.speak(0.00005, "ok\n");
  CHECK(*wire.next_delivery() == Approx(0.001));
  CHECK(wire.deliver(0.00099, 1024).empty());
  CHECK(wire.deliver(0.0011, 1024) == "ok\n");
}

TEST_CASE("FTDI collects for 16 ms, or until a packet is full") {
  Wire wire({250000, Usb::ftdi});
  wire.speak(0, "ok\n");
  CHECK(*wire.next_delivery() == Approx(0.016 + 0.00004));
  wire.speak(0.005, "ok\n");
  CHECK(wire.deliver(0.0161, 1024) == "ok\nok\n");
  wire.speak(1, std::string(100, 'x'));
  CHECK(*wire.next_delivery() == Approx(1 + 62 * 0.00004));
  CHECK(wire.deliver(1.003, 1024).size() == 62);
  CHECK(*wire.next_delivery() == Approx(1 + 63 * 0.00004 + 0.016));
}

TEST_CASE("a line without a baud rate takes no time") {
  Wire wire({});
  wire.write(2, intact("G28\n"));
  CHECK(*wire.next_arrival() == 2);
  CHECK(text_of(wire.arrive(2)) == "G28\n");
}

TEST_CASE("a cut cable loses the bytes in transit") {
  Wire wire({1000, Usb::cdc});
  wire.write(0, intact("G28\n"));
  wire.speak(0, "ok\n");
  wire.cut();
  CHECK_FALSE(wire.next_arrival());
  CHECK_FALSE(wire.next_delivery());
}
