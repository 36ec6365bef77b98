// `unicursal tune transition`: the program itself.
#include <poll.h>
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "host/job/profile.hpp"
#include "tests/host/support/child_process.hpp"
#include "tests/host/support/hidden_nozzles.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal {
namespace {

using test::Child;
using test::Outcome;
using test::run;

constexpr const char* profile_text = R"([printer]
name = "Diamond"   # three feeders
bed = [200.0, 200.0, 200.0]
nozzle = 0.6
bead_width_range = [0.36, 1.6]

[transition]       # as somebody guessed
dead_volume = 2.1  # mm³
mixing_volume = 4.0
)";

struct Workshop {
  Workshop() { profile = folder.write("diamond.toml", profile_text).string(); }

  std::string path(const std::string& name) const { return (folder / name).string(); }
  std::vector<std::string> tune(const std::vector<std::string>& more) const {
    std::vector<std::string> all = {"tune", "transition", profile};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Outcome answered(const std::string& answers, const std::vector<std::string>& more) const {
    return Child(tune(more), {}, folder.write("answers", answers).string()).wait();
  }
  /// A printer whose volumes are others than the profile's.
  std::string machine(const test::HiddenNozzle& nozzle) const {
    std::string text = test::replaced(profile_text, "2.1 ", std::to_string(nozzle.dead));
    text = test::replaced(text, "4.0", std::to_string(nozzle.mixing));
    return folder.write("machine.toml", text).string();
  }
  bool untouched() const { return test::read_text(profile) == profile_text; }

  test::TempFolder folder;
  std::string profile;
};

void wait_until_said(const Child& child, const std::string& words) {
  while ((child.out() + child.err()).find(words) == std::string::npos) {
    REQUIRE(child.running());
    poll(nullptr, 0, 5);
  }
}

}  // namespace

TEST_CASE("Tuning on the simulated printer finds its hidden volumes", "[tuning][optimised]") {
  const Workshop shop;
  std::vector<test::HiddenNozzle> nozzles = test::hidden_nozzles();
  nozzles.push_back({test::least_dead, test::least_mixing, 1});
  nozzles.push_back({test::least_dead, test::least_mixing, 6});
  nozzles.push_back({test::most_dead, test::most_mixing, 1});
  for (const test::HiddenNozzle& nozzle : nozzles) {
    CAPTURE(nozzle.dead, nozzle.mixing, nozzle.tanks);
    shop.folder.write("diamond.toml", profile_text);
    const Outcome outcome = run(shop.tune({"--simulate", "--machine", shop.machine(nozzle), "--tanks",
                                           std::to_string(nozzle.tanks), "--read-simulated", "--yes"}));
    INFO(outcome.out << outcome.err);
    REQUIRE(outcome.code == 0);
    const gcode::Printer found = host::load_profile(shop.profile).printer;
    const double most = 0.1 * (nozzle.dead + nozzle.mixing);
    CHECK(std::abs(found.dead_volume - nozzle.dead) <= most);
    CHECK(std::abs(found.mixing_volume - nozzle.mixing) <= most);
  }
  const std::string text = test::read_text(shop.profile);
  CHECK(text.find("name = \"Diamond\"   # three feeders\n") != std::string::npos);
  CHECK(text.find("[transition]       # as somebody guessed\n") != std::string::npos);
}

TEST_CASE("The other direction and other feeders give the same", "[tuning]") {
  const Workshop shop;
  const std::string machine = shop.machine({3, 8, 2});
  for (const auto& [from, to] : {std::pair{"1", "3"}, std::pair{"3", "1"}, std::pair{"2", "3"}}) {
    const Outcome outcome = run(shop.tune(
        {"--simulate", "--machine", machine, "--from", from, "--to", to, "--read-simulated", "--yes"}));
    REQUIRE(outcome.code == 0);
    CHECK(host::load_profile(shop.profile).printer.dead_volume == Approx(3).margin(0.5));
    CHECK(host::load_profile(shop.profile).printer.mixing_volume == Approx(8).margin(0.5));
  }
}

