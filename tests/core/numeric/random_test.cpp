// What makes a curve the same on every machine: its random numbers are drawn in one order.
#include "core/numeric/random.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <string>

#include "tests/paths.hpp"

namespace {

/// Whether the order of the draws in this statement is open: the language fixes it between declarations,
/// within braces, after a condition, and at && and ||, but not between operands or arguments. g++ takes the
/// last argument first on x86 and the first one first on ARM.
bool order_is_open(const std::string& statement) {
  static const std::regex draw(R"(random_?\.(uniform|below)\()");
  static const std::regex ordered(
      R"(&&|\|\||\?|\bif \(|\bwhile \(|= random_?\.[a-z]+\([^()]*\),\s+\w+ = random_?\.)");
  const auto draws = std::distance(std::sregex_iterator(statement.begin(), statement.end(), draw), {});
  return draws > 1 && !std::regex_search(statement, ordered);
}

}  // namespace

TEST_CASE("no expression draws two random numbers in an order that the compiler chooses") {
  CHECK(order_is_open("return random.uniform() * u +\n    random.uniform() * v"));
  CHECK(order_is_open("Vec2(random_.uniform(-1, 1), random_.uniform(-1, 1))"));
  CHECK(!order_is_open("const double y = random.uniform(-1, 1), x = random.uniform(-1, 1)"));
  std::size_t files = 0;
  for (const char* folder : {"core", "firmware_gcode", "sim", "host"}) {
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(unicursal::test::source_folder() / folder)) {
      if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
      ++files;
      std::ifstream file(entry.path());
      std::ostringstream text;
      text << file.rdbuf();
      const std::string code = text.str();
      for (std::size_t at = 0; at < code.size();) {
        const std::size_t end = std::min(code.find_first_of(";{}", at), code.size());
        const std::string statement = code.substr(at, end - at);
        INFO(entry.path().string() << ": " << statement);
        if (statement.find("random") != std::string::npos) CHECK(!order_is_open(statement));
        at = end + 1;
      }
    }
  }
  CHECK(files > 300);
}
