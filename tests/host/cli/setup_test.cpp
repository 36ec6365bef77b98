// `unicursal setup` in a real terminal, with a simulated printer and without one.
#include <catch2/catch.hpp>

#include "host/job/frames.hpp"
#include "host/job/profile.hpp"
#include "host/job/profile_draft.hpp"
#include "tests/host/support/daemon_process.hpp"
#include "tests/host/support/terminal.hpp"

namespace unicursal {
namespace {

using Catch::Matchers::Contains;
using test::Child;
using test::TempFolder;
using test::Terminal;

host::Profile written(const TempFolder& folder) {
  return host::load_profile(folder / "unicursal/printer.toml");
}

}  // namespace

TEST_CASE("setup asks a printer and a person, and its profile is the default from then on") {
  const TempFolder folder;
  // The firmware's own limits: slower in z than the frame, faster in x and y.
  folder.write("sim.toml", test::replaced(test::sample_profile, "nozzle = 0.6",
                                          "nozzle = 0.6\nmax_speed = [400.0, 400.0, 3.0]"));
  const auto path = [&](const char* name) { return (folder / name).string(); };
  Child printer({"simulate", "--profile", path("sim.toml"), "--link", path("port"), "--speed", "0"});
  test::await([&] { return std::filesystem::exists(folder / "port"); }, printer);
  Terminal terminal({"setup"}, folder.path().string());
  terminal.await("Port: a name, auto, or none");
  terminal.type(path("port") + "\n");
  terminal.await("found: Marlin");
  terminal.await("Which is most like yours [diamond-0.4]");
  terminal.type("somewhat\n");
  terminal.await("please type one of these names");
  terminal.type("geeetech-a10m\n");
  terminal.await("Opening of the nozzle, mm [0.4]");
  terminal.type("wide\n");
  terminal.await("please type a number, from 0.1 to 2");
  terminal.type("0.6\n");
  terminal.await("Size of the bed and height, mm [230 230 260]");
  terminal.type("200 210 180\n");
  terminal.await("Filament in feeder 1");
  terminal.type("red \"PLA\"\n");
  terminal.await("Filament in feeder 2");
  terminal.type("\n");
  terminal.await("written: ");
  terminal.await("good     its max_speed is not below that of the profile");
  CHECK(terminal.wait() == 0);
  const host::Profile profile = written(folder);
  CHECK(profile.printer.name == "Geeetech A10M");
  CHECK(profile.port == path("port"));
  CHECK(profile.baud == 250000);
  CHECK(profile.printer.bed == std::array{200.0, 210.0, 180.0});
  CHECK(profile.printer.nozzle == 0.6);
  CHECK(profile.printer.bead_width_range[0] == Approx(0.36));
  CHECK(profile.printer.max_speed == std::array{150.0, 150.0, 3.0});
  CHECK(profile.printer.feeders == 2);
  REQUIRE(profile.filaments.of_feeders.size() == 2);
  CHECK(profile.filaments.of_feeders[0].name == "red \"PLA\"");
  CHECK(profile.filaments.of_feeders[1].name == "filament 2");

  folder.write("plate.svg", test::sample_drawing);
  Terminal inspect({"inspect", path("plate.svg")}, folder.path().string());
  inspect.await("fits:    yes, on \"Geeetech A10M\"");
  CHECK(inspect.wait() == 0);

  Terminal again({"setup", "--port", "none"}, folder.path().string());
  again.await("exists. Replace it? yes or no [no]");
  again.type("\n");
  again.await("nothing was changed");
  CHECK(again.wait() == 3);
  CHECK(written(folder).printer.nozzle == 0.6);
}

TEST_CASE("setup without a printer takes a frame as it is, and refuses what ends too early") {
  const TempFolder folder;
  Terminal terminal({"setup", "--port", "none", "--frame", "zonestar-z9m3"}, folder.path().string());
  for (const char* question : {"nozzle", "bed", "feeder 1", "feeder 2", "feeder 3"}) {
    terminal.await(question);
    terminal.await("]: ");
    terminal.type("\n");
  }
  terminal.await("written: ");
  CHECK(terminal.wait() == 0);
  CHECK(written(folder).printer.bed == std::array{300.0, 300.0, 400.0});
  CHECK(written(folder).port == "auto");
  const test::Outcome cut = test::run({"setup", "--port", "none", "-o", (folder / "x.toml").string()});
  CHECK(cut.code == 2);
  CHECK_THAT(cut.err, Contains("in a terminal"));
  CHECK_FALSE(std::filesystem::exists(folder / "x.toml"));
  const test::Outcome unknown = test::run({"setup", "--port", "none", "--frame", "prusa"});
  CHECK(unknown.code == 2);
  CHECK_THAT(unknown.err, Contains("choose among diamond-0.4"));
}

TEST_CASE("shipped profiles load, and are found by what a printer calls itself") {
  for (const host::ShippedFrame& frame : host::frames()) {
    INFO(frame.name);
    const host::Profile profile = host::profile_in(std::string(frame.text), "frame.toml");
    CHECK(profile.printer.feeders >= 2);
    CHECK(profile.printer.bead_width_range[1] >= 2 * profile.printer.nozzle);
    CHECK(profile.printer.bead_width_range[0] < profile.printer.nozzle);
  }
  CHECK(host::frame_of_machine("Geeetech A20T")->name == "geeetech-a20t");
  CHECK(host::frame_of_machine("GEEETECH A20") == nullptr);
  CHECK(host::frame_of_machine("") == nullptr);
}

TEST_CASE("a draft changes a key, adds one to its table, and adds a table") {
  host::ProfileDraft draft("# top\n[a]\nx = 1  # mm\n\n[b]\nx = 2\n");
  draft.set("b", "x", "3");
  draft.set("a", "x", "4");
  draft.set("a", "y", "5");
  draft.set("c", "z", "6");
  CHECK(draft.text() == "# top\n[a]\nx = 4  # mm\ny = 5\n\n[b]\nx = 3\n\n[c]\nz = 6\n");
}

}  // namespace unicursal
