#include <catch2/catch.hpp>

#include "host/job/job.hpp"
#include "host/job/load_job.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal::host {
namespace {

using test::replaced;
using test::sample_job;
using test::sample_profile;

std::string complaint(const std::string& job, const std::string& profile) {
  const test::TempFolder folder;
  folder.write("bench.toml", profile);
  const auto file = folder.write("job.toml", job);
  try {
    load_job(file);
  } catch (const core::DataError& error) {
    return error.what();
  }
  return "";
}

/// One mistake, and what the sentence about it must contain.
struct Case {
  const char* from;
  const char* to;
  std::vector<std::string> words;
};

void check(const std::string& sentence, const Case& spoilt) {
  INFO(spoilt.from << " → " << spoilt.to);
  INFO(sentence);
  for (const std::string& word : spoilt.words) {
    INFO(word);
    CHECK(sentence.find(word) != std::string::npos);
  }
  CHECK(sentence.find("; ") != std::string::npos);  // a remedy follows
}

std::string repeated(const std::string& piece, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += piece;
  return text;
}

const std::vector<Case> spoilt_jobs = {
    {"printer = \"bench.toml\"", "", {"job.toml", "line 1", "printer", "missing", "--profile"}},
    {"bench.toml",
     "lost.toml",
     {"job.toml", "line 1", "printer", "lost.toml", "does not exist", "--profile"}},
    {"height = 0.4\n", "", {"line 3", "part.height", "missing", "height = 1.0"}},
    {"layer_height = 0.2", "", {"line 3", "part.layer_height", "missing", "layer_height = 0.2"}},
    {"bead_width = 1.0", "", {"line 3", "part.bead_width", "missing"}},
    {"file = \"plate.svg\"", "", {"line 3", "part.file", "missing", ".svg", ".3mf"}},
    {"file = \"plate.svg\"", "file = 3", {"line 4", "part.file", "a number", "text"}},
    {"file = \"plate.svg\"", "file = []", {"line 4", "part.file", "empty"}},
    {"height = 0.4", "height = 0", {"line 5", "part.height", "is 0", "mm"}},
    {"height = 0.4", "height = -1.5", {"line 5", "part.height", "is -1.5"}},
    {"height = 0.4", "height = nan", {"line 5", "part.height", "nan"}},
    {"height = 0.4", "height = inf", {"line 5", "part.height", "inf"}},
    {"height = 0.4", "height = \"tall\"", {"line 5", "part.height", "a text", "number"}},
    {"layer_height = 0.2",
     "layer_height = 0.0",
     {"line 6", "part.layer_height", "is 0", "above 0, up to 10000 mm"}},
    {"layer_height = 0.2", "layer_height = 0.019", {"line 6", "part.layer_height", "0.019 mm", "thinner"}},
    {"layer_height = 0.2",
     "layer_height = 0.61",
     {"line 6", "part.layer_height", "0.61 mm", "opening of 0.6 mm", "another nozzle"}},
    {"height = 0.4", "height = 9007199254740993", {"line 5", "part.height", "digits"}},
    {"height = 0.4", "height = 99999999999999999999", {"line 5", "not valid TOML"}},
    {"layer_height = 0.2",
     "layer_heigth = 0.2",
     {"line 6", "part.layer_heigth", "did you mean \"layer_height\"?"}},
    {"[part]", "colour = 3\n[part]", {"line 3", "colour", "not a known key", "the keys here are"}},
    {"bead_width = 1.0",
     "bead_width = 1.3",
     {"line 7", "part.bead_width", "1.3 mm", "0.4 to 1.2", "profile"}},
    {"bead_width = 1.0", "bead_width = 0.39", {"line 7", "part.bead_width", "0.39 mm"}},
    {"bead_width = 1.0", "seed_distance = 9", {"line 7", "part.seed_distance", "0.4 to 1.2"}},
    {"flow = 3.0",
     "seed_distance = 0.49",
     {"line 8", "part.seed_distance", "0.49 mm", "1 mm wide", "0.5 and 4"}},
    {"flow = 3.0", "seed_distance = 4.1", {"line 8", "part.seed_distance", "4.1 mm", "leave out one"}},
    {"flow = 3.0", "flow = 5.1", {"line 8", "part.flow", "5.1 mm³/s", "at most 5", "max_flow"}},
    {"flow = 3.0", "flow = 0", {"line 8", "part.flow", "0.01"}},
    {"flow = 3.0", "flow = \"fast\"", {"line 8", "part.flow", "\"auto\""}},
    {"flow = 3.0", "perimeters = -1", {"line 8", "part.perimeters", "-1"}},
    {"flow = 3.0", "perimeters = 1.5", {"line 8", "part.perimeters", "whole number"}},
    {"flow = 3.0", "place = \"middle\"", {"line 8", "part.place", "\"middle\"", "\"center\"", "\"as-is\""}},
    {"flow = 3.0", "place = [1, 2, 3]", {"line 8", "part.place", "3 numbers instead of 2"}},
    {"flow = 3.0", "place = [1, nan]", {"line 8", "part.place", "nan"}},
    {"flow = 3.0", "deposit = { width = 1.3 }", {"line 8", "part.deposit.width", "1.3", "1.2 mm"}},
    {"flow = 3.0", "deposit = { widht = 1 }", {"line 8", "part.deposit.widht", "\"width\""}},
    {"flow = 3.0", "deposit = \"full\"", {"line 8", "part.deposit", "did you mean \"fill\"?"}},
    {"select = \"#0000ff\"", "", {"line 10", "zone[0].select", "missing"}},
    {"\"isotropic\"", "\"isotropical\"", {"line 12", "zone[0].pattern", "did you mean \"isotropic\"?"}},
    {"\"isotropic\"", "{ angle = 400 }", {"line 12", "zone[0].pattern.angle", "400", "360"}},
    {"\"isotropic\"",
     "{ field = \"no.csv\" }",
     {"line 12", "zone[0].pattern.field", "no.csv", "does not exist"}},
    {"\"isotropic\"", "{}", {"line 12", "zone[0].pattern", "angle or a field"}},
    {"pattern = \"isotropic\"",
     "boundary = \"zones\"",
     {"line 12", "zone[0].boundary", "did you mean \"zone\"?"}},
    {"mixture = \"sea\"",
     "mixture = \"see\"",
     {"line 13", "zone[0].mixture", "not defined", "did you mean \"sea\"?"}},
    {"mixture = \"sea\"", "", {"line 10", "zone[0].mixture", "missing"}},
    {"[0.6, 0.0, 0.2]", "[0, 0.0, 0]", {"line 21", "mixture.sea", "zero"}},
    {"[0.6, 0.0, 0.2]", "[1e308, 0.0, 1e308]", {"line 21", "mixture.sea", "too large"}},
    {"[0.6, 0.0, 0.2]", "[0.6, -0.1, 0.2]", {"line 21", "mixture.sea", "-0.1", "at least 0"}},
    {"[0.6, 0.0, 0.2]", "[0.6, nan, 0.2]", {"line 21", "mixture.sea", "nan"}},
    {"[0.6, 0.0, 0.2]", "[0.6, 0.4]", {"line 21", "mixture.sea", "2 shares", "3 feeders"}},
    {"[0.6, 0.0, 0.2]", "[0.6, 0.2, 0.1, 0.1]", {"line 21", "mixture.sea", "4 shares"}},
    {"[0.6, 0.0, 0.2]", "\"blue\"", {"line 21", "mixture.sea", "list of numbers"}},
    {"[mixture]\nsea = [0.6, 0.0, 0.2]\nsun = [0.0, 1.0, 1.0]",
     "",
     {"line 1", "mixture", "missing", "[mixture]"}},
    {"[mixture]", "[[mixture]]", {"mixture", "a list", "table"}},
    {"[part]", "[part", {"line 3", "not valid TOML"}},
};

const std::vector<Case> spoilt_profiles = {
    {"[printer]", "[print]", {"bench.toml", "line 1", "print", "did you mean \"printer\"?"}},
    {"firmware = \"marlin\"",
     "firmware = \"marlyn\"",
     {"line 3", "printer.firmware", "did you mean \"marlin\"?"}},
    {"baud = 115200", "baud = 0", {"line 4", "printer.baud", "is 0"}},
    {"[120.0, 100.0, 80.0]", "[120.0, 100.0]", {"line 5", "printer.bed", "2 numbers instead of 3"}},
    {"[120.0, 100.0, 80.0]",
     "[120.0, -100.0, 80.0]",
     {"line 5", "printer.bed", "-100", "from 1 to 10000 mm"}},
    {"[120.0, 100.0, 80.0]", "[120.0, 1e308, 80.0]", {"line 5", "printer.bed", "to 10000 mm"}},
    {"[120.0, 100.0, 80.0]", "[120.0, nan, 80.0]", {"line 5", "printer.bed", "nan"}},
    {"baud = 115200", "baud = 9600.5", {"line 4", "printer.baud", "whole"}},
    {"baud = 115200", "max_speed = [100, 100, 20000]", {"line 4", "printer.max_speed", "to 10000 mm/s"}},
    {"baud = 115200", "max_speed = [100, inf, 10]", {"line 4", "printer.max_speed", "inf"}},
    {"baud = 115200",
     "max_acceleration = [1e7, 100, 10]",
     {"line 4", "printer.max_acceleration", "to 1000000 mm/s²"}},
    {"nozzle = 0.6", "nozzle = 60", {"line 6", "printer.nozzle", "from 0.05 to 10 mm"}},
    {"feeders = 3", "filament_diameter = 175", {"line 10", "extruder.filament_diameter", "0.5 to 10 mm"}},
    {"feeders = 3", "retraction_length = 101", {"line 10", "extruder.retraction_length", "0 to 100 mm"}},
    {"max_flow = 5.0", "max_flow = 1e5", {"line 11", "extruder.max_flow", "to 10000 mm³/s"}},
    {"max_flow = 5.0", "[temperature]\nbed = 210", {"line 12", "temperature.bed", "0 to 200 °C"}},
    {"max_flow = 5.0", "[temperature]\nnozzle = 501", {"line 12", "temperature.nozzle", "°C"}},
    {"[0.4, 1.2]", "[1.2, 0.4]", {"line 7", "printer.bead_width_range", "swap"}},
    {"feeders = 3", "feeders = 9", {"line 10", "extruder.feeders", "2 to 8"}},
    {"feeders = 3", "feeders = 1", {"line 10", "extruder.feeders", "2 to 8 with marlin"}},
    {"feeders = 3", "flow_factors = [1, 1]", {"line 10", "extruder.flow_factors", "2 numbers", "3 feeders"}},
    {"feeders = 3", "feeders = 2.5", {"line 10", "extruder.feeders", "whole"}},
    {"max_flow = 5.0", "tube_length = 0", {"line 11", "extruder.tube_length", "1 to 1900 mm"}},
    {"feeders = 3", "floor_share = 0.5", {"line 10", "extruder.floor_share", "0.5"}},
    {"max_flow = 5.0", "maxflow = 5.0", {"line 11", "extruder.maxflow", "did you mean \"max_flow\"?"}},
};

}  // namespace

