#include "core/graph/index.hpp"

#include <catch2/catch.hpp>

#include <type_traits>

using namespace unicursal::core;

namespace {

template <typename Container, typename I>
concept indexable = requires(Container container, I index) {
  container[index];
};

static_assert(std::is_trivially_copyable_v<NodeIndex> && sizeof(NodeIndex) == sizeof(int));
static_assert(!std::is_convertible_v<NodeIndex, EdgeIndex> && !std::is_constructible_v<NodeIndex, EdgeIndex>);
static_assert(!std::is_convertible_v<std::size_t, NodeIndex> &&
              !std::is_convertible_v<NodeIndex, std::size_t>);
static_assert(indexable<Per<NodeIndex, int>, NodeIndex>);
static_assert(!indexable<Per<NodeIndex, int>, EdgeIndex> && !indexable<Per<NodeIndex, int>, std::size_t>);

}  // namespace

TEST_CASE("a default index is invalid, and less than all others") {
  CHECK_FALSE(NodeIndex().valid());
  CHECK(NodeIndex(0).valid());
  CHECK(NodeIndex() < NodeIndex(0));
  CHECK(NodeIndex(3) == NodeIndex(3));
  CHECK(NodeIndex(3) != NodeIndex(4));
}

TEST_CASE("a container per index is visited in order, and finds the first value with a property") {
  Per<FaceIndex, int> squares;
  for (int k = 0; k < 5; ++k) CHECK(squares.push_back(k * k) == FaceIndex(static_cast<std::size_t>(k)));
  std::size_t next = 0;
  for (const FaceIndex f : squares.indices()) {
    CHECK(f.number() == next);
    CHECK(squares[f] == static_cast<int>(next * next));
    ++next;
  }
  CHECK(next == 5);
  CHECK(squares.first_with([](int square) { return square > 3; }) == FaceIndex(2));
  CHECK_FALSE(squares.first_with([](int square) { return square > 99; }).valid());
}
