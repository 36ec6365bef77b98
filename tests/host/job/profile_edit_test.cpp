#include "host/job/profile_edit.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <catch2/catch.hpp>

#include "core/error.hpp"
#include "host/job/profile.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal::host {
namespace {

std::string edited(const std::string& text) {
  return with_transition(text, {3.456, 12, {}}, "profile.toml");
}

}  // namespace

TEST_CASE("The two numbers are replaced and everything else stays, in every way of writing them") {
  const std::pair<const char*, const char*> cases[] = {
      // Comments keep their columns if there is room.
      {"# µm and ü\n[transition]\ndead_volume = 2.1      # mm³\nmixing_volume=4.0# x\n",
       "# µm and ü\n[transition]\ndead_volume = 3.46     # mm³\nmixing_volume=12.00 # x\n"},
      {"[printer]\nname = \"ü\" # µ\n\n[transition] # first\n\tmixing_volume = 4\n\n\tdead_volume = "
       "2\n[gcode]\n",
       "[printer]\nname = \"ü\" # µ\n\n[transition] # first\n\tmixing_volume = 12.00\n\n\tdead_volume = "
       "3.46\n[gcode]\n"},
      // Line ends of another system, no line end at all.
      {"[transition]\r\ndead_volume = 2.1\r\n",
       "[transition]\r\ndead_volume = 3.46\r\nmixing_volume = 12.00\r\n"},
      {"[transition]\ndead_volume = 2.1", "[transition]\ndead_volume = 3.46\nmixing_volume = 12.00"},
      // Missing keys, missing section.
      {"[transition]\n  mixing_volume = 4 # b\n",
       "[transition]\n  mixing_volume = 12.00 # b\n  dead_volume = 3.46\n"},
      {"[transition] # a\n[gcode]\n",
       "[transition] # a\ndead_volume = 3.46\nmixing_volume = 12.00\n[gcode]\n"},
      {"[printer]\nnozzle = 0.6",
       "[printer]\nnozzle = 0.6\n\n[transition]\ndead_volume = 3.46\nmixing_volume = 12.00\n"},
      {"", "[transition]\ndead_volume = 3.46\nmixing_volume = 12.00\n"},
      // Other ways of TOML.
      {"transition = { dead_volume = 2.1, mixing_volume = 4 } # c\n",
       "transition = { dead_volume = 3.46, mixing_volume = 12.00 } # c\n"},
      {"transition = { mixing_volume = 4 }\n",
       "transition = { mixing_volume = 12.00, dead_volume = 3.46 }\n"},
      {"transition = {}\n", "transition = { dead_volume = 3.46, mixing_volume = 12.00 }\n"},
      {"transition.dead_volume = 2.1 # d\n",
       "transition.dead_volume = 3.46 # d\ntransition.mixing_volume = 12.00\n"},
      {"[ \"transition\" ]\n\"dead_volume\" = 2e0\n",
       "[ \"transition\" ]\n\"dead_volume\" = 3.46\n\"mixing_volume\" = 12.00\n"},
      // A text that only looks like the section.
      {"[gcode]\nstart = \"\"\"\n[transition]\ndead_volume = 7\n\"\"\"\n[transition]\ndead_volume = "
       "1\nmixing_volume = 1\n",
       "[gcode]\nstart = \"\"\"\n[transition]\ndead_volume = 7\n\"\"\"\n[transition]\ndead_volume = "
       "3.46\nmixing_volume = 12.00\n"},
  };
  for (const auto& [before, after] : cases) {
    CAPTURE(before);
    CHECK(edited(before) == after);
    CHECK(edited(after) == after);
  }
}

