// Reproduces the paper's comparisons as one page: bench_paper [--quick] [--only NAME] [FOLDER] [JOB.toml …]
//
// The page is FOLDER/index.html, by default in unicursal-out/paper. Jobs are added to the parts that are
// always there: the example's leaf and cube, squares, and rooms with narrow passages. --only leaves out all
// parts whose names do not contain NAME, and the series; --quick takes fewer shapes and values of d.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/bench/paper/check.hpp"
#include "tests/bench/paper/claims.hpp"
#include "tests/bench/paper/methods.hpp"
#include "tests/bench/paper/page.hpp"

namespace unicursal::bench {
namespace {

struct Asked {
  bool quick = false;
  std::string only;
  std::filesystem::path folder = "unicursal-out/paper";
  std::vector<std::filesystem::path> jobs;
};

Asked asked_by(int argc, char** argv) {
  Asked asked;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--quick") == 0) {
      asked.quick = true;
    } else if (std::strcmp(argv[i], "--only") == 0 && i + 1 < argc) {
      asked.only = argv[++i];
    } else if (std::filesystem::path(argv[i]).extension() == ".toml") {
      asked.jobs.emplace_back(argv[i]);
    } else {
      asked.folder = argv[i];
    }
  }
  return asked;
}

std::vector<Part> parts_for(const Asked& asked) {
  const std::filesystem::path examples = UNICURSAL_EXAMPLES;
  std::vector<Part> parts = parts_of_job(examples / "leaf.toml");
  parts.push_back(parts_of_job(examples / "cube.toml").front());  // all its layers are alike
  parts.push_back(square_part("square", "Square, isotropic", core::PatternKind::isotropic));
  parts.push_back(
      square_part("square-parallel", "Square, parallel to the border", core::PatternKind::parallel));
  parts.push_back(narrow_part());
  for (const std::filesystem::path& job : asked.jobs) {
    for (Part& part : parts_of_job(job)) parts.push_back(std::move(part));
  }
  std::erase_if(parts, [&](const Part& part) { return part.name.find(asked.only) == std::string::npos; });
  return parts;
}

void progress(const std::string& text) {
  fmt::print("{}\n", text);
  std::fflush(stdout);
}

PartReport report_of(const Part& part, const std::filesystem::path& folder) {
  PartReport report;
  report.part = part;
  for (const std::string_view name : method_names) {
    const Run run = run_method(name, part);
    const Figures f = figures(part, run, folder);
    progress(fmt::format("{:18} {:24} CV {:.3f}, E {:.4f}, gaps {:.2f} %, travels {}, {:.2f} s", part.name,
                         title_of(name), f.spacing.variation, f.coverage, 100 * f.constant.gaps, f.travels,
                         f.seconds));
    if (name == "ours") {
      report.operations = run.operations;
      report.graph = run.graph, report.cycle = run.cycle, report.fairing = run.fairing;
    }
    report.methods[std::string(name)] = f;
  }
  report.joining = joining_of(part);
  return report;
}

/// The part that stands for the paper's brain: a job of that name, else the leaf.
const Part* brain_among(const std::vector<PartReport>& parts) {
  for (const char* name : {"brain", "leaf"}) {
    for (const PartReport& report : parts) {
      if (report.part.name.starts_with(name)) return &report.part;
    }
  }
  return nullptr;
}

const core::Polygon& largest_island(const Part& part) {
  return part.layer.islands.front().outline;
}

void add_convergence(Report& report) {
  for (const PartReport& part : report.parts) {
    const bool narrow = part.part.name == "narrow";
    const bool brain = part.part.name.starts_with("brain") || part.part.name == "leaf";
    const auto grown = part.methods.find("growth");
    if ((!narrow && !brain) || grown == part.methods.end()) continue;
    const CostAtD cost = cost_at(2.05 * part.part.width(), largest_island(part.part));
    report.convergence.push_back({part.part.title, static_cast<std::size_t>(cost.fairing_steps),
                                  grown->second.iterations, grown->second.finished,
                                  narrow ? "paper, narrow passages (26c, d): 260 against 110 000"
                                         : "paper, another shape (26a, b): 170 against 1700"});
  }
}

void add_series(Report& report, const Asked& asked, const std::filesystem::path& folder) {
  progress("spacing against d");
  const std::vector<core::Polygon> some = shapes(asked.quick ? 6 : 30);
  for (const double d :
       asked.quick ? std::vector<double>{1.25, 2.0} : std::vector<double>{0.8, 1.0, 1.25, 1.5, 1.75, 2.0})
    report.spacing.push_back(spacing_at(d, some));
  progress("spacing of whole plans");
  report.held_width = 0.8;
  report.held = held_spacing(report.held_width, some);
  const Part* brain = brain_among(report.parts);
  if (brain == nullptr) return;
  progress("time against d");
  report.cost_part = brain->title;
  for (const double d :
       asked.quick ? std::vector<double>{1.2, 1.7, 2.4} : std::vector<double>{0.6, 0.8, 1.0, 1.4, 2.0, 2.8})
    report.costs.push_back(cost_at(d, largest_island(*brain)));
  progress("objectives");
  for (const auto& [name, kind] : {std::pair{"isotropic", core::PatternKind::isotropic},
                                   std::pair{"anisotropic", core::PatternKind::anisotropic},
                                   std::pair{"parallel", core::PatternKind::parallel},
                                   std::pair{"orthogonal", core::PatternKind::orthogonal}}) {
    const Part part = with_pattern(*brain, name, kind);
    report.objectives.push_back({name, figures(part, run_method("ours", part), folder)});
  }
  progress("smoothing");
  const Part part = with_pattern(*brain, "smoothing", core::PatternKind::isotropic);
  report.smoothing = smoothing_of(part);
  report.smooth = figures(part, report.smoothing->with, folder);
  report.unsmooth = figures(part, report.smoothing->without, folder);
}

int run(const Asked& asked) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<std::string> faults = faults_of_methods();
  for (const std::string& fault : faults) fmt::print(stderr, "bench_paper: {}\n", fault);
  if (!faults.empty()) return 1;
  std::filesystem::create_directories(asked.folder);
  Report report;
  for (const Part& part : parts_for(asked)) report.parts.push_back(report_of(part, asked.folder));
  add_convergence(report);
  if (asked.only.empty()) add_series(report, asked, asked.folder);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::vector<Claim> said = claims(report);
  write_page(asked.folder, report, said);
  for (const Claim& claim : said) {
    if (claim.holds()) continue;
    progress("does not hold: " + claim.said);
    for (const std::string& one : claim.against) progress("  " + one);
  }
  const auto holding = std::count_if(said.begin(), said.end(), [](const Claim& c) { return c.holds(); });
  progress(fmt::format("{} of {} claims hold; {} in {:.0f} s", holding, said.size(),
                       (asked.folder / "index.html").string(), report.seconds));
  return 0;
}

}  // namespace
}  // namespace unicursal::bench

int main(int argc, char** argv) {
  try {
    return unicursal::bench::run(unicursal::bench::asked_by(argc, argv));
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_paper: {}\n", error.what());
    return 2;
  }
}
