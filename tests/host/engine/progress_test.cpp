// How far a print has come, without a printer: values computed by hand.
#include <catch2/catch.hpp>

#include "host/engine/progress.hpp"

using namespace unicursal::host;
using unicursal::gcode::Chunk;
using unicursal::gcode::LayerShare;

namespace {

/// `layers` layers that are expected to take 100 s each.
Ahead expected(std::size_t layers) {
  return {layers, {}, [](std::size_t begin, std::size_t end) {
            return 100.0 * static_cast<double>(end - begin);
          }};
}

/// Nothing is foretold; `waiting` layers are planned.
Ahead unknown(std::size_t layers, Waiting waiting) {
  return {layers, waiting, [](std::size_t, std::size_t) { return std::optional<double>(); }};
}

Chunk chunk_of(std::vector<LayerShare> layers) {
  Chunk chunk;
  for (const LayerShare& share : layers) chunk.seconds += share.seconds;
  chunk.layers = std::move(layers);
  return chunk;
}

LayerShare whole(std::size_t layer, double seconds) {
  return {layer, 0, seconds, true};
}

LayerShare part(std::size_t layer, double seconds) {
  return {layer, 0, seconds, false};
}

}  // namespace

TEST_CASE("Nothing has begun before the first chunk") {
  const Progress progress;
  CHECK_FALSE(progress.has_begun());
  CHECK_FALSE(progress.has_laid());
  CHECK(progress.layer(4) == 0);
  CHECK(progress.seconds_left(expected(4)) == Approx(400));
  CHECK(progress.percent(expected(4), false) == 0);
}

TEST_CASE("A first print is timed by its forecast, stretched as its layers were, but not by the first") {
  Progress progress;
  const Ahead ahead = expected(4);
  Chunk first = chunk_of({whole(0, 120)});
  first.seconds = 130;  // with 10 s of priming
  first.prime_volume = 20;
  progress.begin_chunk(first, 2);
  CHECK(progress.has_begun());
  CHECK_FALSE(progress.has_laid());
  CHECK(progress.layer(4) == 1);
  CHECK(progress.seconds_left(ahead) == Approx(130 + 300));
  progress.sent(0.5);
  CHECK(progress.chunk_seconds_left() == Approx(65));
  CHECK(progress.seconds_left(ahead) == Approx(65 + 300));
  CHECK(progress.percent(ahead, false) == Approx(100 * 65 / 430.0));
  progress.end_chunk();
  CHECK(progress.has_laid());
  CHECK(progress.fraction() == 0);
  CHECK(progress.seconds_left(ahead) == Approx(300));
  const double before = 100 * 130 / 430.0;
  CHECK(progress.percent(ahead, false) == Approx(before));

  // Layer 1 takes 120 s instead of 100, and 30 s of layer 2 are in the chunk: 1.2 × 200 − 30 s follow it.
  progress.begin_chunk(chunk_of({whole(1, 120), part(2, 30)}), 2);
  CHECK(progress.layer(4) == 2);
  CHECK(progress.seconds_left(ahead) == Approx(150 + 210));
  CHECK(100 * 130 / 490.0 < before);
  CHECK(progress.percent(ahead, false) == Approx(before));  // it does not fall
  progress.sent(0.7);
  CHECK(progress.layer(4) == 2);
  progress.sent(0.9);
  CHECK(progress.layer(4) == 3);
  CHECK(progress.seconds_left(ahead) == Approx(15 + 210));
  CHECK(progress.percent(ahead, false) == Approx(100 * 265 / 490.0));
  progress.end_chunk();

  // The rest of layer 2 takes 90 s, so 240 s were measured where 200 s were foretold.
  progress.begin_chunk(chunk_of({whole(2, 90)}), 2);
  CHECK(progress.seconds_left(ahead) == Approx(90 + 120));
  progress.end_chunk();
  progress.begin_chunk(chunk_of({whole(3, 120)}), 2);
  progress.sent(1);
  CHECK(progress.layer(4) == 4);
  CHECK(progress.seconds_left(ahead) == 0);
  progress.end_chunk();
  CHECK(progress.layer(4) == 4);
  CHECK(progress.percent(ahead, true) == 100);
}

TEST_CASE("Without a forecast the other layers take as long as the known ones on average") {
  Progress progress;
  progress.begin_chunk(chunk_of({whole(0, 100)}), 0);
  // 100 s in the chunk and 40 s planned are two layers of 70 s; three are unknown.
  CHECK(progress.seconds_left(unknown(5, {1, 40})) == Approx(100 + 40 + 3 * 70));
  progress.sent(0.25);
  CHECK(progress.seconds_left(unknown(5, {1, 40})) == Approx(75 + 40 + 3 * 70));
  progress.end_chunk();
  CHECK(progress.seconds_left(unknown(5, {0, 0})) == Approx(4 * 100));
  CHECK(progress.percent(unknown(5, {0, 0}), false) == Approx(20));
}

TEST_CASE("Chunks without layers count as layers of their own") {
  Progress progress;
  Chunk strip;
  strip.seconds = 60;
  progress.begin_chunk(strip, 2);
  CHECK(progress.layer(3) == 1);
  CHECK(progress.seconds_left(unknown(3, {2, 40})) == Approx(60 + 40));
  progress.end_chunk();
  CHECK(progress.seconds_left(unknown(3, {1, 30})) == Approx(30 + 45));  // (60 + 30) / 2 for the third
}

TEST_CASE("A resumed print counts the layers before it, while they are repeated and afterwards") {
  Progress progress = Progress::resumed(2);
  const Ahead ahead = expected(5);
  CHECK(progress.has_laid());
  progress.replay(1, 0.25);
  CHECK(progress.layer(5) == 2);
  CHECK(progress.fraction() == 0.25);
  CHECK(progress.seconds_left(ahead) == Approx(400 - 25));
  CHECK(progress.percent(ahead, false) == Approx(25));
  progress.end_replay();
  CHECK(progress.seconds_left(ahead) == Approx(300));
  CHECK(progress.percent(ahead, false) == Approx(40));

  // Layer 2 takes 110 s instead of 100: 1.1 × 200 s follow.
  progress.begin_chunk(chunk_of({whole(2, 110)}), 2);
  CHECK(progress.layer(5) == 3);
  CHECK(progress.seconds_left(ahead) == Approx(110 + 220));
  CHECK(progress.percent(ahead, false) == Approx(40));  // 34 would be a fall
  progress.end_chunk();
  CHECK(progress.seconds_left(ahead) == Approx(220));
  CHECK(progress.percent(ahead, false) == Approx(56));
}

TEST_CASE("A resumed print whose times are not foretold yet claims no percentage") {
  Progress progress = Progress::resumed(2);
  progress.replay(1, 0.5);
  CHECK(progress.layer(5) == 2);
  CHECK(progress.seconds_left(unknown(5, {})) == 0);
  CHECK(progress.percent(unknown(5, {}), false) == 0);
}
