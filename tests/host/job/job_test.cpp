#include "host/job/job.hpp"

#include <catch2/catch.hpp>
#include <numbers>

#include "host/job/load_job.hpp"
#include "host/job/nearest.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal::host {
namespace {

using test::replaced;
using test::sample_job;
using test::sample_profile;

Job load(const std::string& text) {
  const test::TempFolder folder;
  folder.write("bench.toml", sample_profile);
  folder.write("wind.csv", "x,y,angle\n0,0,30\n");
  return load_job(folder.write("job.toml", text));
}

}  // namespace

TEST_CASE("The keys of a job arrive in its fields") {
  const Job job = load(sample_job);
  CHECK(job.source.height == 0.4);
  CHECK(job.source.layer_height == 0.2);
  CHECK(job.source.files.front().filename() == "plate.svg");
  CHECK(job.source.files.front().parent_path() == job.file.parent_path());
  CHECK(job.bead_width == 1.0);
  CHECK_FALSE(job.seed_distance);
  CHECK(job.print.flow == 3.0);
  CHECK(job.place.kind == Placement::Kind::center);
  CHECK_FALSE(job.line_width);
  REQUIRE(job.source.zones.size() == 2);
  CHECK(job.source.zones[0].select == "#0000ff");
  CHECK(job.source.zones[1].pattern.kind == core::PatternKind::none);
  REQUIRE(job.print.materials.size() == 2);
  CHECK(job.print.materials[job.source.zones[1].material].name == "sun");
  CHECK(job.print.materials[0].mixture.share(0) == Approx(0.75));
  CHECK(job.profile.baud == 115200);
  CHECK(job.profile.printer.bed[1] == 100);
  CHECK(job.profile.printer.filament_diameter == 1.75);
  CHECK(job.warnings.empty());
}

TEST_CASE("The other forms of placement, deposit and seed distance are read") {
  CHECK(load(replaced(sample_job, "flow = 3.0", "place = \"as-is\"")).place.kind == Placement::Kind::as_is);
  const Job at = load(replaced(sample_job, "flow = 3.0", "place = [30, 40.5]"));
  CHECK(at.place.kind == Placement::Kind::at);
  CHECK(at.place.point == core::Vec2(30, 40.5));
  CHECK(load(replaced(sample_job, "flow = 3.0", "deposit = { width = 0.5 }")).line_width == 0.5);
  const Job both = load(replaced(sample_job, "flow = 3.0", "seed_distance = 1.5"));
  CHECK(both.seed_distance == 1.5);
  CHECK(both.bead_width == 1.0);
  const Job seeds = load(replaced(sample_job, "bead_width = 1.0", "seed_distance = 1.5"));
  CHECK(seeds.bead_width == bead_width_from_seed_distance(1.5));
  CHECK(bead_width_from_seed_distance(2.05) == Approx(1));  // as the planner places seeds for a bead width
}

TEST_CASE("Patterns are read into their types") {
  const auto zone = [](const std::string& pattern) {
    const Job job = load(replaced(sample_job, "pattern = \"isotropic\"", pattern));
    CHECK(job.warnings.empty());
    return job.source.zones[0].pattern;
  };
  CHECK(zone("pattern = \"parallel\"").kind == core::PatternKind::parallel);
  CHECK(zone("pattern = \"anisotropic\"").kind == core::PatternKind::anisotropic);
  const core::Pattern across = zone("pattern = \"orthogonal\"\nboundary = \"zone\"");
  CHECK(across.kind == core::PatternKind::orthogonal);
  CHECK(across.along_zone_border);
  CHECK(zone("pattern = { angle = 45 }").angle == Approx(std::numbers::pi / 4));
  CHECK(zone("pattern = { field = \"wind.csv\" }").field.filename() == "wind.csv");
}

TEST_CASE("Seams and the share of a change before its border are read") {
  CHECK(load(sample_job).print.seam == gcode::Seam::hidden);
  CHECK(load(sample_job).print.change_before_border == 0.5);
  const Job job = load(replaced(sample_job, "flow = 3.0", "seam = \"aligned\"\nchange_before_border = 0.8"));
  CHECK(job.print.seam == gcode::Seam::aligned);
  CHECK(job.print.change_before_border == 0.8);
  CHECK(job.warnings.empty());
}

TEST_CASE("A gradient is a material of its own, and so is a mixture that takes up changes") {
  const std::string gradient = "mixture = { from = \"sun\", to = \"sea\", along = [0, 3, 4] }";
  const Job job = load(replaced(sample_job, "mixture = \"sea\"", gradient));
  REQUIRE(job.print.materials.size() == 2);
  REQUIRE(job.print.materials[0].gradient);
  CHECK(job.print.materials[0].name == "sun to sea");
  CHECK(job.print.materials[0].mixture == job.print.materials[1].mixture);
  CHECK(job.print.materials[0].gradient->to == gcode::Mixture({0.6, 0, 0.2}));
  CHECK(job.print.materials[0].gradient->along[2] == Approx(0.8));
  CHECK(job.warnings.empty());
  const Job same = load(replaced(sample_job, "mixture = \"sea\"", "mixture = \"sun\"\ntransition = true"));
  REQUIRE(same.print.materials.size() == 2);
  CHECK(same.print.materials[0].transition);
  CHECK_FALSE(same.print.materials[1].transition);
}

TEST_CASE("There are no perimeters by default") {
  CHECK(load(sample_job).perimeters == 0);
  const Job job = load(replaced(sample_job, "flow = 3.0", "perimeters = 2"));
  CHECK(job.perimeters == 2);
  CHECK(job.warnings.empty());
}

TEST_CASE("Zones of equal mixture share a material, also if its name and scale differ") {
  const Job job = load(replaced(sample_job, "sun = [0.0, 1.0, 1.0]", "sun = [3, 0, 1]"));
  REQUIRE(job.print.materials.size() == 1);
  CHECK(job.source.zones[0].material == job.source.zones[1].material);
}

TEST_CASE("A given profile wins over the job's, even if that is missing") {
  const test::TempFolder folder;
  const auto other = folder.write("other.toml", replaced(sample_profile, "Test bench", "Other"));
  const auto job = folder.write("job.toml", sample_job);
  CHECK(load_job(job, other).profile.printer.name == "Other");
}

TEST_CASE("Edit distance counts insertions, deletions, replacements and swaps") {
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("kitten", "sitting") == 3);
  CHECK(edit_distance("layer_heigth", "layer_height") == 1);
  CHECK(edit_distance("flow", "flow") == 0);
  CHECK(nearest("bed_width", {"height", "bead_width", "flow"}) == "bead_width");
  CHECK(nearest("x", {}) == "");
}

}  // namespace unicursal::host
