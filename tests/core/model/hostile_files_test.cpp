// Files with random damage are read or refused with a DataError; nothing else may happen.
#include <catch2/catch.hpp>
#include <random>

#include "core/error.hpp"
#include "core/text/file_bytes.hpp"
#include "model_support.hpp"

using namespace unicursal::core;

namespace {

std::string damaged(std::string bytes, std::mt19937& random) {
  static const std::string seasoning = "0123456789-.eE%<>/'\"=#;:() \n\xff";
  for (std::size_t i = 0, n = 1 + random() % 4; i < n && !bytes.empty(); ++i) {
    const std::size_t at = random() % bytes.size();
    switch (random() % 4) {
      case 0:
        bytes[at] = static_cast<char>(random());
        break;
      case 1:
        bytes[at] = seasoning[random() % seasoning.size()];
        break;
      case 2:
        bytes.erase(at, 1 + random() % 5);
        break;
      default:
        bytes.insert(at, bytes.substr(random() % bytes.size(), 1 + random() % 12));
    }
  }
  return bytes;
}

/// How many of the damaged files could still be read.
int survivors(const std::string& name, const std::string& sound, const std::vector<std::string>& selects) {
  const TempFolder folder;
  std::mt19937 random(99);
  int read = 0;
  for (int round = 0; round < 300; ++round) {
    const auto file = folder.write(name, damaged(sound, random));
    try {
      const auto p = part({file}, selects, 5.0);
      for (const Island& island : p->layer(0).islands) CHECK(area(island.outline) > 0);
      ++read;
    } catch (const DataError& error) {
      CHECK_FALSE(error.problem().empty());
    }
  }
  return read;
}

}  // namespace

TEST_CASE("damaged drawings are read or refused") {
  const int read = survivors("d.svg", file_bytes(test_data("two_zones.svg")), {"blue", "crimson"});
  CHECK(read > 30);
  CHECK(read < 300);
}

TEST_CASE("damaged meshes are read or refused") {
  const int text = survivors("m.stl", file_bytes(test_data("cube20.stl")), {"m"});
  CHECK(text < 300);
  const int binary = survivors("m.stl", binary_stl(box_mesh({0, 0, 0}, {20, 20, 20})), {"m"});
  CHECK(binary > 10);
  CHECK(binary < 300);
}
