// The line of a print as it is followed, against what a simulated printer has really laid.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <set>

#include "host/daemon/live_json.hpp"
#include "host/live/line_reader.hpp"
#include "host/spool/chunk_reader.hpp"
#include "tests/firmware_gcode/support/sliced_block.hpp"
#include "tests/host/support/line_bench.hpp"

using namespace unicursal;
using test::LineBench;
using test::SimBead;

namespace {

/// A record of the binary format, read from the description in API.md alone.
struct Record {
  core::Vec2 from{0, 0}, to{0, 0};  ///< mm
  double width = 0;
  int asked = 0, r = 0, g = 0, b = 0;
};
struct DecodedPath {
  std::uint32_t layer = 0, first = 0, count = 0;
  float top = 0;
  bool complete = false, planned = false;
  std::vector<Record> records;
};

std::uint32_t word(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes.at(at + i));
  return value;
}

DecodedPath decoded(const std::string& bytes) {
  REQUIRE(bytes.size() >= 32);
  REQUIRE(bytes.substr(0, 4) == "UCL1");
  DecodedPath path{word(bytes, 4), word(bytes, 8), word(bytes, 12), 0, false, false, {}};
  const std::uint32_t top = word(bytes, 24);
  std::memcpy(&path.top, &top, 4);
  path.complete = (bytes[28] & 1) != 0;
  path.planned = (bytes[28] & 2) != 0;
  REQUIRE(bytes.size() == 32 + 9 * path.count);
  const auto signed_word = [&](std::size_t at) { return static_cast<std::int32_t>(word(bytes, at)); };
  core::Vec2 at(signed_word(16) / 1000.0, signed_word(20) / 1000.0);
  for (std::size_t i = 32; i < bytes.size(); i += 9) {
    const auto byte = [&](std::size_t k) {
      return static_cast<int>(static_cast<unsigned char>(bytes[i + k]));
    };
    const auto step = [&](std::size_t k) {
      const int value = byte(k) + 256 * byte(k + 1);
      return (value < 32768 ? value : value - 65536) / 100.0;
    };
    const core::Vec2 to = at + core::Vec2(step(0), step(2));
    path.records.push_back({at, to, byte(4) / 50.0, byte(5), byte(6), byte(7), byte(8)});
    at = to;
  }
  return path;
}

DecodedPath path_of(const LineBench& bench, std::size_t layer, std::size_t from = 0) {
  const auto piece = bench.live->path(layer, from);
  REQUIRE(piece);
  return decoded(host::to_bytes(*piece));
}

/// A moment of a print.
struct Moment {
  double time = 0;  ///< printer seconds
  host::LiveNozzle nozzle;
};

double seconds_of(host::TimePoint time) {
  return std::chrono::duration<double>(time.time_since_epoch()).count();
}

