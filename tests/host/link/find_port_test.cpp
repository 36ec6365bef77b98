#include "host/link/find_port.hpp"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>

#include "fake_printer.hpp"
#include "host/link/line_rate.hpp"
#include "tests/host/support/temp_folder.hpp"

using namespace unicursal;
using namespace unicursal::host;
using test::FakePrinter;

namespace {

const std::vector<PortInfo> listed = {
    {"/dev/ttyUSB0", "", "a GPS mouse", true, UsbId{0x1546, 0x01a7}},
    {"/dev/ttyUSB1", "", "CH340", true, UsbId{0x1a86, 0x7523}},
    {"/dev/ttyACM0", "/dev/serial/by-id/usb-board", "board", true, UsbId{0x0483, 0x5740}},
    {"/dev/ttyS0", "", "on the mainboard", false, std::nullopt},
};

std::vector<std::string> paths(const std::vector<PortInfo>& ports) {
  std::vector<std::string> all;
  for (const PortInfo& port : ports) all.push_back(port.path);
  return all;
}

}  // namespace

TEST_CASE("a device that is plugged in again is found by the name that stays the same") {
  const test::TempFolder folder;
  folder.write("ttyUSB0", "");
  const std::filesystem::path by_id = folder / "by-id";
  std::filesystem::create_directory(by_id);
  std::filesystem::create_symlink("../ttyUSB0", by_id / "usb-1a86_USB_Serial-if00");
  std::filesystem::create_symlink("../gone", by_id / "usb-other");
  CHECK(host::stable_name_of((folder / "ttyUSB0").string(), by_id) ==
        (by_id / "usb-1a86_USB_Serial-if00").string());
  CHECK(host::stable_name_of((folder / "ttyUSB1").string(), by_id).empty());
  CHECK(host::stable_name_of((folder / "ttyUSB0").string(), folder / "none").empty());
}

TEST_CASE("a port is chosen by path, by USB numbers, or as a likely port of a printer") {
  using Paths = std::vector<std::string>;
  CHECK(paths(matching_ports(listed, "auto")) == Paths{"/dev/ttyUSB1", "/dev/ttyACM0", "/dev/ttyUSB0"});
  CHECK(paths(matching_ports({listed.back()}, "auto")) == Paths{"/dev/ttyS0"});
  CHECK(paths(matching_ports(listed, "1a86:7523")) == Paths{"/dev/ttyUSB1"});
  CHECK(paths(matching_ports(listed, "0483:5740")) == Paths{"/dev/ttyACM0"});
  CHECK(matching_ports(listed, "1A86:9999").empty());
  CHECK(paths(matching_ports(listed, "/dev/pts/7")) == Paths{"/dev/pts/7"});
  CHECK(paths(matching_ports(listed, "1a86:752x")) == Paths{"1a86:752x"});
  CHECK(matching_ports({}, "auto").empty());
}

TEST_CASE("a port without a chip is not one, and one of an unknown kind is") {
  const test::TempFolder folder;
  for (const auto& [name, type] : std::vector<std::pair<std::string, std::string>>{
           {"ttyS0", "4\n"}, {"ttyS1", "0\n"}, {"ttyS2", "nonsense\n"}, {"ttyUSB0", ""}}) {
    std::filesystem::create_directory(folder / name);
    if (!type.empty()) folder.write(name + "/type", type);
  }
  const auto known = [&](const char* port) { return has_chip(port, folder.path()); };
  CHECK(known("/dev/ttyS0"));
  CHECK_FALSE(known("/dev/ttyS1"));
  CHECK(known("/dev/ttyS2"));
  CHECK(known("/dev/ttyUSB0"));
  CHECK(known("/dev/pts/3"));
  for (const PortInfo& port : list_ports()) CHECK((port.usb || has_chip(port.path)));
}

TEST_CASE("auto asks a port that is not on USB, and one of several, before it takes it") {
  const std::vector<PortInfo> on_board{listed.back()}, on_usb{listed[1]};
  CHECK(must_answer(on_board, "auto"));
  CHECK_FALSE(must_answer(on_usb, "auto"));
  CHECK_FALSE(must_answer(on_board, "/dev/ttyS0"));
  CHECK(must_answer(matching_ports(listed, "auto"), "auto"));
}

TEST_CASE("among several ports the one that answers as a printer is chosen") {
  FakePrinter silent({.inwards = [](const std::string&) { return std::string(); }, .boots = false});
  FakePrinter printer({.boots = false});
  FakePrinter modem({.inwards = [](const std::string&) { return std::string("garbage\n"); }, .boots = false});
  const std::vector<PortInfo> ports = {{silent.path(), "", "", true, {}},
                                       {"/dev/no-such-port", "", "", true, {}},
                                       {modem.path(), "", "", true, {}},
                                       {printer.path(), "", "", true, {}}};
  const int port = open_answering_port(ports, 250000);
  const std::string path = "/proc/self/fd/" + std::to_string(port);
  CHECK(std::filesystem::read_symlink(path) == printer.path());
  // The other ports are free again.
  ::close(open_port(silent.path(), 250000));
  ::close(open_port(modem.path(), 250000));
  ::close(port);
}

TEST_CASE("if no port answers, the message names all of them") {
  FakePrinter silent({.inwards = [](const std::string&) { return std::string(); }, .boots = false});
  const std::vector<PortInfo> ports = {{silent.path(), "", "", true, {}}};
  CHECK_THROWS_WITH(open_answering_port(ports, 250000),
                    Catch::Contains(silent.path()) && Catch::Contains("250000"));
}

TEST_CASE("any baud rate reaches the driver") {
  FakePrinter printer({});
  for (const unsigned baud : {250000u, 115200u, 123456u, 500000u}) {
    const int port = open_port(printer.path(), baud);
    CHECK(line_rate(port) == baud);
    ::close(port);
  }
}
