// What is no longer wanted ends soon, and files that are hostile or hopeless do no harm: real daemons.
#include <catch2/catch.hpp>

#include <chrono>
#include <fstream>
#include <map>
#include <memory>

#include "tests/host/support/daemon_process.hpp"

using namespace unicursal;
using nlohmann::json;
using test::DaemonBench;
using test::Outcome;
namespace fs = std::filesystem;

namespace {

using SteadyClock = std::chrono::steady_clock;

double seconds_since(SteadyClock::time_point then) {
  return std::chrono::duration<double>(SteadyClock::now() - then).count();
}

/// Whether the daemon ends in time; its exit code must be 0.
void check_ends(DaemonBench& bench, double within) {
  const auto asked = SteadyClock::now();
  kill(bench.daemon().id(), SIGTERM);
  CHECK(bench.daemon().wait().code == 0);
  CHECK(seconds_since(asked) < within);
  CHECK_FALSE(fs::exists(bench.path("state/address")));
}

int add(const DaemonBench& bench, const std::string& job) {
  const Outcome added = bench.command({"queue", "--add", job});
  INFO(added.err);
  REQUIRE(added.code == 0);
  return std::stoi(added.out);
}

std::string state_of(const DaemonBench& bench, int id) {
  return bench.ask("GET", "/api/jobs/" + std::to_string(id)).value("state", "");
}

void write_job(const DaemonBench& bench, const std::string& name, const std::string& drawing,
               const std::string& bead = "1.0") {
  std::string job = test::replaced(test::sample_job, "bench.toml", "bench.toml.profile");
  job = test::replaced(test::replaced(job, "plate.svg", name + ".svg"), "bead_width = 1.0",
                       "bead_width = " + bead);
  bench.folder().write("jobs/" + name + ".toml", job);
  bench.folder().write("jobs/" + name + ".svg", drawing);
}

std::string drawing_of(const std::string& shapes, const std::string& size) {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + size + "mm\" height=\"" + size +
         "mm\" viewBox=\"0 0 " + size + " " + size + "\">" + shapes + "</svg>";
}

constexpr const char* mesh_job = R"(printer = "profile.toml"

[part]
file = "a.stl"
layer_height = 0.4
bead_width = 1.0
flow = 3.0

[[zone]]
select = "a.stl"
mixture = "sea"

[mixture]
sea = [0.6, 0.0, 0.2]
)";

/// Of which every one crosses hundreds of others.
std::string overlapping_circles(int count) {
  std::string shapes = "<rect width=\"9\" height=\"9\" fill=\"#ff0000\"/>";
  for (int i = 0; i < count; ++i) {
    const double x = 20 + (i * 7919 % 6000) / 100.0, y = 20 + (i * 104729 % 6000) / 100.0;
    shapes += "<circle cx=\"" + std::to_string(x) + "\" cy=\"" + std::to_string(y) +
              "\" r=\"15\" fill=\"#0000ff\"/>";
  }
  return drawing_of(shapes, "100");
}

std::string plate(const std::string& size) {
  return drawing_of("<rect width=\"" + size + "\" height=\"" + size +
                        "\" fill=\"#0000ff\"/><rect width=\"9\" " + "height=\"9\" fill=\"#ff0000\"/>",
                    size);
}

long peak_megabytes(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string word; status >> word;) {
    long kilobytes = 0;
    if (word == "VmHWM:" && status >> kilobytes) return kilobytes / 1024;
  }
  return -1;
}

}  // namespace

TEST_CASE("an idle daemon ends at once, and asks systemd for no time") {
  DaemonBench bench;
  bench.serve();
  check_ends(bench, 3);
}

TEST_CASE("a preparation that never ends is cancelled at once, and does not hold up the daemon's end") {
  DaemonBench bench;
  write_job(bench, "circles", overlapping_circles(20000));
  bench.start_printer("0");
  bench.serve();
  const int hopeless = add(bench, "circles.toml"), sound = add(bench, "plate.toml");
  REQUIRE(bench.ask("POST", "/api/print/start")["id"] == hopeless);
  poll(nullptr, 0, 500);  // it is well inside the union of the circles
  REQUIRE(state_of(bench, hopeless) == "preparing");
  const auto cancelled = SteadyClock::now();
  CHECK(bench.command({"cancel"}).code == 0);
  bench.await_job(hopeless, "stopped");
  REQUIRE(bench.command({"start", std::to_string(sound)}).code == 0);
  CHECK(seconds_since(cancelled) < 30);
  bench.await_print("printing");
  bench.command({"cancel"});
  bench.await_job(sound, "stopped");
  REQUIRE(bench.ask("POST", "/api/jobs", "{\"job\": \"circles.toml\"}")["id"] == 3);
  REQUIRE(bench.ask("POST", "/api/print/start")["id"] == 3);
  check_ends(bench, 4);
}

