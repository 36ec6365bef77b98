#include "host/engine/slow_computer.hpp"

#include <catch2/catch.hpp>

using unicursal::host::SlowComputer;

TEST_CASE("planning that is charged nothing is there when it is asked for") {
  SlowComputer computer(0, 2, 4);
  CHECK(computer.ready(100, 0) == 0);
  CHECK(computer.ready(100, 7) == 7);
}

TEST_CASE("layers are planned one after the other, ahead of those that ask for them") {
  SlowComputer computer(3, 2, 4);  // 10 s of processor time are 15 s
  CHECK(computer.ready(10, 0) == 15);
  CHECK(computer.ready(10, 20) == 30);
  CHECK(computer.ready(10, 100) == 100);  // it was there at 45
}

TEST_CASE("a layer is not begun before the look-ahead has room for it") {
  SlowComputer computer(1, 1, 2);
  CHECK(computer.ready(1, 0) == 1);
  CHECK(computer.ready(1, 50) == 50);
  CHECK(computer.ready(1, 50) == 50);   // begun when the first one was taken, at 1
  CHECK(computer.ready(10, 50) == 60);  // begun when the second one was taken, at 50
}
