// What makes a curve the same on every machine: its random numbers are drawn in one order.
#include "core/numeric/random.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>

#include "tests/paths.hpp"

namespace {

/// Whether the order of the draws on this line is open: the language fixes it between declarations, within
/// braces, and at && and ||, but not between operands or arguments. g++ takes the last argument first on x86
/// and the first one first on ARM.
bool order_is_open(const std::string& line) {
  static const std::regex draws(R"(random_?\.(uniform|below)\(.*random_?\.(uniform|below)\()");
  static const std::regex ordered(R"((&&|\|\||= random_?\.[a-z]+\([^()]*\), \w+ = random_?\.))");
  return std::regex_search(line, draws) && !std::regex_search(line, ordered);
}

}  // namespace

TEST_CASE("no expression draws two random numbers in an order that the compiler chooses") {
  CHECK(order_is_open("return random.uniform() * u + random.uniform() * v;"));
  CHECK(order_is_open("Vec2(random_.uniform(-1, 1), random_.uniform(-1, 1));"));
  CHECK(!order_is_open("const double y = random.uniform(-1, 1), x = random.uniform(-1, 1);"));
  for (const char* folder : {"core", "firmware_gcode", "sim", "host"}) {
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(unicursal::test::source_folder() / folder)) {
      if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
      std::ifstream file(entry.path());
      for (std::string line; std::getline(file, line);) {
        INFO(entry.path().string() << ": " << line);
        CHECK(!order_is_open(line));
      }
    }
  }
}