TEST_CASE("The sample job has no mistake") {
  CHECK(complaint(sample_job, sample_profile) == "");
}

TEST_CASE("A mistake in a job is reported with file, line, key and remedy") {
  for (const Case& spoilt : spoilt_jobs) {
    const std::string sentence = complaint(replaced(sample_job, spoilt.from, spoilt.to), sample_profile);
    CHECK(sentence.find("job.toml") != std::string::npos);
    check(sentence, spoilt);
  }
}

TEST_CASE("A mistake in a profile is reported with file, line, key and remedy") {
  for (const Case& spoilt : spoilt_profiles) {
    const std::string sentence = complaint(sample_job, replaced(sample_profile, spoilt.from, spoilt.to));
    CHECK(sentence.find("bench.toml") != std::string::npos);
    check(sentence, spoilt);
  }
}

TEST_CASE("A job uses at most two hundred different mixtures") {
  const auto job_of = [](int mixtures, bool equal) {
    std::string zones, palette;
    for (int i = 0; i < mixtures; ++i) {
      const std::string name = "m" + std::to_string(i);
      zones += "[[zone]]\nselect = \"" + name + "\"\nmixture = \"" + name + "\"\n";
      palette += name + " = [1, 1, " + std::to_string(equal ? 3 : i) + "]\n";
    }
    const std::string job = sample_job;
    return job.substr(0, job.find("[[zone]]")) + zones + "[mixture]\n" + palette;
  };
  CHECK(complaint(job_of(200, false), sample_profile) == "");
  CHECK(complaint(job_of(201, true), sample_profile) == "");
  const std::string sentence = complaint(job_of(201, false), sample_profile);
  INFO(sentence);
  CHECK(sentence.find("zone[200].mixture") != std::string::npos);
  CHECK(sentence.find("at most 200") != std::string::npos);
}

