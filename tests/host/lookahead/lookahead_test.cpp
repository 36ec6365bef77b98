#include "host/lookahead/lookahead.hpp"

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <set>
#include <thread>

#include "core/error.hpp"

namespace unicursal::host {
namespace {

core::Polygon square(double x, double side) {
  return {{{x, 0}, {x + side, 0}, {x + side, side}, {x, side}}, {}};
}

/// A stack of layers, each with three squares; the layer `broken` cannot be cut.
class Stack : public core::Part {
 public:
  explicit Stack(std::size_t layers, std::size_t broken = SIZE_MAX) : layers_(layers), broken_(broken) {}

  std::size_t layer_count() const override { return layers_; }
  core::Layer layer(std::size_t index) const override {
    ++cut;
    if (index == broken_) throw core::ModelError("", "z 1", "is open", "close it");
    core::Layer layer;
    layer.index = index;
    layer.height = 0.2;
    for (double x : {0.0, 10.0, 20.0}) {
      const core::Polygon outline = square(x, 5);
      layer.islands.push_back({outline, {{0, {outline}}}});
    }
    return layer;
  }
  core::Box extent() const override { return {{0, 0}, {25, 5}}; }
  double height() const override { return 0.2 * static_cast<double>(layers_); }
  const std::vector<core::Zone>& zones() const override { return zones_; }
  const std::vector<std::string>& warnings() const override { return warnings_; }

  mutable std::atomic<std::size_t> cut = 0;