TEST_CASE("A value of several lines gets the line ends of the profile") {
  const std::vector<ProfileChange> change{{"colours", {}, "losses", "[\n  [1, 2, 3, 4, 5],\n]", "lift"}};
  const std::string losses = "losses = [\r\n  [1, 2, 3, 4, 5],\r\n]\r\n";
  for (const std::string before : {"", "[colours]\r\n", "[colours]\r\nlift = 2\r\n",
                                   "[colours]\r\nlosses = [\r\n  [1, 2, 0, 0, 0],\r\n]\r\n"}) {
    const std::string text = "[printer]\r\nnozzle = 0.6\r\n" + before;
    const std::string after = with_changes(text, change, "profile.toml");
    CAPTURE(after);
    CHECK(after.ends_with(losses));
    CHECK(std::count(after.begin(), after.end(), '\n') == std::count(after.begin(), after.end(), '\r'));
  }
}

TEST_CASE("Values of lists of tables and lists of several lines are changed as well") {
  const std::vector<ProfileChange> changes{{"filament", 0, "strength", "[1, 2, 3]", "colour"},
                                           {"filament", 1, "strength", "[4, 5, 6]", "colour"},
                                           {"filament", 1, "colour", "\"#010203\"", ""},
                                           {"colours", {}, "lift", "0.1", ""},
                                           {"colours", {}, "losses", "[\n  [1, 2, 3, 4, 5],\n]", "lift"}};
  const std::pair<const char*, const char*> cases[] = {
      {"[printer]\nname = \"a\"\n[[filament]] # one\ncolour = \"#ffffff\" # white\n[[filament]]\nname = "
       "\"x\"\n\n[extruder] # end\n",
       "[printer]\nname = \"a\"\n[[filament]] # one\ncolour = \"#ffffff\" # white\nstrength = [1, 2, "
       "3]\n[[filament]]\ncolour = \"#010203\"\nstrength = [4, 5, 6]\nname = \"x\"\n\n[extruder] # "
       "end\n\n[colours]\nlift = 0.1\nlosses = [\n  [1, 2, 3, 4, 5],\n]\n"},
      {"filament = [{ colour = \"#ffffff\" }, {}]\n[colours]\nlosses = [\n  [1, 2, 0, 0, 0], # a\n]\nlift = "
       "1 # b\n",
       "filament = [{ colour = \"#ffffff\", strength = [1, 2, 3] }, { colour = \"#010203\", strength = [4, "
       "5, "
       "6] }]\n[colours]\nlosses = [\n  [1, 2, 3, 4, 5],\n]\nlift = 0.1 # b\n"},
  };
  for (const auto& [before, after] : cases) {
    CAPTURE(before);
    CHECK(with_changes(before, changes, "p.toml") == after);
    CHECK(with_changes(after, changes, "p.toml") == after);
  }
  CHECK_THROWS_WITH(with_changes("[printer]\n", changes, "p.toml"),
                    Catch::Contains("filament[0].strength = [1, 2, 3]"));
}

TEST_CASE("What cannot be edited safely is refused") {
  CHECK_THROWS_AS(edited("[transition\n"), core::DataError);
  CHECK_THROWS_AS(edited("transition = 3\n"), core::DataError);
  CHECK_THROWS_AS(edited("[transition]\n\"dead\\u005Fvolume\" = 1\n"), core::DataError);
}

TEST_CASE("A profile is replaced in one step, and only if it is still as it was read") {
  const test::TempFolder folder;
  const auto file = folder.write("p.toml", "[printer]\nname = \"a\"\n");
  const auto link = folder / "link.toml";
  std::filesystem::create_symlink(file, link);
  chmod(file.c_str(), 0640);
  const ProfileText text(link);
  text.set_transition({1.25, 6, {}});
  CHECK(load_profile(file).printer.dead_volume == 1.25);
  CHECK(load_profile(file).printer.mixing_volume == 6);
  CHECK(std::filesystem::is_symlink(link));
  struct stat status {};
  REQUIRE(stat(file.c_str(), &status) == 0);
  CHECK((status.st_mode & 0777) == 0640);

  const std::string present = test::read_text(file);
  CHECK_THROWS_AS(text.set_transition({2, 7, {}}), core::FileError);  // it has been changed meanwhile
  CHECK(test::read_text(file) == present);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    files += entry.exists() ? 1 : 0;
  CHECK(files == 2);
  CHECK_THROWS_AS(ProfileText(folder / "none.toml"), core::FileError);
}

}  // namespace unicursal::host
