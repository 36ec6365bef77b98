#include "core/numeric/disjoint_sets.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

#include "core/numeric/random.hpp"

using namespace unicursal::core;

TEST_CASE("disjoint sets agree with labels that are replaced one by one") {
  constexpr std::size_t count = 200;
  Random random(1);
  DisjointSets sets(count);
  std::vector<std::size_t> label(count);
  for (std::size_t i = 0; i < count; ++i) label[i] = i;
  for (int joins = 0; joins < 300; ++joins) {
    const std::size_t a = random.below(count), b = random.below(count);
    CHECK(sets.join(a, b) == (label[a] != label[b]));
    std::replace(label.begin(), label.end(), std::size_t(label[a]), std::size_t(label[b]));
    for (int pairs = 0; pairs < 20; ++pairs) {
      const std::size_t c = random.below(count), d = random.below(count);
      REQUIRE(sets.same(c, d) == (label[c] == label[d]));
    }
  }
}
