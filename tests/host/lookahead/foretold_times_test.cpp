#include "host/lookahead/foretold_times.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <sstream>
#include <thread>

#include "core/error.hpp"
#include "tests/host/support/session_bench.hpp"

namespace unicursal::host {
namespace {

/// Layer k is a square of k + 1 mm, 0.5 mm high; the layer `broken` cannot be cut.
class Steps : public core::Part {
 public:
  explicit Steps(std::size_t broken = SIZE_MAX) : broken_(broken) {}
  std::size_t layer_count() const override { return 10; }
  core::Layer layer(std::size_t index) const override {
    asked = index;
    if (index == broken_) throw core::ModelError("", "z 1", "is open", "close it");
    core::Layer layer;
    layer.index = index;
    layer.height = 0.5;
    const double side = static_cast<double>(index) + 1;
    const core::Polygon outline{{{0, 0}, {side, 0}, {side, side}, {0, side}}, {}};
    layer.islands.push_back({outline, {{0, {outline}}}});
    return layer;
  }
  core::Box extent() const override { return {{0, 0}, {10, 10}}; }
  double height() const override { return 5; }
  const std::vector<core::Zone>& zones() const override { return zones_; }
  const std::vector<std::string>& warnings() const override { return warnings_; }

  mutable std::atomic<std::size_t> asked = SIZE_MAX;  ///< which layer, last

 private:
  std::size_t broken_;
  std::vector<core::Zone> zones_{{"all", {}, 0}};
  std::vector<std::string> warnings_;
};

std::optional<double> awaited(const ForetoldTimes& times, std::size_t begin, std::size_t end) {
  while (!times.between(begin, end)) std::this_thread::yield();
  return times.between(begin, end);
}

/// A pyramid with a square foot of 10 mm, cut off at half its height of 8 mm.
std::string frustum() {
  std::ostringstream stl;
  const double foot[4][3] = {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}};
  const double top[4][3] = {{2.5, 2.5, 4}, {7.5, 2.5, 4}, {7.5, 7.5, 4}, {2.5, 7.5, 4}};
  const auto facet = [&](const double* a, const double* b, const double* c) {
    stl << "facet normal 0 0 0\nouter loop\n";
    for (const double* p : {a, b, c}) stl << "vertex " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
    stl << "endloop\nendfacet\n";
  };
  stl << "solid frustum\n";
  facet(foot[0], foot[2], foot[1]);
  facet(foot[0], foot[3], foot[2]);
  facet(top[0], top[1], top[2]);
  facet(top[0], top[2], top[3]);
  for (int i = 0; i < 4; ++i) {
    const int next = (i + 1) % 4;
    facet(foot[i], foot[next], top[next]);
    facet(foot[i], top[next], top[i]);
  }
  stl << "endsolid frustum\n";
  return stl.str();
}

constexpr const char* frustum_job = R"(printer = "bench.toml"

[part]
file = "frustum.stl"
layer_height = 0.4
bead_width = 1.0
flow = 3.0

[[zone]]
select = "frustum.stl"
mixture = "sea"

[mixture]
sea = [0.6, 0.0, 0.2]
)";

}  // namespace

TEST_CASE("The estimated time of a layer is its volume divided by the flow") {
  const Steps part;
  const ForetoldTimes times(part, 2, 5, 2.0);  // 3², 4², … 7² mm² of 0.5 mm at 2 mm³/s
  CHECK(*awaited(times, 0, 5) == Approx((9 + 16 + 25 + 36 + 49) * 0.5 / 2));
  CHECK(*awaited(times, 1, 3) == Approx((16 + 25) * 0.5 / 2));
  CHECK(*awaited(times, 3, 99) == Approx((36 + 49) * 0.5 / 2));
  CHECK(*awaited(times, 5, 5) == 0);
  CHECK(*awaited(times, 4, 2) == 0);
}

TEST_CASE("If a layer cannot be sliced there is no estimate, and nothing breaks") {
  const Steps part(4);
  const ForetoldTimes times(part, 0, 10, 2.0);
  while (part.asked != 4) std::this_thread::yield();  // the last is sliced first
  CHECK(!times.between(0, 10));
  CHECK(!times.between(8, 10));
}

TEST_CASE("The time that is left of a part that tapers is right from its second layer on") {
  test::SessionBench bench({}, "", {frustum_job, test::sample_profile, "frustum.stl", frustum()});
  std::vector<std::pair<double, double>> told;  // s that have passed, s that are left
  double end = 0;
  bench.print([&](Session& session, const SessionEvent&) {
    const SessionStatus status = session.status();
    if (status.state == SessionState::finishing && end == 0) end = status.elapsed;
    if (status.state != SessionState::printing || status.layer <= 1 || !status.left) return;
    told.emplace_back(status.elapsed, *status.left);
    if (status.layer < 6) CHECK(status.lookahead > 0);  // planned, though the encoder has it
    // Of the layer that is being sent, the end may still be withheld.
    CHECK(status.layer + status.lookahead_layers <= status.layers + 1);
  });
  REQUIRE(told.size() > 20);
  const double whole = end - told.front().first;
  for (const auto& [passed, left] : told) CHECK(passed + left == Approx(end).margin(0.05 * whole));
}

}  // namespace unicursal::host