double distance(const core::Vec2& place, const SimBead& bead) {
  const core::Vec2 way = bead.to - bead.from;
  const double part = std::clamp((place - bead.from).dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (bead.from + part * way - place).norm();
}

/// The shares that the simulator's own chamber has let out at a place of a bead: those of its pieces count
/// for their middles.
std::vector<double> shares_at(const std::vector<SimBead>& laid, std::size_t index, const core::Vec2& place) {
  const SimBead& bead = laid[index];
  const core::Vec2 way = bead.to - bead.from;
  const double part = std::clamp((place - bead.from).dot(way) / way.squaredNorm(), 0.0, 1.0);
  const std::size_t other =
      part < 0.5 ? index - std::min<std::size_t>(index, 1) : std::min(index + 1, laid.size() - 1);
  const double gap = (bead.volume + laid[other].volume) / 2;
  const double weight = gap > 0 ? std::abs(part - 0.5) * bead.volume / gap : 0;
  std::vector<double> shares = bead.shares;
  for (std::size_t f = 0; f < shares.size(); ++f) shares[f] += weight * (laid[other].shares[f] - shares[f]);
  return shares;
}

/// How far the shares that are shown are from the simulator's at the same place, at worst; `count`: the
/// moments that were compared.
double worst_share(const std::vector<Moment>& moments, const std::vector<SimBead>& laid, std::size_t& count) {
  double worst = 0;
  count = 0;
  for (const Moment& moment : moments) {
    if (!moment.nozzle.layer) continue;
    std::optional<std::size_t> nearest;
    for (std::size_t i = 0; i < laid.size(); ++i) {
      if (std::abs(laid[i].z - moment.nozzle.z) > 1e-3 || laid[i].from == laid[i].to) continue;
      if (!nearest || distance(moment.nozzle.at, laid[i]) < distance(moment.nozzle.at, laid[*nearest]))
        nearest = i;
    }
    if (!nearest || distance(moment.nozzle.at, laid[*nearest]) > 0.01) continue;
    ++count;
    const std::vector<double> shares = shares_at(laid, *nearest, moment.nozzle.at);
    for (std::size_t f = 0; f < shares.size(); ++f)
      worst = std::max(worst, std::abs(shares[f] - moment.nozzle.leaving.shares[f]));
  }
  return worst;
}

/// How far the nozzle that is shown is from the simulator's at the same time, mm: the mean and the worst.
std::pair<double, double> place_errors(const std::vector<Moment>& moments, const std::vector<SimBead>& laid) {
  double sum = 0, worst = 0;
  std::size_t count = 0;
  for (const Moment& moment : moments) {
    const auto bead = std::find_if(laid.begin(), laid.end(), [&](const SimBead& one) {
      return one.start <= moment.time && moment.time <= one.end && one.from != one.to;
    });
    if (bead == laid.end()) continue;
    const double part = (moment.time - bead->start) / std::max(bead->end - bead->start, 1e-9);
    const double off = (bead->from + part * (bead->to - bead->from) - moment.nozzle.at).norm();
    sum += off;
    worst = std::max(worst, off);
    ++count;
  }
  return {count > 0 ? sum / static_cast<double>(count) : 0, worst};
}

std::vector<SimBead> of_layer(const std::vector<SimBead>& laid, double z) {
  std::vector<SimBead> layer;
  for (const SimBead& bead : laid)
    if (std::abs(bead.z - z) < 1e-3 && bead.from != bead.to) layer.push_back(bead);
  return layer;
}

/// The path of a layer is what the simulator has laid: as long, in the same order, at the same places, with
/// as much plastic.
void check_layer(const DecodedPath& path, const std::vector<SimBead>& laid, double height) {
  double length = 0, volume = 0, laid_length = 0, laid_volume = 0, farthest = 0;
  auto bead = laid.begin();
  for (const Record& record : path.records) {
    if (record.width == 0) continue;
    length += (record.to - record.from).norm();
    volume += (record.to - record.from).norm() * record.width * height;
    // In order: the bead that goes on where this record ends is this one or a later one.
    auto near = bead;
    while (near != laid.end() && distance(record.to, *near) > 0.02 && near - bead < 4000) ++near;
    if (near == laid.end()) near = bead;
    farthest = std::max(farthest, distance(record.to, *near));
    bead = near;
  }
  for (const SimBead& one : laid) {
    laid_length += (one.to - one.from).norm();
    laid_volume += one.volume;
  }
  CHECK(farthest < 0.1);  // a motor step is 0.0125 mm; the simulator leaves out beads without a step of E
  CHECK(laid.end() - bead < 3);
  CHECK(length == Approx(laid_length).epsilon(0.003));
  CHECK(volume == Approx(laid_volume).epsilon(0.03));
}

std::vector<Moment> followed(LineBench& bench, const LineBench::Script& more = {}) {
  std::vector<Moment> moments;
  const auto result =
      bench.print([&](LineBench& of, host::Session& session, const host::SessionEvent& event) {
        if (more) more(of, session, event);
        if (event.kind != host::SessionEvent::Kind::progress) return;
        if (const auto nozzle = of.nozzle(session)) moments.push_back({seconds_of(of.clock->now()), *nozzle});
      });
  INFO(result.reason);
  CHECK(result.ending == host::Ending::completed);
  return moments;
}

}  // namespace

