// Places that stay without plastic: warned of, refused, or allowed.
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/host/support/child_process.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal {
namespace {

using nlohmann::json;
using test::Outcome;
using test::run;
using test::TempFolder;

/// A wedge that is 60 mm long, and a job for it. The least bead is 0.4 mm wide.
struct WedgeJob {
  explicit WedgeJob(const std::string& end) {
    folder.write("bench.toml", test::sample_profile);
    folder.write("wedge.svg", "<svg xmlns='http://www.w3.org/2000/svg' width='60mm' height='" + end +
                                  "mm' viewBox='0 0 60 " + end + "'><path d='M0 0L60 " + end +
                                  "H0Z'/></svg>");
    job = folder
              .write("job.toml",
                     "printer = \"bench.toml\"\n[part]\nfile = \"wedge.svg\"\nheight = 0.2\n"
                     "layer_height = 0.2\nbead_width = 0.8\nflow = 2.0\n"
                     "[[zone]]\nselect = \"#000000\"\npattern = \"isotropic\"\nmixture = \"a\"\n"
                     "[mixture]\na = [1, 1, 1]\n")
              .string();
  }
  Outcome plan(const std::vector<std::string>& options = {}) const {
    return with_report({"plan", job, "-o", (folder / "o.gcode").string()}, options);
  }
  Outcome dry_run(const std::vector<std::string>& options = {}) const {
    return with_report({"dry-run", job}, options);
  }
  json bare() const { return json::parse(test::read_text(folder / "r.json"))["bare"]; }

  TempFolder folder;
  std::string job;

 private:
  Outcome with_report(std::vector<std::string> all, const std::vector<std::string>& options) const {
    all.insert(all.end(), {"--report", (folder / "r.json").string()});
    all.insert(all.end(), options.begin(), options.end());
    return run(all);
  }
};

TEST_CASE("A plan warns of a layer of which more than 5 % stay without plastic, and says how much") {
  const WedgeJob wedge("1.2");
  const Outcome outcome = wedge.plan();
  CHECK(outcome.code == 0);
  // A third of the length is narrower than 0.4 mm, and 0.6 mm of it are near the last bead: (19.4 ÷ 60)².
  CHECK(outcome.err.find("warning: layer 1 (z = 0.20 mm) leaves 10 %") != std::string::npos);
  const json bare = wedge.bare();
  CHECK(bare["area_mm2"].get<double>() == Approx(4.0).margin(0.4));
  CHECK(bare["share"].get<double>() == Approx(0.11).margin(0.012));
  CHECK(bare["walls_mm"].get<double>() == 0);
  CHECK(bare["layers_warned_of"] == 1);
}

TEST_CASE("A plan of a part that is mostly too thin is refused, unless that is allowed") {
  const Outcome refused = WedgeJob("0.5").plan();
  CHECK(refused.code == 2);
  CHECK(refused.err.find("leaves 6") != std::string::npos);
  CHECK(refused.err.find("--allow-bare") != std::string::npos);
  CHECK(WedgeJob("0.5").plan({"--allow-bare"}).code == 0);
  CHECK(WedgeJob("4").plan().err.find("warning") == std::string::npos);
}

TEST_CASE("A dry run warns of bare layers and refuses mostly bare ones as a plan does") {
  const WedgeJob wedge("1.2");
  const Outcome warned = wedge.dry_run();
  CHECK(warned.code == 0);
  CHECK(warned.err.find("warning: layer 1 (z = 0.20 mm) leaves 10 %") != std::string::npos);
  const json bare = wedge.bare();
  CHECK(wedge.plan().code == 0);
  CHECK(wedge.bare() == bare);

  const WedgeJob thin("0.5");
  const Outcome refused = thin.dry_run();
  CHECK(refused.code != 0);
  CHECK(refused.err.find("leaves 6") != std::string::npos);
  CHECK(refused.err.find("part.allow_bare") != std::string::npos);
  CHECK(thin.dry_run({"--allow-bare"}).code == 0);
}

TEST_CASE("The tip of a pointed part, which no bead fits, brings a warning and no refusal") {
  const TempFolder folder;
  folder.write("bench.toml", test::sample_profile);
  std::string model = "solid cone\n";
  const int sides = 24;
  const double pi = 3.14159265358979;
  const auto corner = [&](int i) {
    const double turn = 2 * pi * i / sides;
    return "vertex " + std::to_string(6 * std::cos(turn)) + " " + std::to_string(6 * std::sin(turn)) + " 0\n";
  };
  const auto facet = [&](const std::string& corners) {
    model += "facet normal 0 0 0\nouter loop\n" + corners + "endloop\nendfacet\n";
  };
  for (int i = 0; i < sides; ++i) {
    facet(corner(i) + corner((i + 1) % sides) + "vertex 0 0 6\n");
    facet(corner((i + 1) % sides) + corner(i) + "vertex 0 0 0\n");
  }
  const std::string cone = folder.write("cone.stl", model + "endsolid cone\n").string();
  const Outcome outcome =
      run({"plan", cone, "--profile", (folder / "bench.toml"), "-o", (folder / "o.gcode")});
  CHECK(outcome.code == 0);
  CHECK(outcome.err.find("leaves 100 % of its area without plastic") != std::string::npos);
}

TEST_CASE("A job can allow bare layers") {
  const WedgeJob thin("0.5");
  const std::string text = test::read_text(thin.job);
  thin.folder.write(
      "job.toml", text.substr(0, text.find("flow")) + "allow_bare = true\n" + text.substr(text.find("flow")));
  CHECK(thin.plan().code == 0);
}

}  // namespace
}  // namespace unicursal