TEST_CASE("Printers of two, four and eight feeders are tuned between their first and last feeder",
          "[tuning][optimised]") {
  for (const char* feeders : {"2", "4", "8"}) {
    CAPTURE(feeders);
    const Workshop shop;
    const std::string more = std::string("\n[extruder]\nfeeders = ") + feeders + "\n";
    shop.folder.write("diamond.toml", profile_text + more);
    const std::string machine = shop.machine({3, 8, 2});
    shop.folder.write("machine.toml", test::read_text(machine) + more);
    const Outcome outcome = run(shop.tune(
        {"--simulate", "--machine", machine, "--from", "1", "--to", feeders, "--read-simulated", "--yes"}));
    INFO(outcome.out << outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(host::load_profile(shop.profile).printer.dead_volume == Approx(3).margin(0.5));
    CHECK(host::load_profile(shop.profile).printer.mixing_volume == Approx(8).margin(0.5));
    // One more feeder than there is.
    const std::string next = std::to_string(std::stoi(feeders) + 1);
    const Outcome refused = run(shop.tune({"--simulate", "--from", "1", "--to", next}));
    CHECK(refused.code == 2);
  }
}

TEST_CASE("Asked at the terminal, with a picture to look at", "[tuning]") {
  const Workshop shop;
  const Outcome outcome =
      shop.answered("31\n45\n73\ny\n", {"--simulate", "--picture", shop.path("pictures")});
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 0);
  CHECK(test::read_text(shop.folder / "pictures" / "deposit-0000.png").rfind("\x89PNG", 0) == 0);
  CHECK_FALSE(shop.untouched());
}

TEST_CASE("Cancelled at any point, the profile is untouched", "[tuning]") {
  const Workshop shop;
  SECTION("by the answers") {
    for (const char* answers : {"", "q\n", "31\n", "31\nq\n", "31\n45\n", "31\n45\nq\n", "31\n45\n73\n",
                                "31\n45\n73\nn\n", "31\n45\n73\nq\n", "31\n45\n73\n\n"}) {
      CAPTURE(answers);
      const Outcome outcome = shop.answered(answers, {});
      CHECK(outcome.code == 1);
      CHECK(outcome.out.find("the profile was not changed") != std::string::npos);
      CHECK(shop.untouched());
    }
  }
  SECTION("by Ctrl-C at a question") {
    const std::string pipe = shop.path("typing");
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    const int hand = open(pipe.c_str(), O_RDWR);
    REQUIRE(hand >= 0);
    const std::pair<const char*, const char*> stages[] = {
        {"", "line 5?"}, {"31\n", "line 50?"}, {"45\n", "line 95?"}, {"73\n", "[y/N]"}};
    for (std::size_t last = 0; last < std::size(stages); ++last) {
      Child child(shop.tune({}), {}, pipe);
      for (std::size_t stage = 0; stage <= last; ++stage) {
        const std::string typed = stages[stage].first;
        REQUIRE(write(hand, typed.data(), typed.size()) == static_cast<ssize_t>(typed.size()));
        wait_until_said(child, stages[stage].second);
      }
      kill(child.id(), SIGINT);
      CHECK(child.wait().code == 128 + SIGINT);
      CHECK(shop.untouched());
    }
    close(hand);
  }
  SECTION("by Ctrl-C while the strip is printed") {
    Child printer({"simulate", "--once", "--speed", "200", "--link", shop.path("printer"), "--report",
                   shop.path("seen.json")});
    while (!std::filesystem::exists(shop.path("printer"))) {
      REQUIRE(printer.running());
      poll(nullptr, 0, 5);
    }
    Child child(shop.tune({"--port", shop.path("printer"), "--began", "31", "--stopped", "73", "--yes"}));
    wait_until_said(child, "layer 1 of 1");
    kill(child.id(), SIGINT);
    CHECK(child.wait().code == 1);
    CHECK(printer.wait().code == 0);
    const auto seen = nlohmann::json::parse(test::read_text(shop.path("seen.json")));
    CHECK(seen["temperatures"]["nozzle"]["target"] == 0);
    CHECK(shop.untouched());
  }
}

TEST_CASE("A printer whose cable is pulled while the strip is printed is cooled when it is back",
          "[tuning]") {
  const Workshop shop;
  Child printer({"simulate", "--speed", "200", "--link", shop.path("printer"), "--transcript",
                 shop.path("lines"), "--fault", "disconnect:100@line=60"});
  while (!std::filesystem::exists(shop.path("printer"))) {
    REQUIRE(printer.running());
    poll(nullptr, 0, 5);
  }
  const Outcome outcome =
      run(shop.tune({"--port", shop.path("printer"), "--began", "31", "--stopped", "73", "--yes"}));
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 1);
  CHECK(outcome.err.find("plug it in again within 5 minutes, and its heaters are switched off") !=
        std::string::npos);
  CHECK(outcome.err.find("the printer is back, and it cools; begin again") != std::string::npos);
  const std::string lines = test::read_text(shop.folder / "lines");
  const std::size_t cooled = lines.rfind("M104 S0\nM140 S0\n");
  REQUIRE(cooled != std::string::npos);
  CHECK(lines.find(" E", cooled) == std::string::npos);
  CHECK(shop.untouched());
}

