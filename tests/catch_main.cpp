// The main() of every test program. The settings of the user who runs the tests do not count.
#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>
#include <cstdlib>

int main(int argc, char** argv) {
  setenv("XDG_CONFIG_HOME", "/nonexistent", 1);
  return Catch::Session().run(argc, argv);
}
