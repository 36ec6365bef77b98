#include "host/job/sliced_job.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "host/job/colour_mixture.hpp"
#include "host/job/keys.hpp"
#include "host/job/profile_draft.hpp"
#include "host/job/written_job.hpp"
#include "host/job/zones.hpp"

namespace unicursal::host {
namespace {

constexpr int highest_tool = 99;

const char* const tool_remedy = "write a tool of the file, for example select = \"T0\"";

/// "T0"
int tool_named(const Section& zone) {
  const std::string name = zone.text("select", tool_remedy);
  int tool = -1;
  if (name.size() > 1 && (name.front() == 'T' || name.front() == 't')) {
    const auto [end, error] = std::from_chars(name.data() + 1, name.data() + name.size(), tool);
    if (error != std::errc() || end != name.data() + name.size()) tool = -1;
  }
  if (tool < 0 || tool > highest_tool) {
    zone.fail("select", "is \"" + name + "\", but a slicer's G-code has tools, which are T0, T1 and so on",
              tool_remedy);
  }
  return tool;
}

/// Only a tool and its mixture make sense.
Section tool_section(const Section& root, const toml::table& table, std::size_t index) {
  Section zone(root.file(), table, fmt::format("zone[{}]", index), keys::zone);
  for (const std::string& key : keys::zone) {
    if (zone.has(key) && key != "select" && key != "mixture")
      zone.fail(key, "is given for a slicer's G-code, whose beads lie where the slicer has put them",
                "leave it out");
  }
  if (const toml::node* mixture = zone.find("mixture"); mixture && mixture->is_table())
    zone.fail("mixture", "is a gradient, which a slicer's G-code cannot have",
              "write the name of a mixture, such as mixture = \"white\"");
  return zone;
}

std::string named(int tool) {
  return fmt::format("T{}", tool);
}

/// The mixture that a tool gets without a person's choice.
gcode::Shares usual_mixture(const gcode::SlicedTool& tool, const Profile& profile) {
  if (tool.mixture) return tool.mixture->shares();
  if (!tool.colour.empty()) return shares_near(tool.colour, profile);
  return one_feeder(static_cast<std::size_t>(std::max(tool.number, 0)), profile.printer.feeders);
}

std::string head(const std::filesystem::path& file, const std::string& profile,
                 const std::filesystem::path& folder) {
  return "# Written by `unicursal new`. unicursal-job(5) explains all keys.\nprinter = " +
         toml_text(profile) + "\n\n[part]\nfile = " + toml_text(name_in_job(file, folder)) + "\n";
}

}  // namespace

void refuse_sliced_keys(const Section& part) {
  for (const std::string& key : keys::sliced_part) {
    if (part.has(key) && key != "file")
      part.fail(key, "is only for a slicer's G-code", "leave it out, or name a .gcode file");
  }
}

void read_sliced(const Section& root, const Section& part, Job& job) {
  for (const std::string& key : keys::part) {
    if (part.has(key) &&
        std::find(keys::sliced_part.begin(), keys::sliced_part.end(), key) == keys::sliced_part.end())
      part.fail(key, "is given for a slicer's G-code, which is sliced already",
                "leave it out, or choose it in the slicer");
  }
  SlicedChoices choices;
  choices.tower = part.flag_or("tower", true, "write true or false");
  choices.allow_stops = part.flag_or("stops", false, "write true or false");
  job.print.flow = std::min(job.print.flow, job.profile.printer.max_flow);
  if (const toml::node* zones = root.find("zone")) {
    const toml::array* list = zones->as_array();
    std::vector<int> tools;
    for (std::size_t i = 0; list && i < list->size(); ++i) {
      const toml::table* table = (*list)[i].as_table();
      if (!table) break;  // read_zones() explains it
      const Section zone = tool_section(root, *table, i);
      tools.push_back(tool_named(zone));
      if (std::count(tools.begin(), tools.end(), tools.back()) > 1)
        zone.fail("select", "names " + named(tools.back()) + " a second time", "keep one of the zones");
    }
    ZonesAndMaterials read = read_zones(root, job.profile, job.warnings);
    for (std::size_t i = 0; i < tools.size(); ++i) choices.tools[tools[i]] = read.zones.at(i).material;
    job.print.materials = std::move(read.materials);
  }
  job.sliced = std::move(choices);
}

void choose_mixtures(Job& job, const gcode::SlicedSurvey& survey) {
  std::vector<std::string> used;
  for (const gcode::SlicedTool& tool : survey.tools) used.push_back(named(tool.number));
  for (const auto& [tool, material] : job.sliced->tools) {
    if (std::find(used.begin(), used.end(), named(tool)) != used.end()) continue;
    throw JobError(job.file.string(), "zone", "selects " + named(tool) + ", which the G-code does not use",
                   fmt::format("its tools are {}", fmt::join(used, ", ")));
  }
  std::vector<gcode::Material>& materials = job.print.materials;
  for (const gcode::SlicedTool& tool : survey.tools) {
    if (job.sliced->tools.contains(tool.number)) continue;
    const gcode::Mixture mixture(usual_mixture(tool, job.profile));
    auto same = std::find_if(materials.begin(), materials.end(),
                             [&](const gcode::Material& material) { return material.mixture == mixture; });
    if (same == materials.end())
      same = materials.insert(materials.end(), gcode::Material{named(tool.number), mixture, {}, false});
    job.sliced->tools[tool.number] = static_cast<std::size_t>(same - materials.begin());
  }
}

std::string plain_sliced_job(const std::filesystem::path& file, const std::filesystem::path& profile) {
  return head(file, profile.string(), file.parent_path());
}

std::string sliced_job(const std::filesystem::path& file, const gcode::SlicedSurvey& survey,
                       const Profile& profile, const std::filesystem::path& folder) {
  std::string text = head(file, name_in_job(profile.file, folder), folder);
  text += fmt::format("#tower = false       # leave out the wipe tower{}\n",
                      survey.tower_volume > 0 ? fmt::format(", {:.4g} mm³", survey.tower_volume) : "");
  text += "#stops = true        # it may wait for a person (M0, M600)\n";
  std::string mixtures = "\n[mixture]           # shares of the feeders\n";
  for (const gcode::SlicedTool& tool : survey.tools) {
    text += fmt::format("\n[[zone]]\nselect = \"T{0}\"  # {1:.4g} mm³{2}\nmixture = \"tool{0}\"\n",
                        tool.number, tool.volume, tool.colour.empty() ? "" : ", " + tool.colour);
    mixtures += fmt::format("tool{} = {}\n", tool.number, shares_in_toml(usual_mixture(tool, profile)));
  }
  return text + mixtures;
}

}  // namespace unicursal::host
