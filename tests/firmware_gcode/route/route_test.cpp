#include "firmware_gcode/route/route.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numbers>
#include <numeric>
#include <random>

#include "firmware_gcode/route/island_order.hpp"

using namespace unicursal;
using namespace unicursal::gcode;

namespace {

/// A closed curve that fills a rectangle in folds 1 mm apart, there and back; its right half in zone 1 if
/// requested.
core::BeadPath comb(const core::Vec2& corner, double width, double height, bool two_zones = false,
                    double shift = 0) {
  core::BeadPath path;
  const auto add = [&](double x, double y) {
    path.beads.push_back({corner + core::Vec2(x, y), 0, two_zones && x > width / 2 + shift ? 1u : 0u});
  };
  const auto rows = static_cast<int>(height / 2);
  const auto columns = static_cast<int>(width / 0.5);
  for (int row = 0; row < rows; ++row) {
    for (int i = 2; i <= columns; ++i) add(0.5 * i, 2 * row + shift);
    for (int i = columns; i >= 2; --i) add(0.5 * i, 2 * row + 1 + shift);
  }
  for (double y = 2 * rows - 1; y >= 0; y -= 0.5) add(0, y + shift);
  for (std::size_t i = 0; i < path.size(); ++i) path.beads[i].area = path.length(i);
  return path;
}

PlacedLayer layer_of(std::vector<core::BeadPath> paths, std::size_t index) {
  PlacedLayer layer;
  layer.index = index;
  layer.top = 0.2 * static_cast<double>(index + 1);
  layer.height = 0.2;
  layer.paths = std::move(paths);
  return layer;
}

RouteOptions options_for(Seam seam = Seam::nearest, std::size_t horizon = default_horizon) {
  RouteOptions options;
  options.seam = seam;
  options.horizon = horizon;
  options.change_cost = [](std::size_t from, std::size_t to) { return from == to ? 0.0 : 1.0; };
  return options;
}

std::vector<RoutedLayer> routed(const std::vector<PlacedLayer>& layers, const RouteOptions& options) {
  Route route(options);
  std::vector<RoutedLayer> result;
  const auto take = [&] {
    while (auto next = route.take()) result.push_back(std::move(*next));
  };
  for (const PlacedLayer& layer : layers) {
    route.add(layer);
    take();
    CHECK(result.size() + options.horizon > static_cast<std::size_t>(&layer - layers.data()) + 1);
  }
  route.end();
  take();
  return result;
}

struct Tally {
  std::size_t travels = 0, changes = 0;
  double way = 0;
};

/// Along all traversals, from the first one's start.
Tally tally(const std::vector<RoutedLayer>& layers) {
  Tally t;
  std::optional<core::Vec2> here;
  std::optional<std::size_t> zone;
  for (const RoutedLayer& routed : layers) {
    for (const Traversal& leg : routed.traversals) {
      const core::BeadPath& path = routed.layer.paths[leg.path];
      const double width = path.total_area() / path.total_length();
      if (here) {
        const double way = (path.start(leg.start) - *here).norm();
        t.way += way;
        if (way > travel_widths * width) ++t.travels;
      }
      for (std::size_t k = 0; k < path.size(); ++k) {
        const std::size_t now = path.beads[bead_of(path, leg, k)].zone;
        if (zone && *zone != now) ++t.changes;
        zone = now;
      }
      here = bead_end(path, leg, path.size() - 1);
    }
  }
  return t;
}

}  // namespace

TEST_CASE("a traversal covers every bead once, in either direction, from any vertex") {
  const core::BeadPath path = comb({0, 0}, 10, 8);
  for (const bool reversed : {false, true}) {
    for (const std::size_t start : {std::size_t{0}, std::size_t{5}, path.size() - 1}) {
      const Traversal leg{0, start, reversed};
      std::vector<bool> seen(path.size(), false);
      core::Vec2 here = path.start(start);
      for (std::size_t k = 0; k < path.size(); ++k) {
        const std::size_t bead = bead_of(path, leg, k);
        CHECK_FALSE(seen[bead]);
        seen[bead] = true;
        const core::Vec2 end = bead_end(path, leg, k);
        CHECK((reversed ? path.end(bead) : path.start(bead)) == here);
        CHECK((end - here).norm() == Approx(path.length(bead)));
        here = end;
      }
      CHECK(here == path.start(start));
    }
  }
}

TEST_CASE("one island per layer: no travel for any seam, although the curves differ") {
  std::vector<PlacedLayer> layers;
  for (std::size_t i = 0; i < 12; ++i)
    layers.push_back(layer_of({comb({50, 50}, 20, 16, true, 0.1 * static_cast<double>(i % 5))}, i));
  for (const Seam seam : {Seam::hidden, Seam::scattered, Seam::aligned, Seam::nearest}) {
    const auto result = routed(layers, options_for(seam));
    REQUIRE(result.size() == layers.size());
    CHECK(tally(result).travels == 0);
    for (const RoutedLayer& layer : result) CHECK(layer.traversals.size() == 1);
  }
}

