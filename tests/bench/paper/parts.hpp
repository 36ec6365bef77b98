// The parts that the methods are compared on: layers of jobs, and some that are made here. mm.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/model/part.hpp"
#include "core/planner/island_plan.hpp"

namespace unicursal::bench {

struct Part {
  std::string name;   ///< for file names
  std::string title;  ///< for people
  core::Layer layer;
  std::vector<core::Zone> zones;
  core::PlanOptions plan;  ///< without a seed

  double width() const { return plan.bead_width; }
  double area() const;
};

/// A square of 40 mm with this pattern.
Part square_part(const std::string& name, const std::string& title, core::PatternKind pattern);
/// Six rooms joined by passages of 2.6 bead widths, as the paper's Figure 26c has narrow passages.
Part narrow_part();
/// One layer of a job, or three of a job whose layers differ.
std::vector<Part> parts_of_job(const std::filesystem::path& file);

/// The same outline with one pattern everywhere.
Part with_pattern(Part part, const std::string& name, core::PatternKind pattern);

}  // namespace unicursal::bench
