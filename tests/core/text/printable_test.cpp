#include "core/text/printable.hpp"

#include <catch2/catch.hpp>

using namespace unicursal::core;

TEST_CASE("foreign text is cut and freed of control characters before it is shown") {
  CHECK(printable(std::string(1000, 'a')).size() == 203);
  CHECK(printable("a\x1b[2J\xff") == "a\\x1b[2J\\xff");
}
