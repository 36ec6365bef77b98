// The conditions under which the photos of tests and benchmarks are taken.
#include <numbers>

#include "tests/camera/camera.hpp"

namespace unicursal::camera {
namespace {

constexpr double degree = std::numbers::pi / 180;

Conditions named(const std::string& name, std::uint32_t seed) {
  Conditions conditions;
  conditions.name = name;
  conditions.seed = seed;
  return conditions;
}

Conditions from_above() {
  Conditions c = named("from above", 1);
  c.view.framing = 0.85;
  c.sensor = {20000, 0.0005, 0, 0};
  c.quality = 92;
  return c;
}

Conditions daylight() {
  Conditions c = named("daylight", 2);
  c.bed = Bed::light;
  c.view = {25 * degree, 8 * degree, 70 * degree, 0.9, 0.02, 0};
  c.light.falloff = 0.9;
  c.light.gains = {1.05F, 1, 0.95F};
  c.light.exposure = 0.75;
  return c;
}

Conditions on_glass() {
  Conditions c = named("on glass", 3);
  c.bed = Bed::glass;
  c.view = {-12 * degree, 15 * degree, -90 * degree, 0.9, -0.02, 0};
  c.light.falloff = 0.8;
  c.light.slope_towards = 2;
  c.orientation = 6;
  return c;
}

Conditions lamp_light() {
  Conditions c = named("lamp light", 4);
  c.bed = Bed::pei;
  c.lamp = {2.5, 0.8, 0.3};
  c.view = {180 * degree, 18 * degree, 40 * degree, 0.8, -0.03, 0.01};
  c.blur = {0.5, 0, 0};
  c.light.falloff = 0.75;
  c.light.spot = {0.7, 0.3};
  c.light.gains = {1.2F, 1, 0.75F};
  c.sensor = {4000, 0.001, 0.4, 0.4};
  c.quality = 85;
  return c;
}

Conditions on_tape() {
  Conditions c = named("on tape", 5);
  c.bed = Bed::tape;
  c.view = {8 * degree, 22 * degree, 5 * degree, 0.75, -0.06, 0.01};
  c.blur = {0.7, 0.5, 1};
  c.light.falloff = 0.75;
  c.light.slope_towards = 4;
  c.light.exposure = 1;
  c.orientation = 3;
  c.quality = 85;
  return c;
}

Conditions beside_a_window() {
  Conditions c = named("beside a window", 6);
  c.bed = Bed::gold;
  c.lamp = {3.1, 0.5, 0.35};
  c.view = {-33 * degree, 20 * degree, 160 * degree, 0.85, 0.03, 0};
  c.blur = {0.6, 0, 0};
  c.light.falloff = 0.65;
  c.light.slope_towards = 3.1;
  c.light.gains = {0.9F, 1, 1.12F};
  c.light.glares = {{0.1, 0.9, 7, 0.35}, {1.02, 0.5, 9, 0.5}};
  c.sensor = {5000, 0.001, 0.6, 0.5};
  return c;
}

Conditions dim() {
  Conditions c = named("dim", 7);
  c.bed = Bed::dark;
  c.view = {95 * degree, 15 * degree, -60 * degree, 0.9, -0.04, 0};
  c.blur = {1, 0.8, 2};
  c.light.falloff = 0.7;
  c.light.gains = {0.8F, 1, 1.2F};
  c.light.exposure = 0.45;
  c.sensor = {900, 0.003, 0.3, 0.4};
  c.orientation = 8;
  c.quality = 80;
  return c;
}

Conditions slanted() {
  Conditions c = named("slanted", 8);
  c.bed = Bed::glass;
  c.lamp = {-1, 0.9, 0.3};
  c.view = {-70 * degree, 32 * degree, 200 * degree, 0.9, 0.1, -0.03};
  c.blur = {0.8, 0.4, 0};
  c.light.falloff = 0.7;
  c.light.spot = {0.5, 0.9};
  c.light.gains = {1.1F, 1, 0.85F};
  c.sensor = {2500, 0.0015, 0.5, 0.5};
  c.quality = 80;
  return c;
}

Conditions glaring() {
  Conditions c = named("glaring", 9);
  c.bed = Bed::pei;
  c.lamp = {0.4, 0.7, 0.5};
  c.view = {137 * degree, 20 * degree, 120 * degree, 0.85, -0.08, 0.02};
  c.blur = {0.8, 0.5, 1};
  c.light.falloff = 0.6;
  c.light.spot_tint = {1.06F, 1, 0.93F};
  c.light.gains = {0.85F, 1, 1.15F};
  c.light.exposure = 0.95;
  c.light.glares = {
      {0.25, 0.62, 3, 0.5}, {0.62, 0.5, 4, 0.8}, {0.9, 0.15, 6, 0.9}, {0.4, 0.2, 3, 0.4}, {0.5, 1.1, 8, 1}};
  c.sensor = {2500, 0.0015, 0.5, 0.6};
  c.quality = 78;
  return c;
}

Conditions everything_at_once() {
  Conditions c = named("everything at once", 10);
  c.bed = Bed::tape;
  c.lamp = {5, 0.6, 0.4};
  c.view = {-160 * degree, 35 * degree, 65 * degree, 0.5, -0.12, 0.03};
  c.blur = {1.5, 0.8, 0.7};
  c.light.falloff = 0.55;
  c.light.slope_towards = 1;
  c.light.spot = {0.8, 0.8};
  c.light.spot_tint = {1.05F, 1, 0.94F};
  c.light.gains = {1.25F, 1, 0.7F};
  c.light.exposure = 0.85;
  c.light.glares = {{0.15, 0.5, 4, 0.4}, {0.75, 0.1, 5, 0.6}, {0.55, 0.95, 3, 0.5}};
  c.sensor = {800, 0.003, 0.7, 0.6};
  c.orientation = 5;
  c.quality = 70;
  return c;
}

/// An easy photo with one fault.
Conditions spoilt(const std::string& name, void (*spoil)(Conditions&)) {
  Conditions c = daylight();
  c.name = name;
  spoil(c);
  return c;
}

}  // namespace

std::vector<Conditions> conditions() {
  return {from_above(),      daylight(), on_glass(), lamp_light(), on_tape(),
          beside_a_window(), dim(),      slanted(),  glaring(),    everything_at_once()};
}

std::vector<Conditions> unreadable_conditions() {
  return {
      spoilt("cut off", [](Conditions& c) { c.view.framing = 1.35; }),
      spoilt("out of focus", [](Conditions& c) { c.blur.defocus = 20; }),
      spoilt("too dark", [](Conditions& c) { c.light.exposure = 0.004; }),
      spoilt("overexposed", [](Conditions& c) { c.light.exposure = 40; }),
      spoilt("only the bed", [](Conditions& c) { c.bare = true; }),
      spoilt("tiny", [](Conditions& c) { c.width = 320, c.height = 240; }),
  };
}

std::vector<Conditions> doubtful_conditions() {
  return {
      spoilt("clipped light", [](Conditions& c) { c.light.exposure = 3.5; }),
      spoilt("dark and noisy", [](Conditions& c) { c.light.exposure = 0.04, c.sensor.electrons = 1500; }),
      spoilt("soft", [](Conditions& c) { c.blur.defocus = 6; }),
      spoilt("shaken", [](Conditions& c) { c.blur.motion = 12; }),
      spoilt("small", [](Conditions& c) { c.width = 1000, c.height = 750; }),
      spoilt("far away", [](Conditions& c) { c.view.framing = 0.2; }),
      spoilt("very slanted", [](Conditions& c) { c.view.slant = 55 * degree, c.view.slant_towards = 1; }),
  };
}

std::vector<FilamentPair> filament_pairs() {
  return {{"blue", "red"},      {"yellow", "blue"}, {"white", "red"},
          {"green", "magenta"}, {"white", "blue"},  {"orange", "cyan"}};
}

FilamentPair lopsided_pair() {
  return {"yellow", "black"};
}

FilamentPair similar_pair() {
  return {"red", "red"};
}

}  // namespace unicursal::camera