 private:
  std::size_t layers_, broken_;
  std::vector<core::Zone> zones_{{"all", {}, 0}};
  std::vector<std::string> warnings_;
};

LookaheadOptions options_for(std::size_t first, std::size_t count, std::size_t threads,
                             std::size_t ahead = 0) {
  LookaheadOptions options;
  options.plan.bead_width = 1;
  options.plan.min_bead_width = 0.4;
  options.first = first;
  options.count = count;
  options.threads = threads;
  options.ahead = ahead;
  return options;
}

std::vector<PlannedLayer> all_of(const core::Part& part, const LookaheadOptions& options) {
  Lookahead lookahead(part, options);
  std::vector<PlannedLayer> layers;
  while (std::optional<PlannedLayer> layer = lookahead.wait()) layers.push_back(std::move(*layer));
  return layers;
}

constexpr double area_rounding = 1e-12;  // mm²

bool same_beads(const core::IslandPlan& a, const core::IslandPlan& b) {
  if (a.curves.size() != b.curves.size()) return false;
  for (std::size_t c = 0; c < a.curves.size(); ++c) {
    const auto &p = a.curves[c].path.beads, &q = b.curves[c].path.beads;
    const auto equal = [](const core::Bead& x, const core::Bead& y) {
      return x.position == y.position && x.zone == y.zone && std::abs(x.area - y.area) <= area_rounding;
    };
    if (!std::equal(p.begin(), p.end(), q.begin(), q.end(), equal)) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("Layers come in order, whole, and equal for any number of threads") {
  const Stack part(9);
  const auto one = all_of(part, options_for(2, 6, 1));
  const auto three = all_of(part, options_for(2, 6, 3));
  REQUIRE(one.size() == 6);
  REQUIRE(three.size() == 6);
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(three[i].layer.index == i + 2);
    REQUIRE(three[i].plans.size() == 3);
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK_FALSE(three[i].plans[k].curves.empty());
      CHECK(same_beads(one[i].plans[k], three[i].plans[k]));
    }
  }
  CHECK_FALSE(same_beads(one[0].plans[0], one[1].plans[0]));  // layers differ
}

TEST_CASE("Nothing to plan ends at once") {
  CHECK(all_of(Stack(3), options_for(3, 0, 2)).empty());
}

TEST_CASE("No more layers are open than allowed, however slowly they are taken") {
  const Stack part(20);
  Lookahead lookahead(part, options_for(0, 20, 2, 3));
  for (std::size_t taken = 1; lookahead.wait(); ++taken) {
    std::this_thread::yield();
    CHECK(part.cut <= taken + 3);
  }
  CHECK(part.cut == 20);
  CHECK(lookahead.most_open() <= 3);
  CHECK(lookahead.effort().seconds > 0);
}

TEST_CASE("An error comes in its turn, and ends the look-ahead") {
  const Stack part(8, 2);
  Lookahead lookahead(part, options_for(0, 8, 2));
  CHECK(lookahead.wait()->layer.index == 0);
  CHECK(lookahead.wait()->layer.index == 1);
  CHECK_THROWS_AS(lookahead.wait(), core::ModelError);
  CHECK_FALSE(lookahead.wait());
}

TEST_CASE("Cancelling wakes a thread that waits") {
  const Stack part(100000);
  Lookahead lookahead(part, options_for(0, 100000, 1, 1));
  std::thread canceller([&] {
    while (part.cut < 3) std::this_thread::yield();
    lookahead.cancel();
  });
  std::size_t taken = 0;
  while (lookahead.wait()) ++taken;
  canceller.join();
  CHECK(taken < 100000);
  CHECK(lookahead.ready());
  CHECK_FALSE(lookahead.wait());
}

TEST_CASE("A listener is called when a layer is ready") {
  const Stack part(7);
  std::mutex mutex;
  std::condition_variable told;
  Lookahead lookahead(part, options_for(0, 7, 2));
  lookahead.on_ready([&] { told.notify_all(); });
  std::vector<std::size_t> order;
  for (;;) {
    std::unique_lock lock(mutex);
    // The bound only lets a lost notification fail the test instead of hanging it.
    REQUIRE(told.wait_for(lock, std::chrono::seconds(60), [&] { return lookahead.ready(); }));
    const auto layer = lookahead.wait();
    if (!layer) break;
    order.push_back(layer->layer.index);
  }
  lookahead.on_ready({});
  CHECK(order == std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6});
}

TEST_CASE("A viewer sees each layer that is planned ahead, also those that waited before it came") {
  const Stack part(6);
  std::mutex mutex;
  std::condition_variable news;
  std::multiset<std::size_t> seen;
  Lookahead lookahead(part, options_for(0, 6, 2, 3));
  const auto see = [&](const PlannedLayer& layer) {
    const std::lock_guard lock(mutex);
    if (layer.plans.size() == 3 && layer.plans[2].curves.size() == 1) seen.insert(layer.layer.index);
    news.notify_all();
  };
  const auto until = [&](const std::multiset<std::size_t>& expected) {
    std::unique_lock lock(mutex);
    // The bound only lets a fault fail the test instead of hanging it.
    REQUIRE(news.wait_for(lock, std::chrono::seconds(60), [&] { return seen == expected; }));
  };
  lookahead.on_planned(see);
  until({0, 1, 2});
  lookahead.on_planned(see);
  until({0, 0, 1, 1, 2, 2});
  CHECK(lookahead.wait()->layer.index == 0);
  until({0, 0, 1, 1, 2, 2, 3});
  lookahead.on_planned({});
  for (std::size_t i = 1; i < 6; ++i) CHECK(lookahead.wait()->layer.index == i);
  CHECK_FALSE(lookahead.wait());
  CHECK(seen == std::multiset<std::size_t>{0, 0, 1, 1, 2, 2, 3});
}

TEST_CASE("The horizon in seconds is planned ahead, and at least one layer more than there are threads") {
  const double seconds = 75 * 0.2 / 1.5;  // three squares of 25 mm², 0.2 mm high, at 1.5 mm³/s
  const auto open_at_once = [&](double horizon) {
    const Stack part(30);
    LookaheadOptions options = options_for(0, 30, 1);
    options.flow = 1.5;
    options.horizon = horizon;
    Lookahead lookahead(part, options);
    std::size_t waiting = 0;
    while (lookahead.wait()) waiting = std::max(waiting, lookahead.waiting().layers);
    CHECK(lookahead.waiting().seconds == 0);
    return lookahead.most_open();
  };
  CHECK(open_at_once(seconds / 2) <= 2);
  CHECK(open_at_once(5 * seconds) <= 6);
}

TEST_CASE("Islands have unlimited time until the printer reports, and always without a pace") {
  const Stack part(3);
  LookaheadOptions options = options_for(0, 3, 1);
  options.flow = 1.5;
  SECTION("not reported yet") {
    options.pace = PlanningClock{{}, 1e6};
  }
  SECTION("no pace") {}
  const auto full = all_of(part, options_for(0, 3, 1));
  Lookahead lookahead(part, options);
  if (!options.pace) lookahead.printed(1e9, 0);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto layer = lookahead.wait();
    CHECK(layer->effort == 1);
    for (std::size_t k = 0; k < 3; ++k) CHECK(same_beads(layer->plans[k], full[i].plans[k]));
  }
}

