// Fuzzing: damaged files for the readers and the planner, and damaged input for the simulated printer, the
// link and the daemon. Input must be accepted or refused; anything else is a defect.
//
//   fuzz FOLDER TARGET SECONDS [FIRST]
//
// A round depends only on its number; FIRST is the number of the first round. The files of a round stay in
// FOLDER until the next round, so after a crash, a fault or a hang (a round of more than two minutes) they
// are the cause.
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/field/direction_file.hpp"
#include "core/model/read_part.hpp"
#include "core/planner/plan_island.hpp"
#include "core/text/file_bytes.hpp"
#include "host/job/job.hpp"
#include "host/job/load_job.hpp"
#include "tests/core/support/plan_faults.hpp"
#include "tests/core/support/random_islands.hpp"
#include "tests/fuzz/damage.hpp"
#include "tests/fuzz/http_target.hpp"
#include "tests/fuzz/kept.hpp"
#include "tests/fuzz/models.hpp"
#include "tests/fuzz/photos.hpp"
#include "tests/fuzz/replies.hpp"
#include "tests/fuzz/simulator.hpp"
#include "tests/fuzz/sliced.hpp"
#include "tests/fuzz/spool.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/paths.hpp"

namespace unicursal {
namespace {

namespace fs = std::filesystem;

constexpr unsigned longest_round = 120;  // s
constexpr double largest_island = 150;   // mm²; more takes too long to plan by the thousand
constexpr double bead_width = 0.5;       // mm

std::string sound_file(const std::string& name) {
  return core::file_bytes(unicursal::test::data_folder() / name);
}

fs::path write(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
  return file;
}

/// Reads the file as a part and cuts its first and last layers.
void read(const fs::path& file, const std::vector<std::string>& selects, bool strokes_are_contours = false) {
  core::PartSource source{{file}, 1.0, 0.2, {}};
  for (const std::string& select : selects) source.zones.push_back({select, {}, source.zones.size()});
  source.strokes_are_contours = strokes_are_contours;
  const auto part = core::read_part(source);
  if (part->layer_count() == 0) return;
  part->layer(0);
  part->layer(part->layer_count() - 1);
}

void drawing(const fs::path& folder, core::Random& random) {
  const std::size_t which = random.below(4);
  const std::string sound = which == 0   ? sound_file("two_zones.svg")
                            : which == 1 ? test::sample_drawing
                                         : sound_file("features.svg");
  read(write(folder / "drawing.svg", test::damaged(sound, random)), {"#0000ff", "#ff0000"},
       random.below(4) == 0);
}

/// The cube of the test data as binary STL.
std::string binary_cube() {
  std::string bytes(80, ' ');
  const auto add = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  add(std::uint32_t{12});
  static constexpr std::array<std::array<int, 3>, 12> faces{{{0, 2, 1},
                                                             {1, 2, 3},
                                                             {4, 5, 6},
                                                             {5, 7, 6},
                                                             {0, 1, 4},
                                                             {1, 5, 4},
                                                             {2, 6, 3},
                                                             {3, 6, 7},
                                                             {0, 4, 2},
                                                             {2, 4, 6},
                                                             {1, 3, 5},
                                                             {3, 7, 5}}};
  for (const auto& face : faces) {
    bytes.append(12, '\0');
    for (const int corner : face) {
      for (const int bit : {1, 2, 4}) add((corner & bit) != 0 ? 20.0f : 0.0f);
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

void mesh(const fs::path& folder, core::Random& random) {
  const std::string sound = random.below(2) == 0 ? sound_file("cube20.stl") : binary_cube();
  read(write(folder / "mesh.stl", test::damaged(sound, random)), {"mesh"});
}

void directions(const fs::path& folder, core::Random& random) {
  core::read_directions(
      write(folder / "directions.csv", test::damaged(sound_file("directions.csv"), random)));
}

void job(const fs::path& folder, core::Random& random) {
  const bool damage_profile = random.below(3) == 0;
  const std::string profile = test::sample_profile, text = test::sample_job;
  write(folder / "plate.svg", test::sample_drawing);
  write(folder / "bench.toml", damage_profile ? test::damaged(profile, random) : profile);
  host::load_job(write(folder / "job.toml", damage_profile ? text : test::damaged(text, random)));
}

/// Islands of a damaged drawing, with random patterns.
void plan(const fs::path& folder, core::Random& random) {
  std::vector<core::Zone> zones =
      core::test::random_patterns(random, unicursal::test::data_folder() / "directions.csv");
  zones.resize(2);
  zones[0].select = "#0000ff";
  zones[1].select = "#ff0000";
  const fs::path file = write(folder / "drawing.svg", test::damaged(test::sample_drawing, random));
  const auto part = core::read_part({{file}, 1.0, 0.2, zones});
  core::PlanOptions options;
  options.bead_width = bead_width;
  options.min_bead_width = 0.55 * bead_width;
  options.seed = random.below(1000);
  for (const core::Island& island : part->layer(0).islands) {
    if (core::area(island.outline) > largest_island) continue;
    const std::string fault =
        core::test::fault_of(core::plan_island(island, zones, options), island.outline, zones, bead_width);
    if (!fault.empty()) throw std::runtime_error(fault);
  }
}

const std::map<std::string, std::function<void(const fs::path&, core::Random&)>> targets{
    {"drawing", drawing},
    {"mesh", mesh},
    {"package", test::package},
    {"wavefront", test::wavefront},
    {"amf", test::amf},
    {"sliced", test::sliced},
    {"directions", directions},
    {"job", job},
    {"plan", plan},
    {"printer", test::printer},
    {"lines", test::lines},
    {"faults", test::faults},
    {"control", test::control},
    {"journal", test::journal},
    {"chunks", test::chunks},
    {"kept", test::kept_print},
    {"replies", test::read_replies},
    {"conversation", test::converse},
    {"http", test::http},
    {"form", test::form},
    {"photo", test::photo}};

/// Returns true if the file was read, and false if it was properly refused.
bool survives(const std::function<void(const fs::path&, core::Random&)>& target, const fs::path& folder,
              std::uint64_t number) {
  core::Random random(number);
  alarm(longest_round);
  try {
    target(folder, random);
    return true;
  } catch (const core::DataError&) {
    return false;
  }
}

int run(const std::string& name, const fs::path& folder, double seconds, std::uint64_t first) {
  const auto target = targets.find(name);
  if (target == targets.end()) throw std::runtime_error("no target of the name " + name);
  fs::create_directories(folder);
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  std::uint64_t number = first, read = 0;
  try {
    for (; std::chrono::steady_clock::now() < end; ++number) {
      if (survives(target->second, folder, number)) ++read;
    }
  } catch (const std::exception& error) {
    std::printf("%s, round %llu: %s; its files are in %s\n", name.c_str(),
                static_cast<unsigned long long>(number), error.what(), folder.c_str());
    return 1;
  }
  std::printf("%s: %llu files, %llu of them read, the others refused\n", name.c_str(),
              static_cast<unsigned long long>(number - first), static_cast<unsigned long long>(read));
  return 0;
}

}  // namespace
}  // namespace unicursal

int main(int count, char** words) {
  if (count < 4) {
    std::fprintf(
        stderr,
        "usage: fuzz FOLDER "
        "drawing|mesh|package|wavefront|amf|directions|job|plan|printer|lines|faults|control|journal|"
        "chunks|kept|replies|conversation|http|form|photo "
        "SECONDS [FIRST]\n");
    return 2;
  }
  std::signal(SIGPIPE, SIG_IGN);  // as the program itself does
  return unicursal::run(words[2], words[1], std::atof(words[3]),
                        count > 4 ? std::strtoull(words[4], nullptr, 10) : 0);
}
