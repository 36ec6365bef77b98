// `unicursal load`, `purge` and `unload` on the simulated printer: the program itself.
#include <poll.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "host/feeding/feeding.hpp"
#include "tests/host/support/child_process.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal {
namespace {

using Catch::Matchers::Contains;
using test::Child;
using test::Outcome;

constexpr double feeder_steps_per_mm = 400;  // of the simulated printer
constexpr double floor_share = 0.02;         // the profile's default
/// mm that another feeder turns while one moves 1 mm.
constexpr double others_turn = floor_share / (1 - 2 * floor_share);

std::string profile_of(const std::string& firmware, const std::string& extruder = "") {
  return test::replaced(test::sample_profile, "\"marlin\"", "\"" + firmware + "\"") + extruder;
}

/// A printer with a profile of its own.
class Workshop {
 public:
  explicit Workshop(const std::string& profile, const std::string& speed = "0",
                    const std::vector<std::string>& more = {})
      : profile_(folder_.write("bench.toml", profile).string()) {
    std::vector<std::string> words{"simulate",       "--profile", profile_,       "--link",      path("port"),
                                   "--speed",        speed,       "--transcript", path("lines"), "--report",
                                   path("seen.json")};
    words.insert(words.end(), more.begin(), more.end());
    printer_ = std::make_unique<Child>(words);
    wait_for(*printer_, [this] { return std::filesystem::exists(path("port")); });
  }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::vector<std::string> words(const std::string& command,
                                 const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all{command, profile_, "--port", path("port"), "--yes"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  std::vector<std::string> lines() const {
    std::vector<std::string> all;
    std::istringstream text(test::read_text(path("lines")));
    for (std::string line; std::getline(text, line);) all.push_back(line);
    return all;
  }
  /// Ends the printer.
  void switch_off() {
    kill(printer_->id(), SIGTERM);
    REQUIRE(printer_->wait().code == 0);
    seen_ = nlohmann::json::parse(test::read_text(path("seen.json")));
  }
  double turned(std::size_t feeder) const {
    return seen_["not_printed"]["feeder_steps"][feeder].get<double>() / feeder_steps_per_mm;
  }
  const nlohmann::json& seen() const { return seen_; }

  template <class Condition>
  static void wait_for(const Child& child, Condition condition) {
    while (!condition()) {
      REQUIRE(child.running());
      poll(nullptr, 0, 2);
    }
  }

 private:
  test::TempFolder folder_;
  std::string profile_;
  std::unique_ptr<Child> printer_;
  nlohmann::json seen_;
};

bool catches(pid_t process, int signal) {
  const std::string status = test::read_text("/proc/" + std::to_string(process) + "/status");
  const std::size_t mask = status.find("SigCgt:");
  return mask != std::string::npos && std::stoull(status.substr(mask + 7), nullptr, 16) >> (signal - 1) & 1;
}

bool feeds(const std::string& line) {
  return line.starts_with("G1 ") && line.find('E') != std::string::npos;
}

/// Nothing was fed cold, nothing heats any more, and nobody has heated the bed.
void check_left_safe(Workshop& shop) {
  shop.switch_off();
  CHECK(shop.seen()["temperatures"]["nozzle"]["target"] == 0);
  CHECK(shop.seen()["warnings"].empty());
  const std::vector<std::string> lines = shop.lines();
  const auto hot = std::find(lines.begin(), lines.end(), "M109 S210");
  CHECK(std::none_of(lines.begin(), hot, feeds));
  for (const std::string& line : lines) {
    if (line != "M140 S0") CHECK_FALSE((line.starts_with("M140") || line.starts_with("M190")));
  }
}

}  // namespace

TEST_CASE("load turns one feeder as far as asked, and the others by their floor share") {
  for (const std::string firmware : {"marlin", "repetier", "reprapfirmware"}) {
    CAPTURE(firmware);
    Workshop shop(profile_of(firmware));
    const Outcome outcome = test::run(shop.words("load", {"--feeder", "2", "--length", "30"}));
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.out, Contains("feeder 2 has fed 30 mm; the nozzle cools\n"));
    check_left_safe(shop);
    CHECK(shop.turned(1) == Approx(30).epsilon(0.01));
    for (const std::size_t other : {0, 2}) CHECK(shop.turned(other) == Approx(30 * others_turn).margin(0.05));
  }
}

TEST_CASE("purge turns every feeder in turn, and then all together", "[optimised]") {
  for (const std::string firmware : {"marlin", "repetier", "reprapfirmware"}) {
    CAPTURE(firmware);
    Workshop shop(profile_of(firmware));
    const Outcome outcome = test::run(shop.words("purge", {"--length", "12"}));
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    check_left_safe(shop);
    for (std::size_t f = 0; f < 3; ++f)
      CHECK(shop.turned(f) == Approx(12 * (1 + 2 * others_turn + 1.0 / 3)).epsilon(0.01));
  }
}

TEST_CASE("unload pulls one feeder only, after a tip was formed", "[optimised]") {
  for (const std::string firmware : {"marlin", "repetier", "reprapfirmware"}) {
    CAPTURE(firmware);
    Workshop shop(profile_of(firmware));
    const Outcome outcome = test::run(shop.words("unload", {"--feeder", "3"}));
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.out, Contains("feeder 3 has pulled 100 mm back"));
    check_left_safe(shop);
    const double tip = 5.0 / 3;
    CHECK(shop.turned(2) == Approx(tip - 100).epsilon(0.01));
    for (std::size_t other : {0, 1}) CHECK(shop.turned(other) == Approx(tip).margin(0.05));
  }
}