TEST_CASE("what is shown to leave the nozzle is what the simulator's chamber lets out there", "[optimised]") {
  const std::string personality = GENERATE("marlin", "marlin-advanced-ok", "repetier", "reprapfirmware");
  const std::string firmware = personality.starts_with("marlin") ? "marlin" : personality;
  CAPTURE(personality);
  std::string profile = test::sample_profile;
  profile.replace(profile.find("\"marlin\""), 8, "\"" + firmware + "\"");
  std::string job = test::sample_job;
  job.replace(job.find("height = 0.4"), 12, "height = 0.8");
  LineBench bench(job, {"--personality", personality}, profile);
  const auto moments = followed(bench);
  const auto laid = bench.laid();
  std::size_t count = 0;
  CHECK(worst_share(moments, laid, count) < 0.01);
  CHECK(count >= 100);
  const auto [mean, worst] = place_errors(moments, laid);
  CAPTURE(mean, worst);
  CHECK(mean < 4);
  for (std::size_t layer = 0; layer < 4; ++layer) {
    const DecodedPath path = path_of(bench, layer);
    CHECK(path.complete);
    check_layer(path, of_layer(laid, static_cast<double>(path.top)), 0.2);
  }
}

TEST_CASE("a pause and another flow shift what leaves the nozzle, and nothing is shown twice",
          "[optimised]") {
  LineBench bench;
  int events = 0;
  const auto moments =
      followed(bench, [&](LineBench&, host::Session& session, const host::SessionEvent& event) {
        const host::SessionState state = session.status().state;
        if (event.kind == host::SessionEvent::Kind::state && state == host::SessionState::paused)
          session.resume();
        if (event.kind != host::SessionEvent::Kind::progress || state != host::SessionState::printing) return;
        ++events;
        if (events == 5 || events == 12) CHECK(!session.pause());
        if (events == 9) CHECK(!session.set_flow(115));
      });
  CHECK(events > 12);
  const auto laid = bench.laid();
  std::size_t count = 0;
  CHECK(worst_share(moments, laid, count) < 0.01);
  CHECK(count > 20);
  for (std::size_t layer = 0; layer < 2; ++layer) {
    const DecodedPath path = path_of(bench, layer);
    check_layer(path, of_layer(laid, static_cast<double>(path.top)), 0.2);
  }
  REQUIRE(bench.live->path(0, 0));
  CHECK(bench.live->path(0, 0)->revision > 0);
}

TEST_CASE("the line of a slicer's file is followed, too", "[optimised]") {
  gcode::test::BlockOptions options;
  options.layers = 3;
  LineBench bench(R"(printer = "bench.toml"

[part]
file = "block.gcode"

[[zone]]
select = "T0"
mixture = "sea"

[[zone]]
select = "T1"
mixture = "sun"

[mixture]
sea = [1.0, 0.0, 0.0]
sun = [0.0, 1.0, 1.0]
)",
                  {}, test::sample_profile, {{"block.gcode", gcode::test::sliced_block(options).text}});
  const auto moments = followed(bench);
  const auto laid = bench.laid();
  std::size_t count = 0;
  CHECK(worst_share(moments, laid, count) < 0.01);
  CHECK(count > 20);
  const auto known = bench.live->overview().known;
  REQUIRE(known.size() == 3);
  std::set<int> asked;
  for (std::size_t layer = 0; layer < 3; ++layer) {
    const DecodedPath path = path_of(bench, layer);
    const auto beads = of_layer(laid, static_cast<double>(path.top));
    double length = 0, laid_length = 0;
    for (const Record& record : path.records) {
      if (record.width == 0) continue;
      length += (record.to - record.from).norm();
      asked.insert(record.asked);
    }
    for (const SimBead& bead : beads) laid_length += (bead.to - bead.from).norm();
    CHECK(length == Approx(laid_length).epsilon(0.005));
  }
  CHECK(asked.contains(0));
  CHECK(asked.contains(1));
}

