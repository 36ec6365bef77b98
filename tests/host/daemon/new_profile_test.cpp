// A profile that a client makes for a daemon that has none yet.
#include <catch2/catch.hpp>

#include "tests/host/support/daemon_process.hpp"

using namespace unicursal;
using nlohmann::json;
using test::DaemonBench;

namespace {

const json red{{"name", "red"}, {"material", "PETG"}, {"colour", "#d63430"}};
const json wanted{{"frame", "diamond-0.6"}, {"name", "My \"Diamond\""}, {"filaments", {red, red, red}}};

class ProfileBench : public DaemonBench {
 public:
  ProfileBench() { setenv("XDG_CONFIG_HOME", path("config").c_str(), 1); }
  ~ProfileBench() { unsetenv("XDG_CONFIG_HOME"); }
  std::string make(const json& body) const { return send(request("POST", "/api/profile/new", body.dump())); }
};

}  // namespace

TEST_CASE("a profile is made from a shipped one, and used at once") {
  ProfileBench bench;
  bench.serve();
  CHECK(bench.status(bench.request("GET", "/api/profile")) == 404);
  json unknown = wanted, wrong = wanted;
  unknown["frame"] = "../diamond-0.6";
  wrong["filaments"][0]["colour"] = "reddish";
  CHECK(test::status_of(bench.make(unknown)) == 404);
  CHECK(test::status_of(bench.make(wrong)) == 422);
  CHECK(bench.status(bench.request("GET", "/api/profile")) == 404);  // neither has left one
  const std::string made = bench.make(wanted);
  INFO(made);
  CHECK(test::status_of(made) == 201);
  const json profile = bench.ask("GET", "/api/profile");
  CHECK(made.find(profile["file"].get<std::string>()) != std::string::npos);
  CHECK(profile["file"].get<std::string>().starts_with(bench.path("config")));
  const json printer = bench.ask("GET", "/api/printer");
  CHECK(printer["name"] == "My \"Diamond\"");
  CHECK(printer["filaments"][0]["material"] == "PETG");
  CHECK(test::status_of(bench.make(wanted)) == 409);
  json again = wanted;
  again["name"] = "Another";
  again["replace"] = true;
  CHECK(test::status_of(bench.make(again)) == 201);
  CHECK(bench.ask("GET", "/api/printer")["name"] == "Another");
}

TEST_CASE("a daemon that was given a profile makes no other, and says what to do") {
  ProfileBench bench;
  bench.serve({"--profile", bench.path("jobs/bench.toml.profile")});
  const std::string refused = bench.make(wanted);
  CHECK(test::status_of(refused) == 409);
  CHECK(refused.find("change that profile, or start the daemon without it") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(bench.path("config")));
}
