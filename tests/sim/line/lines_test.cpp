#include <catch2/catch.hpp>

#include "sim/line/line_assembler.hpp"
#include "sim/line/line_check.hpp"
#include "sim/line/receive_buffer.hpp"

using namespace unicursal::sim;
using Kind = LineVerdict::Kind;

namespace {

std::vector<std::string> assemble(LineAssembler& assembler, std::string_view bytes) {
  std::vector<std::string> lines;
  for (const char byte : bytes) {
    if (auto line = assembler.push(byte)) lines.push_back(*line);
  }
  return lines;
}

}  // namespace

TEST_CASE("the receive buffer holds 127 bytes, loses the rest, and marks the gap") {
  ReceiveBuffer buffer;
  for (int i = 0; i < 100; ++i) buffer.push({'a', false});
  for (int i = 0; i < 40; ++i) buffer.push({'b', false});
  CHECK(buffer.lost() == 13);
  CHECK(buffer.room() == 0);
  for (int i = 0; i < 100; ++i) CHECK(buffer.pop()->value == 'a');
  for (const char byte : {'x', 'y'}) buffer.push({byte, false});
  for (int i = 0; i < 27; ++i) {
    const auto byte = buffer.pop();
    CHECK((byte->value == 'b' && !byte->damaged));
  }
  const auto behind_gap = buffer.pop(), last = buffer.pop();
  CHECK((behind_gap->value == 'x' && behind_gap->damaged));
  CHECK((last->value == 'y' && !last->damaged));
  CHECK_FALSE(buffer.pop());
}

TEST_CASE("lines end with CR, LF or both, blank lines and comments are skipped") {
  LineAssembler assembler;
  CHECK(assemble(assembler, "G28\r\n\n   \nM105 ; heat?\r; only this\n  T1\n") ==
        std::vector<std::string>{"G28", "M105 ", "T1"});
}

TEST_CASE("a comment swallows the checksum behind it, unless a backslash precedes it") {
  LineAssembler assembler;
  CHECK(assemble(assembler, "N1 G28;home*33\nM117 a\\;b\n") ==
        std::vector<std::string>{"N1 G28", "M117 a;b"});
}

TEST_CASE("95 characters of a long line are kept") {
  LineAssembler assembler;
  const std::string fits = "M117 " + std::string(90, 'x');
  CHECK(assemble(assembler, fits + "\n") == std::vector<std::string>{fits});
  CHECK(assembler.too_long() == 0);
  CHECK(assemble(assembler, fits + "yyy*12\nT0\n") == std::vector<std::string>{fits, "T0"});
  CHECK(assembler.too_long() == 1);
}

TEST_CASE("checksums are the exclusive or of all bytes") {
  CHECK(checksum("") == 0);
  CHECK(checksum("N3 T0") == ('N' ^ '3' ^ ' ' ^ 'T' ^ '0'));  // a well-known example: 57
  CHECK(checksum("N3 T0") == 57);
}

TEST_CASE("numbered lines must follow one another") {
  LineCheck check;
  CHECK(check.check("N1 G28*18").kind == Kind::accepted);
  CHECK(check.check("N2 G1 X5*96").body == "");  // a wrong checksum: nothing is passed on
  CHECK(check.last() == 1);
  const auto good = check.check("N2 G1 X5*" + std::to_string(checksum("N2 G1 X5")));
  CHECK(good.kind == Kind::accepted);
  CHECK(good.body == "G1 X5");
  CHECK(good.number == 2);
  CHECK(check.check("N2 G1 X5*0").kind == Kind::repeated);  // its checksum is not checked
  CHECK(check.check("N1 G28*0").kind == Kind::repeated);
  CHECK(check.check("N4 G28*0").kind == Kind::wrong_number);
  CHECK(check.check("N0 G28*0").kind == Kind::wrong_number);
  CHECK(check.check("N3 G28").kind == Kind::no_checksum);
  CHECK(check.last() == 2);
}

TEST_CASE("M110 sets the line number, by its own N or the line's") {
  LineCheck check;
  const std::string own = "N0 M110 N40";
  CHECK(check.check(own + "*" + std::to_string(checksum(own))).kind == Kind::accepted);
  CHECK(check.last() == 40);
  const std::string line = "N7 M110";
  CHECK(check.check(line + "*" + std::to_string(checksum(line))).kind == Kind::accepted);
  CHECK(check.last() == 7);
  CHECK(check.check("N9 M110 N9*0").kind == Kind::wrong_checksum);
  CHECK(check.last() == 7);
}

TEST_CASE("a line without a number needs no checksum") {
  LineCheck check;
  const auto verdict = check.check("M105");
  CHECK(verdict.kind == Kind::accepted);
  CHECK(verdict.body == "M105");
  CHECK_FALSE(verdict.number);
}