TEST_CASE("a feeder that slips turns farther, so that as much filament is moved") {
  Workshop shop(profile_of("marlin", "flow_factors = [1.1, 1, 0.95]\n"));
  CHECK(test::run(shop.words("load", {"--feeder", "1", "--length", "30"})).code == 0);
  check_left_safe(shop);
  CHECK(shop.turned(0) == Approx(33).epsilon(0.01));
  CHECK(shop.turned(2) == Approx(0.95 * 30 * others_turn).margin(0.05));
}

TEST_CASE("the way through a tube of known length is fast, except for its end") {
  const test::TempFolder folder;
  host::Profile profile = host::load_profile(folder.write("bench.toml", profile_of("marlin")));
  const auto seconds = [&](host::FeedingKind kind) { return host::feeding({kind, 1, {}}, profile); };
  // 5 mm³/s are the profile's most; the retraction takes no time that counts.
  const double slow = 2.5 / 2.405, share = 1 - 2 * floor_share;
  CHECK(seconds(host::FeedingKind::load).length == 60);
  CHECK(seconds(host::FeedingKind::load).seconds == Approx(60 / share / slow).epsilon(0.01));
  profile.tube_length = 430;
  CHECK(seconds(host::FeedingKind::load).length == 490);
  CHECK(seconds(host::FeedingKind::load).seconds ==
        Approx(400 / share / 20 + 90 / share / slow).epsilon(0.01));
  // 2.5 mm³/s of the others have to melt, whatever goes through the tube.
  profile.printer.floor_share = 0.1;
  CHECK(seconds(host::FeedingKind::load).seconds ==
        Approx(400 / 0.8 / (slow / 0.2) + 90 / 0.8 / slow).epsilon(0.01));
  CHECK(seconds(host::FeedingKind::unload).length == 510);
  CHECK(seconds(host::FeedingKind::purge).length == 20);
}

TEST_CASE("Ctrl-C cools the nozzle: while it heats nothing is fed, later not all", "[optimised]") {
  const bool hot = GENERATE(false, true);
  CAPTURE(hot);
  Workshop shop(profile_of("marlin"), hot ? "400" : "100");
  Child child(shop.words("load", {"--feeder", "1", "--length", "2000"}));
  const std::string sign = hot ? "\nG1 E" : "\nM109 S210";
  Workshop::wait_for(child,
                     [&] { return test::read_text(shop.path("lines")).find(sign) != std::string::npos; });
  kill(child.id(), SIGINT);
  const Outcome outcome = child.wait();
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 3);
  CHECK_THAT(outcome.out, Contains("stopped; the nozzle cools"));
  check_left_safe(shop);
  CHECK(shop.turned(0) < (hot ? 1900 : 1e-9));
}