TEST_CASE("A missing job, a folder and a huge file are refused") {
  const test::TempFolder folder;
  CHECK_THROWS_AS(load_job(folder / "none.toml"), core::FileError);
  CHECK_THROWS_WITH(load_job(folder.path()), Catch::Contains("is a folder"));
  CHECK_THROWS_AS(load_job(folder.write("huge.toml", std::string(2 << 20, '#'))), core::FileError);
}

TEST_CASE("Bytes of any kind in a job are an error and nothing worse") {
  std::string bytes = "x = \"";
  for (int c = 0; c < 256; ++c) bytes += static_cast<char>(c);
  CHECK(complaint(bytes, sample_profile).find("not valid TOML") != std::string::npos);
  CHECK(complaint(std::string(60, '['), sample_profile).find("not valid TOML") != std::string::npos);
}

TEST_CASE("Text that is nested too deep is refused before the parser runs out of stack") {
  const std::string dots = repeated(".a", 40000), many = repeated(".a", 500000);
  const std::string deep[] = {
      "a" + dots + " = 1",
      "a" + many + " = 1",
      "[a" + dots + "]",
      "[[ a" + dots + " ]]",
      "x = {a" + dots + " = 1}",
      "x = [{b = 1, a" + dots + " = 1}]",
      "x = " + repeated("[", 40000),
      "x = " + repeated("{a=", 40000),
      "x = " + repeated("{a.b.c=[", 40000),
      "\"a\"" + repeated(". \"a\"", 40000) + " = 1",
      "x = {t = \"\"\"end\"\"\"\", a" + dots + " = 1}",  // the text is: end"
      "x = {t = '''end''''', a" + dots + " = 1}",        // the text is: end''
      "t = \"a\\\"#\"\na" + dots + " = 1",
  };
  for (const std::string& line : deep) {
    INFO(line.substr(0, 60));
    const std::string sentence = complaint(sample_job + ("\n# a comment\n" + line + "\n"), sample_profile);
    CHECK(sentence.find("job.toml") != std::string::npos);
    CHECK(sentence.find("64 levels") != std::string::npos);
    const std::string other = complaint(sample_job, sample_profile + ("\n" + line + "\n"));
    CHECK(other.find("bench.toml") != std::string::npos);
    CHECK(other.find("64 levels") != std::string::npos);
  }
  const std::string late = complaint("a = \"\"\"\n\n\"\"\"\na" + dots + " = 1\n", sample_profile);
  CHECK(late.find("line 4") != std::string::npos);
  // Dots of texts, comments and numbers are not levels.
  const std::string harmless =
      "# " + dots + "\nx = [" + repeated("1.5, ", 1000) + "'" + dots + "', \"" + dots + "\"]\n";
  CHECK(complaint(harmless + sample_job, sample_profile).find("x is not a known key") != std::string::npos);
}

}  // namespace unicursal::host
