// Bad input ends with one sentence and exit code 2, and the printer receives nothing.
#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/host/support/child_process.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal {
namespace {

using test::Outcome;
using test::replaced;
using test::run;
using test::sample_drawing;
using test::sample_job;
using test::sample_profile;
using test::TempFolder;

/// A pseudo-terminal that records whether anything was ever written to it.
class QuietPrinter {
 public:
  QuietPrinter() : master_(posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK)) {
    grantpt(master_);
    unlockpt(master_);
    path_ = ptsname(master_);
    slave_ = open(path_.c_str(), O_RDWR | O_NOCTTY);
  }
  ~QuietPrinter() {
    close(slave_);
    close(master_);
  }
  QuietPrinter(const QuietPrinter&) = delete;
  QuietPrinter& operator=(const QuietPrinter&) = delete;

  const std::string& path() const { return path_; }
  bool heard_nothing() const {
    char byte = 0;
    return read(master_, &byte, 1) <= 0;
  }

 private:
  int master_, slave_ = -1;
  std::string path_;
};

const char* const tetrahedron_facets[] = {"0 0 0  0 10 0  10 0 0", "0 0 0  10 0 0  0 0 10",
                                          "0 0 0  0 0 10  0 10 0", "10 0 0  0 10 0  0 0 10"};