TEST_CASE("Once a layer is taken, the next one has as long as the first one prints") {
  const Stack part(2);
  LookaheadOptions options = options_for(0, 2, 1);
  options.flow = 1e-3;  // mm³/s: hours for a layer
  options.pace = PlanningClock{[] { return 0.0; }, 1};
  Lookahead lookahead(part, options);
  lookahead.printed(0, 0);
  CHECK(lookahead.wait()->effort < 1);  // the printer stands still
  CHECK(lookahead.wait()->effort == 1);
}

TEST_CASE("On a slow computer layers get less effort, report it, and are still complete") {
  const Stack part(12);
  LookaheadOptions options = options_for(0, 12, 1);
  options.flow = 1.5;
  options.horizon = 100;
  options.pace = PlanningClock{{}, 1e5};
  Lookahead lookahead(part, options);
  double now = 0, least = 1, ready = 0;
  lookahead.printed(now, 0);
  while (const auto layer = lookahead.wait()) {
    CHECK(layer->ready_at >= ready);  // in order
    ready = layer->ready_at;
    least = std::min(least, layer->effort);
    CHECK(layer->effort > 0);
    for (const core::IslandPlan& plan : layer->plans) {
      REQUIRE(plan.curves.size() == 1);
      CHECK(plan.curves[0].self_intersections == 0);
      CHECK(plan.curves[0].outside_segments == 0);
    }
    now = std::max(now, ready) + 10;
    lookahead.printed(now, 0);
  }
  CHECK(least < 1);
}

TEST_CASE(
    "With patience nothing is hurried on such a computer either, and the curves are those without a pace") {
  const Stack part(2);
  LookaheadOptions options = options_for(0, 2, 1);
  options.flow = 1.5;
  Lookahead unhurried(part, options);
  options.pace = PlanningClock{{}, 1e5};
  options.patient = true;
  Lookahead patient(part, options);
  patient.printed(0, 0);
  while (const auto layer = patient.wait()) {
    CHECK(layer->effort == 1);
    const auto expected = unhurried.wait();
    REQUIRE(expected);
    for (std::size_t i = 0; i < layer->plans.size(); ++i)
      CHECK(same_beads(layer->plans[i], expected->plans[i]));
    patient.printed(layer->ready_at + 10, 0);
  }
}

TEST_CASE("The recorded effort of a hurried island gives the same curve again") {
  const Stack part(1);
  LookaheadOptions options = options_for(0, 1, 1);
  options.flow = 1.5;
  options.pace = PlanningClock{{}, 1e5};
  Lookahead lookahead(part, options);
  lookahead.printed(0, 0);
  const auto layer = lookahead.wait();
  core::PlanOptions again = options.plan;
  for (std::size_t k = 0; k < 3; ++k) {
    again.seed = island_seed(options.plan.seed, 0, k);
    again.recorded = layer->plans[k].effort;
    const core::IslandPlan plan = core::IslandPlanner(part.zones()).plan(layer->layer.islands[k], 0, again);
    CHECK(same_beads(plan, layer->plans[k]));
  }
}

TEST_CASE("A look-ahead without a listener ends") {
  const Stack part(50);
  const Lookahead lookahead(part, options_for(0, 50, 2));
}

TEST_CASE("Seeds of islands differ by job, layer and island") {
  std::set<std::uint64_t> seeds;
  for (std::uint64_t job = 0; job < 10; ++job) {
    for (std::size_t layer = 0; layer < 10; ++layer) {
      for (std::size_t island = 0; island < 10; ++island) seeds.insert(island_seed(job, layer, island));
    }
  }
  CHECK(seeds.size() == 1000);
}

}  // namespace unicursal::host