TEST_CASE("a layer begins with the last mixture, and on a border if that saves a change") {
  // Eight rows, crossed there and back: sixteen changes all round, one less from a border.
  std::vector<PlacedLayer> layers;
  for (std::size_t i = 0; i < 6; ++i) layers.push_back(layer_of({comb({50, 50}, 20, 16, true)}, i));
  const auto result = routed(layers, options_for());
  const Tally t = tally(result);
  const core::BeadPath& path = layers[0].paths[0];
  std::size_t all_round = 0;
  for (std::size_t i = 0; i < path.size(); ++i)
    all_round += path.beads[i].zone != path.beads[(i + 1) % path.size()].zone;
  CHECK(t.travels == 0);
  CHECK(t.changes == layers.size() * (all_round - 1));
  // The direction alternates.
  for (std::size_t i = 1; i < result.size(); ++i)
    CHECK(result[i].traversals[0].reversed != result[i - 1].traversals[0].reversed);
}

TEST_CASE("the horizon sees how a part continues") {
  // The part shrinks from the left: a start there needs a travel.
  std::vector<PlacedLayer> layers = {layer_of({comb({50, 50}, 40, 10)}, 0),
                                     layer_of({comb({60, 50}, 30, 10)}, 1),
                                     layer_of({comb({80, 50}, 10, 10)}, 2)};
  CHECK(tally(routed(layers, options_for())).travels == 0);
}

TEST_CASE(
    "a growing horizon returns the first layer at once, and later ones as soon as enough layers are known") {
  RouteOptions options = options_for();
  options.growing = true;
  Route route(options);
  const std::size_t decided[] = {1, 1, 2, 3, 3, 4, 5, 5, 6, 7};  // after so many layers
  std::size_t taken = 0;
  for (std::size_t i = 0; i < std::size(decided); ++i) {
    route.add(layer_of({comb({50, 50}, 40, 10)}, i));
    while (const auto next = route.take()) {
      CHECK(next->layer.index == taken);
      ++taken;
    }
    CHECK(taken == decided[i]);
  }
  route.end();
  while (route.take()) ++taken;
  CHECK(taken == std::size(decided));
}

TEST_CASE("islands: one travel per additional island, and none between layers") {
  std::mt19937 random(3);
  for (const std::size_t islands : {2u, 3u, 5u, 9u}) {
    std::vector<PlacedLayer> layers;
    for (std::size_t i = 0; i < 8; ++i) {
      std::vector<core::BeadPath> paths;
      for (std::size_t k = 0; k < islands; ++k) {
        paths.push_back(comb({20.0 + 30 * static_cast<double>(k % 3), 20.0 + 30 * static_cast<double>(k / 3)},
                             10, 10, false, 0.1 * static_cast<double>(random() % 4)));
      }
      std::shuffle(paths.begin(), paths.end(), random);
      layers.push_back(layer_of(std::move(paths), i));
    }
    const auto result = routed(layers, options_for(Seam::hidden));
    const Tally t = tally(result);
    CHECK(t.travels == layers.size() * (islands - 1));
    CHECK(t.way < static_cast<double>(layers.size() * islands) * 36);
    for (const RoutedLayer& layer : result) {
      std::vector<std::size_t> paths;
      for (const Traversal& leg : layer.traversals) paths.push_back(leg.path);
      std::sort(paths.begin(), paths.end());
      std::vector<std::size_t> all(islands);
      std::iota(all.begin(), all.end(), std::size_t{0});
      CHECK(paths == all);
    }
  }
}

TEST_CASE("the order of islands is as short as the best of all orders") {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> place(0, 150);
  for (int round = 0; round < 20; ++round) {
    std::vector<core::BeadPath> paths;
    while (paths.size() < 6) paths.push_back(comb({place(random), place(random)}, 4, 4));
    const core::BeadPath before = comb({place(random), place(random)}, 4, 4);
    std::vector<const core::BeadPath*> pointers;
    for (const core::BeadPath& path : paths) pointers.push_back(&path);
    const auto length = [&](const std::vector<std::size_t>& order) {
      double sum = way_between(before, paths[order[0]]);
      for (std::size_t i = 1; i < order.size(); ++i) sum += way_between(paths[order[i - 1]], paths[order[i]]);
      return sum;
    };
    std::vector<std::size_t> order(paths.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    double least = length(order);
    while (std::next_permutation(order.begin(), order.end())) least = std::min(least, length(order));
    CHECK(length(island_order(pointers, &before, {})) <= 1.02 * least);
  }
}

TEST_CASE("a hidden seam lies inside, aligned ones above each other, scattered ones move") {
  const auto with_outline = [](std::size_t i) {
    PlacedLayer layer = layer_of({comb({50, 50}, 20, 16, false, 0.1 * static_cast<double>(i % 3))}, i);
    layer.outlines = {{{{49.5, 49.5}, {70.5, 49.5}, {70.5, 66}, {49.5, 66}}, {}}};
    return layer;
  };
  std::vector<PlacedLayer> layers;
  for (std::size_t i = 0; i < 10; ++i) layers.push_back(with_outline(i));
  const auto starts = [&](Seam seam) {
    std::vector<core::Vec2> places;
    for (const RoutedLayer& layer : routed(layers, options_for(seam))) {
      places.push_back(layer.layer.paths[0].start(layer.traversals[0].start));
    }
    return places;
  };
  for (const core::Vec2& place : starts(Seam::hidden)) {
    CHECK(core::distance_to_border(layers[0].outlines[0], place) > 2);
  }
  const auto aligned = starts(Seam::aligned);
  for (const core::Vec2& place : aligned) CHECK((place - aligned[0]).norm() < 0.5);
  const auto scattered = starts(Seam::scattered);
  double spread = 0;
  for (const core::Vec2& place : scattered) spread = std::max(spread, (place - scattered[0]).norm());
  CHECK(spread > 1);
}