std::string stl(std::size_t facets) {
  std::string text = "solid part\n";
  for (std::size_t i = 0; i < facets; ++i) {
    double v[9];
    std::istringstream numbers(tetrahedron_facets[i]);
    for (double& value : v) numbers >> value;
    text += "facet normal 0 0 0\nouter loop\n";
    for (int k = 0; k < 9; k += 3) {
      text += "vertex " + std::to_string(v[k]) + ' ' + std::to_string(v[k + 1]) + ' ' +
              std::to_string(v[k + 2]) + '\n';
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid part\n";
}

struct Bad {
  std::string name;
  std::string job = sample_job, drawing = sample_drawing;
  std::vector<std::string> words;  ///< that the sentence must contain
};

std::string mesh_job(const std::string& file) {
  return "printer = \"bench.toml\"\n[part]\nfile = \"" + file +
         "\"\nlayer_height = 0.2\nbead_width = 1.0\n[[zone]]\nselect = \"" + file +
         "\"\nmixture = \"sea\"\n[mixture]\nsea = [1, 1, 1]\n";
}

std::vector<Bad> bad_jobs() {
  return {
      {"missing drawing", replaced(sample_job, "plate.svg", "lost.svg"), sample_drawing, {"lost.svg"}},
      {"empty drawing",
       sample_job,
       "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"9mm\" height=\"9mm\"/>",
       {"plate.svg"}},
      {"mesh without thickness", mesh_job("sheet.stl"), sample_drawing, {"sheet.stl", "no volume"}},
      {"NaN in a mesh", mesh_job("nan.stl"), sample_drawing, {"nan.stl"}},
      {"zero height",
       replaced(sample_job, "height = 0.4", "height = 0"),
       sample_drawing,
       {"line 5", "part.height"}},
      {"mixture of zeros",
       replaced(sample_job, "[0.6, 0.0, 0.2]", "[0, 0, 0]"),
       sample_drawing,
       {"line 21", "mixture.sea", "zero"}},
      {"unknown key",
       replaced(sample_job, "flow", "flwo"),
       sample_drawing,
       {"line 8", "did you mean \"flow\"?"}},
      {"part wider than the bed",
       sample_job,
       replaced(replaced(sample_drawing, "20mm", "200mm"), "16mm", "160mm"),
       {"200.0 x 160.0", "120.0 x 100.0", "bed"}},
      {"part higher than the bed",
       replaced(sample_job, "height = 0.4", "height = 81"),
       sample_drawing,
       {"81.0", "80.0", "bed"}},
      {"part placed off the bed",
       replaced(sample_job, "flow = 3.0", "place = [5, 50]"),
       sample_drawing,
       {"part.place", "-5.0", "center"}},
      {"no such colour", replaced(sample_job, "#ff0000", "#00ff00"), sample_drawing, {"#00ff00"}},
  };
}

void check_refused(const Outcome& outcome, const Bad& bad) {
  INFO(bad.name << ": " << outcome.err);
  CHECK(outcome.code == 2);
  CHECK(outcome.err.rfind("unicursal: ", 0) == 0);
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
  CHECK(outcome.err.find("; ") != std::string::npos);
  for (const std::string& word : bad.words) {
    INFO(word);
    CHECK(outcome.err.find(word) != std::string::npos);
  }
}

}  // namespace

TEST_CASE("Bad jobs are refused with a sentence, and the printer hears nothing") {
  const TempFolder folder;
  folder.write("bench.toml", sample_profile);
  folder.write("sheet.stl", stl(1));
  folder.write("nan.stl", replaced(stl(4), "10.000000", "nan"));
  const QuietPrinter printer;
  for (const Bad& bad : bad_jobs()) {
    folder.write("plate.svg", bad.drawing);
    const std::string job = folder.write("job.toml", bad.job).string();
    check_refused(run({"print", job, "--port", printer.path()}), bad);
    check_refused(run({"dry-run", job}), bad);
    check_refused(run({"plan", job, "-o", (folder / "out.gcode").string()}), bad);
    CHECK_FALSE(std::filesystem::exists(folder / "out.gcode"));
  }
  CHECK(printer.heard_nothing());
}

TEST_CASE("The notes on a drawing come before its refusal") {
  const TempFolder folder;
  folder.write("bench.toml", sample_profile);
  folder.write("lines.svg",
               "<svg xmlns='http://www.w3.org/2000/svg' width='20mm' height='16mm' viewBox='0 0 20 16'>"
               "<rect id='cut' width='9' height='9' fill='none' stroke='red' stroke-width='0.1'/></svg>");
  const std::string job = folder.write("job.toml", replaced(sample_job, "plate.svg", "lines.svg")).string();
  for (const auto& words : {std::vector<std::string>{"dry-run", job},
                            std::vector<std::string>{"inspect", (folder / "lines.svg").string()}}) {
    const Outcome outcome = run(words);
    INFO(outcome.err);
    CHECK(outcome.code == 2);
    const auto note = outcome.err.find("note: line 1: <rect id=\"cut\">"),
               refusal = outcome.err.find("unicursal: ");
    CHECK(note < refusal);
    CHECK(refusal < outcome.err.find("outline = \"strokes\" in [part] if they are contours"));
  }
}

TEST_CASE("A missing job, an unknown option and a wrong range are refused with code 2") {
  const TempFolder folder;
  folder.write("bench.toml", sample_profile);
  folder.write("plate.svg", sample_drawing);
  const std::string job = folder.write("job.toml", sample_job).string();
  const std::string out = (folder / "c.txt").string();
  const std::vector<std::vector<std::string>> commands = {
      {"dry-run", (folder / "none.toml").string()},
      {"dry-run"},
      {"dry-run", job, "--colour"},
      {"dry-run", job, "--speed", "-1"},
      {"dry-run", job, "--layers", "x"},
      {"dry-run", job, "--layers", "7:9"},
      {"dry-run", job, "--profile", (folder / "none.toml").string()},
      {"dry-run", job, "--picture", job},
      {"curve", job, "--layer", "2", "-o", out},
      {"curve", job, "--layer", "0", "--island", "1", "-o", out},
      {"curve", job, "--layer", "0", "-o", (folder / "c.bmp").string()},
      {"dry-run", job, "--speed", "nan"},
      {"simulate", "--speed", "inf"},
      {"simulate", "--pixel", "nan"},
      {"plan", job},
      {"plan", job, "-o", ""},
      {"queue", "--remove", "-1"},
      {"curve", job, "--preset", "fast"},
      {"fly"},
      {}};
  for (const auto& command : commands) {
    const Outcome outcome = run(command);
    INFO((command.empty() ? "" : command.front()) << ": " << outcome.err);
    CHECK(outcome.code == 2);
    CHECK(outcome.err.rfind("unicursal: ", 0) == 0);
  }
  CHECK_FALSE(std::filesystem::exists(out));
}

TEST_CASE("A port that does not exist is reported, and no files are left behind") {
  const TempFolder folder;
  folder.write("bench.toml", sample_profile);
  folder.write("plate.svg", sample_drawing);
  const std::string job = folder.write("job.toml", sample_job).string();
  const Outcome outcome =
      run({"print", job, "--port", (folder / "ttyNONE").string(), "--report", (folder / "r.json").string()});
  INFO(outcome.err);
  CHECK(outcome.code == 2);
  CHECK(outcome.err.rfind("unicursal: ", 0) == 0);
  CHECK_FALSE(std::filesystem::exists(folder / "r.json"));
  CHECK_FALSE(std::filesystem::exists(folder / "r.json.part"));
}

TEST_CASE("An unknown command is named, and the command that it resembles") {
  const Outcome outcome = run({"fly"});
  CHECK(outcome.code == 2);
  CHECK(outcome.err.find("\"fly\"") != std::string::npos);
  CHECK(outcome.err.find("did you mean") == std::string::npos);
  CHECK(run({"prnt", "job.toml"}).err.find("did you mean \"print\"?") != std::string::npos);
  CHECK(run({"queu", "--jobs"}).err.find("did you mean \"queue\"?") != std::string::npos);
}

TEST_CASE("Outputs never overwrite the files of the job or one another") {
  const TempFolder folder;
  const auto profile = folder.write("bench.toml", sample_profile);
  const auto drawing = folder.write("plate.svg", sample_drawing);
  const auto job = folder.write("job.toml", sample_job);
  std::filesystem::create_symlink(drawing, folder / "link.svg");
  const std::string out = (folder / "out.gcode").string();
  for (const auto& taken : {profile, drawing, job, folder / "link.svg"}) {
    INFO(taken);
    CHECK(run({"plan", job.string(), "-o", taken.string()}).code == 2);
    CHECK(run({"plan", job.string(), "-o", out, "--report", taken.string()}).code == 2);
  }
  CHECK(run({"plan", job.string(), "-o", out, "--report", (folder / "./out.gcode").string()}).code == 2);
  CHECK(run({"curve", job.string(), "--layer", "0", "-o", drawing.string()}).code == 2);
  const auto faults = folder.write("faults.txt", "noise:0.01\n");
  const auto simulate = [&](const std::vector<std::string>& outputs) {
    std::vector<std::string> all{"simulate",       "--once",   "--profile",
                                 profile.string(), "--faults", faults.string()};
    all.insert(all.end(), outputs.begin(), outputs.end());
    return run(all).code;
  };
  CHECK(simulate({"--report", profile.string()}) == 2);
  CHECK(simulate({"--transcript", faults.string()}) == 2);
  CHECK(simulate({"--rasters", profile.string()}) == 2);
  CHECK(simulate({"--report", out, "--transcript", out}) == 2);
  CHECK(run({"dry-run", job.string(), "--faults", faults.string(), "--report", faults.string()}).code == 2);
  CHECK(test::read_text(faults) == "noise:0.01\n");
  CHECK(test::read_text(profile) == sample_profile);
  CHECK(test::read_text(drawing) == sample_drawing);
  CHECK(test::read_text(job) == sample_job);
  CHECK_FALSE(std::filesystem::exists(out));
}

TEST_CASE("A part too thin for a bead is refused before anything is heated") {
  const TempFolder folder;
  folder.write("bench.toml", sample_profile);
  folder.write(
      "plate.svg",
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"20mm\" height=\"16mm\" viewBox=\"0 0 20 16\">"
      "<rect x=\"0\" y=\"0\" width=\"20\" height=\"0.3\" fill=\"#0000ff\"/>"
      "<rect x=\"0\" y=\"4\" width=\"20\" height=\"0.3\" fill=\"#ff0000\"/></svg>");
  const std::string job = folder.write("job.toml", sample_job).string();
  const QuietPrinter printer;
  const Bad bad{"thin", {}, {}, {"nowhere wide enough", "bead_width"}};
  check_refused(run({"print", job, "--port", printer.path()}), bad);
  check_refused(run({"dry-run", job}), bad);
  check_refused(run({"plan", job, "-o", (folder / "out.gcode").string()}), bad);
  CHECK(printer.heard_nothing());
  CHECK_FALSE(std::filesystem::exists(folder / "out.gcode"));
}

#ifndef __SANITIZE_ADDRESS__  // its shadow memory counts as data
TEST_CASE("A drawing that needs more memory than the program may use is refused with a sentence") {
  const TempFolder folder;
  std::string dots;
  for (int i = 0; i < 200000; ++i)
    dots += fmt::format("M{:.1f} {:.1f}h.1v.1h-.1z", i % 500 * .2, i / 500 * .2);
  const std::string file =
      folder
          .write("dots.svg",
                 "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 100 80' width='100mm' "
                 "height='80mm'><path d='" +
                     dots + "'/></svg>")
          .string();
  rlimit before{};
  REQUIRE(getrlimit(RLIMIT_DATA, &before) == 0);
  const rlimit little{80u << 20, before.rlim_max};
  const auto limited = [&](const std::vector<std::string>& arguments) {
    REQUIRE(setrlimit(RLIMIT_DATA, &little) == 0);  // the child inherits it
    test::Child child(arguments);
    REQUIRE(setrlimit(RLIMIT_DATA, &before) == 0);
    return child.wait();
  };
  const Bad bad{"memory", {}, {}, {"dots.svg", "more memory"}};
  check_refused(limited({"inspect", file}), bad);
  check_refused(limited({"dry-run", file}), bad);
}
#endif

TEST_CASE("Names and texts of files reach the terminal without control characters") {
  const TempFolder folder;
  folder.write("bench.toml", sample_profile);
  folder.write("plate.svg", sample_drawing);
  const auto job = folder.write(
      "job.toml", replaced(sample_job, "plate.svg", "d\\u00FCnn\\u001b]0;title\\u0007\\u0000\\u009b31m.svg"));
  const Outcome outcome = run({"plan", job.string(), "-o", (folder / "out.gcode").string()});
  INFO(outcome.err);
  CHECK(outcome.code == 2);
  CHECK(outcome.err.find_first_of(std::string("\x1b\x07\0", 3)) == std::string::npos);
  CHECK(outcome.err.find("d\u00FCnn\\x1b]0;title\\x07") != std::string::npos);
  CHECK(outcome.err.find("\xc2\x9b") == std::string::npos);
  CHECK(outcome.err.find("; ") != std::string::npos);  // the sentence is not cut
}

}  // namespace unicursal
