// The combinatorial optimiser of core/cycle, on squares where isotropic directions or one direction are asked
// for.
//
// First table: the annealing (used) against the paper's Algorithm 1, alone and with a population of
// champions. It prints the objective that each reaches (smaller is better), its looks at stops, and the
// processor time. Second table: what keeping the order of stops costs with labels (used), against renumbering
// all stops at each accepted change, as the paper does. It prints labels given for each accepted change, and
// the time that renumbering would take.
#include <fmt/core.h>

#include <cmath>
#include <ctime>

#include "core/cycle/first_cycle.hpp"
#include "core/cycle/shuffle.hpp"
#include "core/cycle/tour_order.hpp"
#include "core/graph/cell_graph.hpp"

namespace {

using namespace unicursal::core;

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// A square with seeds 1 mm apart on average.
Tour first_tour(double side) {
  Random random(1);
  auto cycle = first_cycle(*make_cell_graph({{{0, 0}, {side, 0}, {side, side}, {0, side}}, {}}, 1.0, random));
  return std::move(cycle->tour);
}

Demand isotropic(const Vec2&) {
  Demand demand;
  demand.even_zone = EvenZoneIndex(0);
  return demand;
}

Demand one_direction(const Vec2&) {
  constexpr double angle = 0.4;  // rad
  Demand demand;
  demand.direction = Vec2(std::cos(2 * angle), std::sin(2 * angle));
  return demand;
}

struct Measured {
  ShuffleReport report;
  double seconds = 0;
};

Measured measure(Tour tour, const DemandAt& demand, const ShuffleOptions& options) {
  Random random(1);
  const double start = processor_seconds();
  Measured measured{shuffle(tour, demand, {}, options, random), 0};
  measured.seconds = processor_seconds() - start;
  return measured;
}

void compare_rules() {
  ShuffleOptions annealing, short_annealing, algorithm_1, population;
  short_annealing.sweeps = 144;  // a tenth of the population's looks
  algorithm_1.rule = population.rule = ShuffleOptions::Rule::algorithm_1;
  algorithm_1.at_flaws = population.at_flaws = 0;
  population.sweeps = 16;
  population.champions = 12;
  population.candidates = 2;
  population.generations = 3;
  const Tour tour = first_tour(40);
  fmt::print("{} stops\n{:<14}{:<26}{:>12}{:>12}{:>12}{:>9}\n", tour.stop_count(), "asked", "rule", "before",
             "after", "looks", "s");
  for (const auto& [asked, demand] :
       {std::pair<const char*, DemandAt>{"isotropic", isotropic}, {"one direction", one_direction}}) {
    for (const auto& [rule, options] : {std::pair<const char*, ShuffleOptions>{"annealing", annealing},
                                        {"annealing, shorter", short_annealing},
                                        {"Algorithm 1", algorithm_1},
                                        {"Algorithm 1, population", population}}) {
      const Measured measured = measure(tour, demand, options);
      fmt::print("{:<14}{:<26}{:>12.2f}{:>12.2f}{:>12}{:>9.2f}\n", asked, rule, measured.report.before,
                 measured.report.after, measured.report.looks, measured.seconds);
    }
  }
}

void compare_orders() {
  fmt::print("\n{:>8}{:>12}{:>20}{:>14}{:>22}\n", "stops", "accepted", "labels a change", "all, s",
             "renumbering alone, s");
  for (const double side : {20.0, 40.0, 80.0}) {
    const Tour tour = first_tour(side);
    ShuffleOptions options;
    options.sweeps = 50;
    const Measured measured = measure(tour, one_direction, options);
    constexpr int times = 20;
    const double start = processor_seconds();
    for (int i = 0; i < times; ++i) TourOrder{tour};
    const double renumbering = (processor_seconds() - start) / times;
    const auto accepted = static_cast<double>(measured.report.accepted);
    fmt::print("{:>8}{:>12}{:>20.2f}{:>14.2f}{:>22.2f}\n", tour.visited_count(), measured.report.accepted,
               static_cast<double>(measured.report.labelled) / accepted, measured.seconds,
               accepted * renumbering);
  }
}

}  // namespace

int main() {
  compare_rules();
  compare_orders();
}