TEST_CASE("a nozzle whose cable was pulled is switched off when the printer is back", "[optimised]") {
  Workshop shop(profile_of("marlin"), "400", {"--fault", "disconnect:20@line=40"});
  const Outcome outcome = test::run(shop.words("load", {"--feeder", "1", "--length", "200"}));
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 1);
  CHECK_THAT(outcome.err, Contains("plug it in again") && Contains("the printer is back, and it cools"));
  check_left_safe(shop);
  CHECK(shop.turned(0) < 150);
}

TEST_CASE("who ends the waiting for a printer whose cable was pulled reads that it may be hot",
          "[optimised]") {
  Workshop shop(profile_of("marlin"), "400", {"--fault", "disconnect@line=40"});
  Child child(shop.words("load", {"--feeder", "1", "--length", "200"}));
  Workshop::wait_for(child, [&] {
    return child.err().find("plug it in again") != std::string::npos && catches(child.id(), SIGINT);
  });
  kill(child.id(), SIGINT);
  const Outcome outcome = child.wait();
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 1);
  CHECK_THAT(outcome.err, Contains("within 5 minutes, and its heaters are switched off\n") &&
                              Contains("the waiting was stopped; it may still be hot") &&
                              !Contains("did not come back"));
}

TEST_CASE("a printer that resets has failed, and is cold", "[optimised]") {
  Workshop shop(profile_of("marlin"), "400", {"--fault", "reset@line=40"});
  const Outcome outcome = test::run(shop.words("load", {"--feeder", "1", "--length", "200"}));
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 1);
  CHECK_THAT(outcome.err, Contains("restarted") || Contains("reset"));
  check_left_safe(shop);
}

TEST_CASE("what cannot be fed is refused with a remedy, and a printer of another kind before it heats") {
  const test::TempFolder folder;
  const std::string profile = folder.write("bench.toml", profile_of("marlin")).string();
  const auto refused = [](const std::vector<std::string>& words, const std::string& reason) {
    const Outcome outcome = test::run(words);
    CHECK(outcome.code == 2);
    CHECK_THAT(outcome.err, Contains(reason));
  };
  refused({"load", profile, "--feeder", "4", "--yes"}, "this printer has no feeder 4; choose one of 1 to 3");
  refused({"load", profile, "--yes"}, "--feeder");
  refused({"load", profile, "--feeder", "1", "--yes", "--token", "0123"},
          "PROFILE cannot be given together with --token");
  refused({"unload", profile, "--feeder", "1", "--length", "2001", "--yes"}, "--length");
  refused({"load", profile, "--feeder", "1", "--length", "nan", "--yes"}, "--length");
  refused({"load", profile, "--feeder", "1", "--yes", "--port", (folder / "none").string()}, "none");
  const std::string cold =
      folder.write("cold.toml", profile_of("marlin") + "[temperature]\nnozzle = 160\n").string();
  refused({"purge", cold, "--yes"}, "temperature.nozzle: is 160 °C");
  Workshop shop(profile_of("marlin"), "0", {"--personality", "repetier"});
  refused(shop.words("purge"), "set firmware = \"repetier\"");
  shop.switch_off();
  CHECK(shop.turned(0) == 0);
  CHECK(test::read_text(shop.path("lines")).find("M104") == std::string::npos);
}

TEST_CASE("a printer that another program has is refused with that program's name") {
  Workshop shop(profile_of("marlin"), "100");
  Child first(shop.words("load", {"--feeder", "1"}));
  Workshop::wait_for(
      first, [&] { return test::read_text(shop.path("lines")).find("M104 S210") != std::string::npos; });
  const Outcome second = test::run(shop.words("purge"));
  CHECK(second.code == 2);
  CHECK_THAT(second.err, Contains("process " + std::to_string(first.id())));
}

TEST_CASE("without a yes nothing moves or heats") {
  const test::TempFolder folder;
  const std::string profile = folder.write("bench.toml", profile_of("marlin")).string();
  for (const char* answer : {"", "n\n", "perhaps\n"}) {
    const Outcome outcome = Child({"load", profile, "--feeder", "2", "--port", (folder / "none").string()},
                                  {}, folder.write("answer", answer).string())
                                .wait();
    CHECK(outcome.code == 3);
    CHECK_THAT(outcome.out,
               Contains("Is filament in the gear of feeder 2?") && Contains("nothing has moved"));
  }
}

}  // namespace unicursal