TEST_CASE("a large job that is cancelled while it is planned makes way for the next one") {
  DaemonBench bench;
  write_job(bench, "large", plate("99"), "0.4");
  bench.start_printer("100");
  bench.serve();
  const int large = add(bench, "large.toml"), next = add(bench, "plate.toml");
  REQUIRE(bench.command({"start"}).code == 0);
  bench.await_print("printing");  // hot, and waits for its first layer
  CHECK(bench.command({"cancel"}).code == 0);
  bench.await_job(large, "stopped");
  const auto stopped = SteadyClock::now();
  REQUIRE(bench.command({"start", std::to_string(next)}).code == 0);
  CHECK(seconds_since(stopped) < 4);
  bench.await_print("printing");
  check_ends(bench, 60);  // it parks and cools
}

TEST_CASE("a job that is cancelled while its print is being made leaves nothing in the spool") {
  DaemonBench bench;
  write_job(
      bench, "long",
      test::replaced(test::sample_drawing, "</svg>", "<!--" + std::string(60'000'000, ' ') + "--></svg>"));
  bench.start_printer("0");
  bench.serve();
  const int id = add(bench, "long.toml");
  REQUIRE(bench.ask("POST", "/api/print/start")["id"] == id);
  test::await([&] { return fs::exists(bench.path("spool")) && !fs::is_empty(bench.path("spool")); },
              bench.daemon());
  bench.ask("POST", "/api/print/cancel");
  bench.await_job(id, "stopped");
  CHECK(fs::is_empty(bench.path("spool")));
}

TEST_CASE("uploads that would take all memory or all time are refused with a sentence, or planned") {
  struct Hostile {
    const char* name;
    std::string job, model_name, model;
  };
  const std::string job = test::replaced(test::sample_job, "bench.toml", "profile.toml");
  std::string ids = "<g id=\"" + std::string(10'000'000, 'x') + "\">";
  for (int i = 0; i < 3000; ++i)
    ids += "<rect x=\"" + std::to_string(i % 50) + "\" y=\"" + std::to_string(i / 50) +
           "\" width=\"1\" height=\"1\" fill=\"#0000ff\"/>";
  std::string facets(84, '\0');
  facets.replace(80, 4, "\xff\xff\xff\xff");
  std::string dots = "a";
  for (int i = 0; i < 1'000'000; ++i) dots += ".a";
  const Hostile all[] = {
      {"dots", dots + " = 1\n", "plate.svg", test::sample_drawing},
      {"ids", job, "plate.svg",
       drawing_of(ids + "</g><rect y=\"61\" width=\"9\" height=\"9\" fill=\"#ff0000\"/>", "70")},
      {"circles", job, "plate.svg", overlapping_circles(20000)},
      {"facets", mesh_job, "a.stl", facets},
  };
  DaemonBench bench;
  bench.serve({"--check-memory", "512", "--check-time", "8"});
  const long before = peak_megabytes(bench.daemon().id());
  for (const Hostile& hostile : all) {
    INFO(hostile.name);
#ifdef __SANITIZE_ADDRESS__
    if (hostile.name == std::string("ids")) continue;  // memory is not limited in this build
#endif
    const std::string folder = std::string("/api/files/") + hostile.name + "/";
    REQUIRE(bench.status(bench.request("PUT", folder + "job.toml", hostile.job)) == 201);
    REQUIRE(bench.status(bench.request("PUT", folder + "profile.toml", test::sample_profile)) == 201);
    REQUIRE(bench.status(bench.request("PUT", folder + hostile.model_name, hostile.model)) == 201);
    const auto asked = SteadyClock::now();
    const std::string answer = bench.send(bench.request(
        "POST", "/api/jobs", std::string(R"({"job": "upload:)") + hostile.name + R"(/job.toml"})"));
    INFO(answer);
    CHECK((test::status_of(answer) == 422 || test::status_of(answer) == 201));
    if (test::status_of(answer) == 422) CHECK(answer.find("; ") != std::string::npos);  // with a remedy
    CHECK(seconds_since(asked) < 12);
  }
  CHECK(peak_megabytes(bench.daemon().id()) < before + 100);  // the bytes of an upload, and no more
}

TEST_CASE("no more than two jobs are checked at once, so that a running print keeps its computer") {
  DaemonBench bench;
  bench.start_printer("0");
  bench.serve({"--check-time", "3"});
  for (const auto& [name, text] : {std::pair<std::string, std::string>{"job.toml", test::sample_job},
                                   {"bench.toml", test::sample_profile},
                                   {"plate.svg", overlapping_circles(20000)}})
    REQUIRE(bench.status(bench.request("PUT", "/api/files/slow/" + name, text)) == 201);
  std::vector<std::unique_ptr<test::RawConnection>> clients;
  std::map<int, int> answers;
  for (int i = 0; i < 5; ++i) {
    clients.push_back(std::make_unique<test::RawConnection>(bench.port()));
    clients.back()->send(bench.request("POST", "/api/jobs", "{\"job\": \"upload:slow/job.toml\"}"));
  }
  for (const auto& client : clients) ++answers[test::status_of(client->read_all())];
  CHECK(answers == std::map<int, int>{{409, 3}, {422, 2}});
  CHECK(bench.status(bench.request("POST", "/api/jobs", "{\"job\": \"plate.toml\"}")) == 201);
}