TEST_CASE("a print that continues shows the layers of its spool once, and goes on behind them",
          "[optimised]") {
  LineBench bench;
  followed(bench);
  std::vector<host::SpooledChunk> chunks;
  host::ChunkReader reader(bench.spool->chunks());
  while (auto chunk = reader.next()) chunks.push_back(std::move(*chunk));
  REQUIRE(chunks.size() >= 4);
  host::LiveSubject subject = bench.subject();
  host::LiveSubject::Kept kept{bench.spool->chunks(), chunks.size() - 2, {}, 0};
  std::uint64_t lines = 0;
  for (std::size_t i = 0; i < kept.count; ++i) lines += chunks[i].lines.size();
  kept.leg.begins_at = lines - 40;
  host::LineReader place(subject.printer);
  std::uint64_t line = 0;
  for (const host::SpooledChunk& chunk : chunks)
    for (const std::string& one : chunk.lines)
      if (line++ < kept.leg.begins_at) place.read(one);
  const std::string back = fmt::format("G0 X{:.3f} Y{:.3f}", place.place()->x(), place.place()->y());
  kept.leg.lead_in = {"G28", "M83", "G1 Z5 F600", "G0 X5 Y5 F6000", "G1 E3 F100", "G1 X50 E2 F600", back};
  kept.executed = kept.leg.begins_at;
  subject.kept = kept;
  host::LiveLine again(subject);
  for (std::size_t i = kept.count; i < chunks.size(); ++i) {
    gcode::Chunk made;
    made.lines = chunks[i].lines;
    again.chunk_kept(chunks[i], made);
  }
  again.wait();
  const auto known = again.overview().known;
  REQUIRE(known.size() == 2);
  for (const host::KnownLayer& layer : known) {
    CHECK(layer.complete);
    const DecodedPath first = path_of(bench, layer.layer);
    const DecodedPath second = decoded(host::to_bytes(*again.path(layer.layer, 0)));
    double length = 0, again_length = 0;
    for (const Record& one : first.records) length += one.width > 0 ? (one.to - one.from).norm() : 0;
    for (const Record& one : second.records) again_length += one.width > 0 ? (one.to - one.from).norm() : 0;
    CHECK(again_length == Approx(length).epsilon(0.003));
    CHECK((first.records.back().to - second.records.back().to).norm() < 0.011);
  }
}

TEST_CASE("a path can be read from any bead on, and ends where the whole ends", "[optimised]") {
  LineBench bench;
  followed(bench);
  const DecodedPath whole = path_of(bench, 0);
  REQUIRE(whole.count > 100);
  const DecodedPath tail = path_of(bench, 0, whole.count - 7);
  REQUIRE(tail.count == 7);
  CHECK(tail.first == whole.count - 7);
  for (std::size_t i = 0; i < 7; ++i) {
    const Record& a = whole.records[whole.count - 7 + i];
    const Record& b = tail.records[i];
    CHECK((a.from - b.from).norm() < 1e-6);
    CHECK((a.to - b.to).norm() < 1e-6);
    CHECK((a.r == b.r && a.g == b.g && a.b == b.b && a.asked == b.asked && a.width == b.width));
  }
  CHECK(path_of(bench, 0, whole.count).count == 0);
  CHECK(path_of(bench, 0, whole.count + 1).count == 0);
  CHECK_FALSE(bench.live->path(7, 0));
  const auto [asked, arrived] = [&] {
    std::size_t known = 0, same = 0;
    const auto mixtures = bench.live->overview().mixtures;
    for (const Record& record : whole.records) {
      if (record.width == 0 || record.asked >= static_cast<int>(mixtures.size())) continue;
      const picture::Colour& want = mixtures[static_cast<std::size_t>(record.asked)].colour;
      ++known;
      same += std::abs(want.r - record.r) + std::abs(want.g - record.g) + std::abs(want.b - record.b) < 60;
    }
    return std::pair(known, same);
  }();
  CHECK(asked > whole.count / 2);
  CHECK(arrived > asked * 8 / 10);  // the rest lies at the border
}
