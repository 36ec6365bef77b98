// Planning that is not wanted any more ends within a second, in whatever stage it is.
#include "core/stopping.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "core/geometry/region.hpp"
#include "core/numeric/parallel.hpp"
#include "core/planner/plan_island.hpp"

using namespace unicursal::core;

namespace {

using Time = std::chrono::steady_clock;

Polygon square(double side) {
  return {{{0, 0}, {side, 0}, {side, side}, {0, side}}, {}};
}

/// s that planning went on after it was asked to stop; nullopt if it had ended by itself.
std::optional<double> time_to_stop(double side, double bead_width, PatternKind kind, double after,
                                   int threads) {
  Zone zone;
  zone.pattern.kind = kind;
  Island island;
  island.outline = square(side);
  island.zones = {{0, {island.outline}}};
  PlanOptions options;
  options.bead_width = bead_width;
  options.threads = threads;
  std::stop_source source;
  Time::time_point asked;
  std::jthread stopper([&](const std::stop_token& done) {
    const auto end = Time::now() + std::chrono::duration<double>(after);
    while (Time::now() < end && !done.stop_requested())
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    asked = Time::now();
    source.request_stop();
  });
  const StopScope scope(source.get_token());
  try {
    plan_island(island, {zone}, options);
  } catch (const Stopped&) {
    const auto stopped = Time::now();
    stopper.join();
    return std::chrono::duration<double>(stopped - asked).count();
  }
  return std::nullopt;
}

}  // namespace

TEST_CASE("a stop token reaches the threads that help, and other threads are not stopped") {
  std::stop_source source;
  Workers workers(3);
  {
    const StopScope scope(source.get_token());
    std::atomic<int> done = 0;
    CHECK_THROWS_AS(workers.each(1000,
                                 [&](std::size_t) {
                                   if (++done == 10) source.request_stop();
                                 }),
                    Stopped);
    CHECK(done < 1000);
    CHECK_THROWS_AS(stop_point(), Stopped);
    const StopScope inner({});
    stop_point();
  }
  stop_point();
  int done = 0;
  Workers(1).each(10, [&](std::size_t) { ++done; });
  workers.each(10, [](std::size_t) { stop_point(); });
  CHECK(done == 10);
}

TEST_CASE("planning stops soon after it is asked to, in an early stage and in a late one") {
  for (const double after : {0.05, 0.4, 1.2}) {
    INFO("after " << after << " s");
    const auto time = time_to_stop(60, 0.4, PatternKind::isotropic, after, 2);
    if (time) CHECK(*time < 3);  // a second, on a computer that does nothing else
  }
}

TEST_CASE("planning of a large plate stops soon in every stage", "[long]") {
  double longest = 0;
  for (const PatternKind kind : {PatternKind::isotropic, PatternKind::parallel}) {
    for (double after = 0.1; after < 300; after *= 1.5) {
      const auto time = time_to_stop(190, 0.4, kind, after, 1);
      if (!time) break;
      INFO("after " << after << " s: " << *time << " s");
      CHECK(*time < 3);
      longest = std::max(longest, *time);
    }
  }
  WARN("the longest took " << longest << " s");
}
