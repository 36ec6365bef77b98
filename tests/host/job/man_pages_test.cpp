// The man pages of jobs and profiles name exactly the keys that the loaders know, and their examples load.
#include <catch2/catch.hpp>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "firmware_gcode/toolpath/placeholders.hpp"
#include "host/job/keys.hpp"
#include "host/job/load_job.hpp"
#include "tests/host/support/temp_folder.hpp"
#include "tests/paths.hpp"

namespace unicursal::host {
namespace {

const std::filesystem::path root = test::source_folder();

std::string page(const std::string& name) {
  std::ifstream stream(root / "host/packaging" / name);
  std::ostringstream text;
  text << stream.rdbuf();
  REQUIRE(text.str().size() > 1000);
  return text.str();
}

/// Lines such as ".It Ic part.flow No = …".
std::set<std::string> documented(const std::string& page) {
  std::set<std::string> keys;
  static const std::regex item(R"(\n\.It Ic ([A-Za-z0-9_.]+) No =)");
  for (std::sregex_iterator match(page.begin(), page.end(), item), end; match != end; ++match) {
    CHECK(keys.insert((*match)[1]).second);
  }
  return keys;
}

void add_keys(std::set<std::string>& all, const std::string& table, const keys::Keys& keys) {
  for (const std::string& key : keys) all.insert(table + "." + key);
}

std::string first_example(const std::string& page) {
  const std::string begin = ".Bd -literal -offset indent\n";
  const std::size_t from = page.find(begin, page.find(".Sh EXAMPLES\n")) + begin.size();
  return page.substr(from, page.find(".Ed\n", from) - from);
}

}  // namespace

TEST_CASE("unicursal-job(5) names the keys of a job and no others") {
  std::set<std::string> known = {"printer", "mixture.NAME"};
  add_keys(known, "part", keys::part);
  add_keys(known, "part.deposit", keys::deposit);
  add_keys(known, "part.skirt", keys::skirt);
  add_keys(known, "part.fan", keys::fan);
  add_keys(known, "part.temperatures", keys::temperatures);
  add_keys(known, "zone", keys::zone);
  add_keys(known, "zone.pattern", keys::pattern);
  add_keys(known, "zone.mixture", keys::gradient);
  CHECK(documented(page("unicursal-job.5")) == known);
  CHECK(keys::job == keys::Keys{"printer", "part", "zone", "mixture"});
}

TEST_CASE("unicursal-profile(5) names the keys of a profile and no others") {
  std::set<std::string> known;
  add_keys(known, "printer", keys::printer);
  add_keys(known, "extruder", keys::extruder);
  add_keys(known, "filament", keys::filament);
  add_keys(known, "temperature", keys::temperature);
  add_keys(known, "colours", keys::colours);
  add_keys(known, "transition", keys::transition);
  add_keys(known, "gcode", keys::gcode);
  CHECK(documented(page("unicursal-profile.5")) == known);
  CHECK(keys::profile ==
        keys::Keys{"printer", "extruder", "filament", "colours", "temperature", "transition", "gcode"});
}

TEST_CASE("unicursal-profile(5) names every placeholder of start and end lines") {
  const std::string text = page("unicursal-profile.5");
  for (const std::string& name : gcode::placeholder_names()) {
    INFO(name);
    CHECK(text.find("{" + name + "}") != std::string::npos);
  }
}

TEST_CASE("The examples of the man pages load") {
  const test::TempFolder folder;
  const auto profile = folder.write("diamond.toml", first_example(page("unicursal-profile.5")));
  std::filesystem::copy_file(root / "host/examples/leaf.svg", folder / "leaf.svg");
  const Job job = load_job(folder.write("job.toml", first_example(page("unicursal-job.5"))));
  CHECK(job.print.materials.size() == 2);
  CHECK(job.profile.printer.nozzle == 0.6);
  CHECK(load_profile(profile).printer.start_gcode.find("{layer_count}") != std::string::npos);
}

}  // namespace unicursal::host
