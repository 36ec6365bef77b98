#include "host/link/ledger.hpp"

#include <catch2/catch.hpp>

using unicursal::host::framed;
using unicursal::host::Ledger;

namespace {

/// Lines of 20 or 21 bytes each, from number 1 to 9.
Ledger filled(std::size_t window, int lines) {
  Ledger ledger(window);
  for (int i = 1; i <= lines; ++i) {
    std::string command = "M117 aaaa";
    while (framed(static_cast<std::uint32_t>(i), command).size() < 20) command += 'a';
    ledger.push(command);
  }
  return ledger;
}

}  // namespace

TEST_CASE("an ok that reports the queue makes room for as many more lines") {
  std::string bytes;
  for (const std::uint32_t queued : {0u, 1u, 2u}) {
    Ledger ledger = filled(66, 9);
    CHECK(ledger.fill(bytes) == 3);
    REQUIRE(ledger.acknowledge_number(1, queued));  // lines 2 and 3 wait in the queue
    CHECK(ledger.fill(bytes) == 1 + queued);
    CHECK(ledger.acknowledged() == 1);
    CHECK(ledger.in_flight());
    // They are not acknowledged yet, and lines that have left the buffer are not subtracted twice.
    REQUIRE(ledger.acknowledge_number(2, queued));
    CHECK(ledger.fill(bytes) == 1);
  }
}

TEST_CASE("a queue that is reported larger than the lines in flight frees only those") {
  std::string bytes;
  Ledger ledger = filled(66, 9);
  ledger.fill(bytes);
  REQUIRE(ledger.acknowledge_number(1, 4000));
  CHECK(ledger.fill(bytes) == 3);
  ledger.rewind(2);
  CHECK(ledger.fill(bytes) == 3);
}

TEST_CASE("numbering stops at the last number, and restarts when all lines are acknowledged") {
  Ledger ledger(1000, 1, 3);
  for (int i = 0; i < 5; ++i) ledger.push("G1 X" + std::to_string(i));
  std::string bytes;
  CHECK(ledger.fill(bytes) == 3);
  CHECK_FALSE(ledger.exhausted());
  for (int i = 0; i < 3; ++i) CHECK(ledger.acknowledge());
  CHECK(ledger.exhausted());
  CHECK(ledger.fill(bytes) == 0);
  bytes.clear();
  ledger.restart();
  CHECK(ledger.fill(bytes) == 2);
  CHECK(bytes == framed(1, "G1 X3") + framed(2, "G1 X4"));
  CHECK(ledger.acknowledged() == 3);
  CHECK(ledger.numbered() == 5);
  CHECK(ledger.acknowledge());
  CHECK(ledger.acknowledge());
  CHECK(ledger.settled());
  CHECK(ledger.acknowledged() == 5);
  CHECK_FALSE(ledger.exhausted());
}
