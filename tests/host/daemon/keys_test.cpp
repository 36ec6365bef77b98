// Keys of single programs and requests for them, without a daemon; and the file by which avahi announces it.
#include "host/daemon/keys.hpp"

#include <catch2/catch.hpp>

#include "host/daemon/octoprint.hpp"
#include "host/daemon/refused.hpp"
#include "host/daemon/state_folder.hpp"
#include "host/daemon/upload_kind.hpp"
#include "tests/host/support/temp_folder.hpp"
#include "tests/paths.hpp"

using namespace unicursal;
using namespace std::chrono_literals;
using host::Keys;
using host::Refused;
using host::Right;
using nlohmann::json;

TEST_CASE("keys are kept, and found by their secret only") {
  const test::TempFolder folder;
  std::string first, second;
  {
    Keys keys(folder / "keys.json");
    first = keys.add("slicer", Right::queue).secret;
    second = keys.add("phone", Right::watch).secret;
    CHECK(first != second);
    keys.remove(1);
    CHECK_THROWS_AS(keys.remove(1), Refused);
    CHECK_THROWS_AS(keys.add("", Right::watch), Refused);
    CHECK_THROWS_AS(keys.add(std::string(65, 'a'), Right::watch), Refused);
  }
  Keys again(folder / "keys.json");
  CHECK(again.with_secret(first) == nullptr);
  CHECK(again.with_secret("") == nullptr);
  REQUIRE(again.with_secret(second) != nullptr);
  CHECK(again.with_secret(second)->right == Right::watch);
  CHECK(again.add("other", Right::steer).id == 3);  // numbers are not used again
  folder.write("keys.json", "{\"keys\": 7}");
  CHECK_THROWS_AS(Keys(folder / "keys.json"), host::DaemonError);
}

TEST_CASE("a program that asks no more is forgotten, and a wait ends after ten minutes") {
  const test::TempFolder folder;
  Keys keys(folder / "keys.json");
  auto now = Keys::Clock::now();
  const std::string ticket = keys.request("phone", "192.168.1.5", now);
  CHECK(keys.ask("another", now).fate == Keys::Fate::gone);
  for (int i = 0; i < 3; ++i) CHECK(keys.ask(ticket, now += 25s).fate == Keys::Fate::waits);
  CHECK(keys.requests(now).size() == 1);
  CHECK(keys.requests(now + 31s).empty());
  CHECK_THROWS_AS(keys.grant(1, Right::steer, now + 31s), Refused);

  const std::string patient = keys.request("phone", "", now);
  Keys::Fate fate = Keys::Fate::waits;
  for (int i = 0; i < 23; ++i) fate = keys.ask(patient, now += 25s).fate;
  CHECK(fate == Keys::Fate::waits);
  keys.ask(patient, now += 25s);
  CHECK(keys.ask(patient, now += 25s).fate == Keys::Fate::gone);
  CHECK(keys.all().empty());
}

TEST_CASE("names of uploads are made plain") {
  CHECK(host::kept_name("leaf.stl") == "leaf.stl");
  CHECK(host::kept_name("My Part (2).STL") == "My_Part_2.stl");
  CHECK(host::kept_name("C:\\prints\\leaf.3mf") == "leaf.3mf");
  CHECK(host::kept_name("../../.ssh/leaf.svg") == "leaf.svg");
  CHECK(host::kept_name("-rf.svg") == "rf.svg");
  CHECK(host::kept_name("..svg") == "unnamed.svg");
  CHECK(host::kept_name("W\xc3\xbcrfel.svg") == "W_rfel.svg");
  CHECK(host::kept_name(std::string(200, 'a') + ".svg") == std::string(52, 'a') + ".svg");
  for (const std::string& bad : {std::string(), std::string("svg"), std::string("a."), std::string("a/"),
                                 std::string("a\nb.svg"), std::string("a\0.svg", 6), std::string(256, 'a')})
    CHECK_THROWS_AS(host::kept_name(bad), Refused);
  CHECK(host::upload_kind("a.toml") == host::UploadKind::job);
  CHECK(host::upload_kind("a.3mf") == host::UploadKind::model);
  CHECK(host::upload_kind("a.gcode") == host::UploadKind::gcode);
  CHECK_THROWS_AS(host::upload_kind("a.bgcode"), Refused);
  CHECK_THROWS_AS(host::upload_kind("a.ufp"), Refused);
}

TEST_CASE("what OctoPrint calls a file") {
  CHECK(host::local_name("upload:leaf/leaf.stl") == "leaf.stl");
  CHECK(host::local_name("animals/fish.toml") == "animals/fish.toml");
  CHECK_FALSE(host::local_name("upload:leaf/job.toml"));
  CHECK_FALSE(host::local_name("my fish.toml"));
}

TEST_CASE("states have OctoPrint's words, and nothing unknown is 0") {
  const auto text = [](const json& status, bool there = true) {
    return host::octo::state_text(status, there);
  };
  CHECK(text({{"state", "idle"}}) == "Operational");
  CHECK(text({{"state", "idle"}}, false) == "Offline");
  CHECK(text({{"state", "preparing"}}) == "Starting");
  CHECK(text({{"state", "reconnecting"}, {"print", {{"state", "printing"}}}}) == "Offline");
  for (const auto& [ours, theirs] :
       std::initializer_list<std::pair<const char*, const char*>>{{"heating", "Printing"},
                                                                  {"paused", "Paused"},
                                                                  {"cancelling", "Cancelling"},
                                                                  {"done", "Operational"}})
    CHECK(text({{"state", "printing"}, {"print", {{"state", ours}}}}) == theirs);
  const json job = host::octo::job({{"state", "idle"}}, nullptr, true);
  CHECK(job["progress"]["completion"].is_null());
  CHECK(job["progress"]["printTime"].is_null());
  const json part = {{"state", "printing"},
                     {"job", {{"job", "upload:leaf/leaf.stl"}}},
                     {"print",
                      {{"state", "printing"},
                       {"percent", 12.5},
                       {"elapsed_seconds", 100.4},
                       {"left_seconds", 700.2},
                       {"nozzle", {{"actual_c", 204.5}, {"target_c", 205}}},
                       {"bed", json::object()}}}};
  const json shown = host::octo::job(part, nullptr, true);
  CHECK(shown["job"]["file"]["name"] == "leaf.stl");
  CHECK(shown["job"]["estimatedPrintTime"] == 801);
  CHECK(shown["progress"]["printTimeLeft"] == 700);
  const json printer = host::octo::printer(part, true);
  CHECK(printer["temperature"]["tool0"] == json({{"actual", 204.5}, {"target", 205}, {"offset", 0}}));
  CHECK_FALSE(printer["temperature"].contains("bed"));
}

TEST_CASE("avahi announces the daemon's usual port and the version that it speaks") {
  const std::string file = test::read_text(test::source_folder() / "host/packaging/unicursal.avahi.service");
  CHECK(file.find("<type>_octoprint._tcp</type>\n    <port>8377</port>") != std::string::npos);
  CHECK(file.find("<type>_http._tcp</type>\n    <port>8377</port>") != std::string::npos);
  CHECK(file.find(std::string("version=") + host::octo::spoken_version) != std::string::npos);
}
