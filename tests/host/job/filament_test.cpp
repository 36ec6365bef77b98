#include "host/job/filament.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "core/error.hpp"
#include "core/picture/hex_colour.hpp"
#include "host/job/colour_mixture.hpp"
#include "host/job/load_job.hpp"
#include "host/job/profile.hpp"
#include "host/job/written_job.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal::host {
namespace {

const std::string blue = R"(
[[filament]]
name = "sea blue"
colour = "#2050C0"
material = "PETG"
diameter = 1.71
price = 29.5
currency = "CHF"
see_through = 3.5
)";
const std::string yellow = "\n[[filament]]\ncolour = \"#f0be28\"\nmaterial = \"PLA silk\"\nprice = 20\n";
const std::string wood = "\n[[filament]]\nmaterial = \"wood\"\ndensity = 1.15\n";

/// The sample profile without its number of feeders.
std::string without_number() {
  std::string text = test::sample_profile;
  text.erase(text.find("feeders = 3\n"), 12);
  return text;
}

Profile profile_with(const std::string& filaments) {
  return profile_in(without_number() + filaments, "bench.toml");
}

std::string complaint(const std::string& text) {
  try {
    profile_in(text, "bench.toml");
  } catch (const core::DataError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("A profile names the filaments of its feeders, and their number is that of the feeders") {
  const Profile profile = profile_with(blue + yellow + wood + wood);
  CHECK(profile.printer.feeders == 4);
  const auto& filaments = profile.filaments.of_feeders;
  REQUIRE(filaments.size() == 4);
  CHECK(profile.filaments.currency == "CHF");
  CHECK(filaments[0].name == "sea blue");
  CHECK(picture::hex_of(filaments[0].colour) == "#2050c0");
  CHECK(filaments[0].density == 1.27);
  CHECK(filaments[0].price == 29.5);
  CHECK(filaments[0].see_through == 3.5);
  CHECK(filaments[1].name == "feeder 2");
  CHECK(filaments[1].density == 1.24);  // silk is PLA
  CHECK(filaments[1].diameter == 1.75);
  CHECK(filaments[2].density == 1.15);
  CHECK_FALSE(filaments[2].price);
}

TEST_CASE("How filaments mix can be named, and what is left out is usual") {
  const std::string some = blue + "strength = [1.5, 2, 0.5]\n" + yellow + wood;
  const Profile usual = profile_with(blue + yellow + wood);
  CHECK(usual.filaments.mixing().usual());
  const Profile profile = profile_with(some + "[colours]\nlift = 0.1\nlosses = [[3, 1, 0.1, 0.2, 0.3]]\n");
  const picture::Mixing mixing = profile.filaments.mixing();
  CHECK(mixing.lift == 0.1);
  REQUIRE(mixing.strengths.size() == 3);
  CHECK(mixing.strengths[0] == picture::Light{1.5, 2, 0.5});
  CHECK(mixing.strengths[1] == picture::Light{1, 1, 1});
  REQUIRE(mixing.pairs.size() == 1);
  CHECK((mixing.pairs[0].one == 2 && mixing.pairs[0].other == 0 && mixing.pairs[0].loss[1] == 0.2));
  // A filament that colours more strongly shows more.
  const std::vector<double> half{0.5, 0.5, 0};
  const picture::Colour strong =
      colour_of(half, profile_with(blue + "strength = [9, 9, 9]\n" + yellow + wood).filaments.colours());
  CHECK(strong.r < colour_of(half, usual.filaments.colours()).r);
}

TEST_CASE("A thinner filament is fed farther, in proportion to its section") {
  const Profile profile = profile_with(blue + yellow);
  CHECK(profile.printer.flow_factors[0] == Approx(std::pow(1.75 / 1.71, 2)));
  CHECK(profile.printer.flow_factors[1] == 1);
}

TEST_CASE("A profile without filaments has the usual colours, and may name them in a list") {
  const Profile plain = profile_with("");
  CHECK(plain.printer.feeders == 3);
  CHECK_FALSE(plain.filaments.named);
  CHECK(plain.filaments.of_feeders.at(1).name == "feeder 2");
  CHECK(plain.filaments.of_feeders.at(1).colour == picture::usual_filaments[1]);
  std::string text = test::sample_profile;
  text.insert(text.find("max_flow"), "filaments = [\"a\", \"b\", \"c\"]\n");
  const Profile named = profile_in(text, "bench.toml");
  CHECK(named.filaments.named);
  CHECK(named.filaments.of_feeders.at(2).name == "c");
}

TEST_CASE("A mistake in a filament is reported with file, line, key and remedy") {
  struct Case {
    std::string filaments;
    std::vector<std::string> parts;
  };
  const std::string sound = "\n[[filament]]\nname = \"x\"\n";
  for (const Case& one : std::vector<Case>{
           {sound, {"extruder.feeders", "would be 1", "2 to 8"}},
           {blue + sound + "colour = \"blue\"\n", {"line 23", "filament[1].colour", "#2660c4"}},
           {blue + sound + "color = \"#000000\"\n", {"filament[1].color", "did you mean \"colour\"?"}},
           {blue + sound + "material = \"wood\"\n", {"filament[1].density", "\"wood\"", "density = 1.24"}},
           {blue + sound + "density = 0\n", {"filament[1].density", "0.1 to 20"}},
           {blue + sound + "price = -1\n", {"filament[1].price", "-1"}},
           {blue + sound + "diameter = 2.85\n", {"filament[1].diameter", "2.85 mm", "1.75 mm"}},
           {blue + sound + "currency = \"EUR\"\n",
            {"filament[1].currency", "\"EUR\"", "\"CHF\"", "one currency"}},
           {blue + sound + "currency = \"\"\n", {"filament[1].currency", "1 to 8"}},
           {blue + sound + "see_through = 0\n", {"filament[1].see_through", "mm"}},
           {blue + sound + "strength = [1, 2]\n", {"filament[1].strength", "3", "[red, green, blue]"}},
           {blue + sound + "strength = [1, 0, 2]\n", {"filament[1].strength", "above 0"}},
           {blue + sound + "[colours]\nlift = 0\n", {"line 24", "colours.lift", "0.001 to 1"}},
           {blue + sound + "[colours]\nlosses = [1, 2, 0.2, 0.2, 0.2]\n", {"colours.losses", "five numbers"}},
           {blue + sound + "[colours]\nlosses = [[1, 2, 0.2, 0.2, \"x\"]]\n",
            {"colours.losses", "not a number", "[[1, 2, 0.3"}},
           {blue + sound + "[colours]\nlosses = [[1, 3, 0.2, 0.2, 0.2]]\n",
            {"colours.losses", "feeder 3", "2 feeders"}},
           {blue + sound + "[colours]\nlosses = [[2, 2, 0.2, 0.2, 0.2]]\n", {"colours.losses", "twice"}},
           {blue + sound + "[colours]\nlosses = [[1, 2, 0, 0, 0], [2, 1, 0, 0, 0]]\n",
            {"colours.losses", "feeders 2 and 1 twice"}},
           {"\n[filament]\nname = \"x\"\n", {"filament", "list of filaments", "[[filament]]"}}}) {
    const std::string sentence = complaint(without_number() + one.filaments);
    INFO(sentence);
    CHECK(sentence.find("bench.toml") != std::string::npos);
    for (const std::string& part : one.parts) {
      INFO(part);
      CHECK(sentence.find(part) != std::string::npos);
    }
  }
  const std::string two = complaint(test::sample_profile + blue + sound);
  INFO(two);
  CHECK(two.find("2 times, but extruder.feeders is 3") != std::string::npos);
}

TEST_CASE("The mixture for a colour is that of the filaments that the feeders hold") {
  const Profile profile = profile_with(yellow + "\n[[filament]]\ncolour = \"#ffffff\"\n" + blue);
  const gcode::Shares yellow_alone = shares_near("#f0be28", profile);
  CHECK(yellow_alone == gcode::Shares{1, 0, 0});
  const gcode::Shares green = shares_near("#5a8a5a", profile);
  CHECK(green[0] > 0.2);
  CHECK(green[2] > 0.2);
  CHECK(green[1] < 0.3);
}

TEST_CASE("a mixture is asked for by its colour, and a note says how near it comes") {
  const test::TempFolder folder;
  folder.write("bench.toml", test::sample_profile + std::string("\n[[filament]]\ncolour = \"#f0be28\"\n"
                                                                "\n[[filament]]\ncolour = \"#2660c4\"\n"
                                                                "\n[[filament]]\ncolour = \"#f6f0e2\"\n"));
  folder.write("plate.svg", test::sample_drawing);
  const auto job_with = [&](const std::string& mixture) {
    folder.write("job.toml", test::replaced(test::sample_job, "sea = [0.6, 0.0, 0.2]", "sea = " + mixture));
    return load_job(folder / "job.toml");
  };
  const auto mixture_named = [](const Job& job, const std::string& name) {
    const auto& all = job.print.materials;
    return std::find_if(all.begin(), all.end(), [&](const gcode::Material& one) { return one.name == name; })
        ->mixture;
  };
  const Job green = job_with("\"#3c8c50\"");
  const gcode::Mixture made = mixture_named(green, "sea");
  CHECK(made.share(0) > 0.2);  // yellow and blue
  CHECK(made.share(1) > 0.2);
  for (std::size_t f = 0; f < 3; ++f) CHECK(made.share(f) >= green.profile.printer.floor_share - 1e-9);
  CHECK(made.with_floor(green.profile.printer.floor_share) == made);
  REQUIRE(green.warnings.size() == 1);
  CHECK_THAT(green.warnings[0],
             Catch::Contains("mixture \"sea\": ") && Catch::Contains("#3c8c50") && Catch::Contains("ΔE"));
  // Red cannot be made of these.
  CHECK_THAT(job_with("\"#ff0000\"").warnings.at(0),
             Catch::Contains("these filaments cannot make #ff0000; the nearest that they make is #"));
  CHECK_THROWS_WITH(
      job_with("\"green\""),
      Catch::Contains("is neither a list of numbers nor a colour; write six hexadecimal digits"));
}

}  // namespace unicursal::host