TEST_CASE("Errors also leave the profile unchanged", "[tuning]") {
  const Workshop shop;
  const std::vector<std::vector<std::string>> wrong = {
      {"--began", "50", "--stopped", "20", "--yes"},
      {"--began", "31", "--half", "72", "--stopped", "73", "--yes"},
      {"--began", "31", "--stopped", "73000", "--yes"},
      {"--began", "31", "--yes"},
      {"--from", "2", "--to", "2"},
      {"--from", "4"},
      {"--range", "900"},
      {"--port", shop.path("none"), "--began", "31", "--stopped", "73", "--yes"},
      {"--simulate", "--port", "auto"},
      {"--simulate", "--machine", shop.path("none.toml")},
      {"--simulate", "--tanks", "0"},
      {"--read-simulated"},
      {"--photo", shop.path("none.jpg")},
      {"--photo", shop.profile},
      {"--corners", "1,2,3,4,5,6,7,8"},
      {"-o", shop.profile},
      {"-o", shop.path("diamond.toml/x/y")},
  };
  for (const auto& arguments : wrong) {
    CAPTURE(arguments);
    const Outcome outcome = shop.answered("31\n45\n73\ny\n", arguments);
    CHECK(outcome.code == 2);
    CHECK(outcome.err.rfind("unicursal: ", 0) == 0);
    CHECK(shop.untouched());
  }
  CHECK(run({"tune"}).code == 2);
  CHECK(run({"tune", "transition", shop.path("none.toml")}).code == 2);
}

TEST_CASE("Options that exclude each other, and files that would be lost, are named before anything is done",
          "[tuning]") {
  const Workshop shop;
  const std::string photo = shop.folder.write("fit.png", "a photo").string();
  const std::pair<std::vector<std::string>, const char*> wrong[] = {
      {{"--photo", photo, "--corners", "1,2,3"}, "--corners: are not eight numbers"},
      {{"--photo", photo, "--began", "31", "--stopped", "73"}, "--began"},
      {{"--photo", photo, "--port", "auto"}, "--port"},
      {{"--photo", photo, "--simulate"}, "--simulate"},
      {{"--photo", photo, "--picture", shop.path(".")}, "is an input, which would be lost"},
      {{"--simulate", "--rasters", shop.profile}, "is an input, which would be lost"},
      {{"--simulate", "--rasters", shop.path("."), "--read-simulated"}, "unicursal: "},
  };
  for (const auto& [arguments, words] : wrong) {
    CAPTURE(arguments);
    const Outcome outcome = run(shop.tune(arguments));
    CHECK(outcome.code == 2);
    INFO(outcome.err);
    CHECK(outcome.err.find(words) != std::string::npos);
    CHECK(shop.untouched());
    CHECK(test::read_text(photo) == "a photo");
  }
}

TEST_CASE("A profile that was edited meanwhile is not overwritten", "[tuning]") {
  const Workshop shop;
  const std::string pipe = shop.path("typing");
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  const int hand = open(pipe.c_str(), O_RDWR);
  Child child(shop.tune({"--began", "31", "--stopped", "73"}), {}, pipe);
  wait_until_said(child, "[y/N]");
  const std::string theirs = std::string(profile_text) + "# mine\n";
  shop.folder.write("diamond.toml", theirs);
  REQUIRE(write(hand, "y\n", 2) == 2);
  const Outcome outcome = child.wait();
  close(hand);
  CHECK(outcome.code == 2);
  CHECK(outcome.err.find("changed by another program") != std::string::npos);
  CHECK(test::read_text(shop.profile) == theirs);
}

TEST_CASE("A strip can be printed from a file and read later", "[tuning]") {
  const Workshop shop;
  const Outcome written = run(shop.tune({"-o", shop.path("strip.gcode")}));
  CHECK(written.code == 0);
  CHECK(shop.untouched());
  const std::string gcode = test::read_text(shop.path("strip.gcode"));
  CHECK(gcode.find("\nM109 S210\n") < gcode.find("\nT4\n"));
  CHECK(gcode.find("\nT4\n") < gcode.find("\nM104 S0\n"));
  CHECK(run(shop.tune({"--began", "31", "--half", "45", "--stopped", "73", "--yes"})).code == 0);
  CHECK_FALSE(shop.untouched());
}

}  // namespace unicursal
