#include "core/numeric/parallel.hpp"

#include <catch2/catch.hpp>

#include <atomic>
#include <stdexcept>
#include <vector>

using namespace unicursal::core;

TEST_CASE("every piece of a job is done exactly once, in job after job") {
  Workers workers(GENERATE(1, 2, 5));
  for (std::size_t count = 0; count < 300; ++count) {
    std::vector<int> done(count, 0);
    workers.each(count, [&](std::size_t k) { ++done[k]; });
    REQUIRE(done == std::vector<int>(count, 1));
  }
}

TEST_CASE("ranges cover all numbers, and the last one may be shorter") {
  Workers workers(2);
  std::vector<int> done(1003, 0);
  workers.ranges(done.size(), 10, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) ++done[k];
  });
  CHECK(done == std::vector<int>(done.size(), 1));
}

TEST_CASE("a job's exception reaches the caller, and the workers remain usable") {
  Workers workers(GENERATE(1, 3));
  const auto fails = [](std::size_t k) {
    if (k == 17) throw std::runtime_error("seventeen");
  };
  CHECK_THROWS_AS(workers.each(100, fails), std::runtime_error);
  std::atomic<int> done = 0;
  workers.each(100, [&](std::size_t) { ++done; });
  CHECK(done == 100);
}
