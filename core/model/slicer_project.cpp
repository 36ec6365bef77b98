#include "core/model/slicer_project.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <string_view>
#include <vector>

#include "core/drawing/css_colour.hpp"
#include "core/error.hpp"
#include "core/text/malformed.hpp"
#include "core/text/xml_document.hpp"

namespace unicursal::core {
namespace {

constexpr std::size_t most_filaments = 1000;
constexpr std::size_t largest_settings = 16u << 20;  ///< bytes

/// The value of a child <metadata key="…" value="…"/>; empty if it is absent.
std::string_view setting(const pugi::xml_node& node, std::string_view key) {
  for (const pugi::xml_node& entry : node.children("metadata")) {
    if (key == entry.attribute("key").value()) return entry.attribute("value").value();
  }
  return {};
}

std::size_t index_or_zero(std::string_view text) {
  return text.empty() ? 0 : xml_index(text);
}

ProjectPart part_of(const pugi::xml_node& node, std::string_view kind) {
  ProjectPart part;
  part.name = name_in(setting(node, "name"));
  part.filament = index_or_zero(setting(node, "extruder"));
  if (kind == "NegativeVolume" || kind == "negative_part") part.role = BodyRole::negative;
  if (kind == "ParameterModifier" || kind == "modifier_part") part.role = BodyRole::modifier;
  part.printed = kind.find("upport") == std::string_view::npos;  // SupportBlocker, support_enforcer and so on
  return part;
}

/// The files of PrusaSlicer and of Bambu Studio have the same outer form.
void read_objects(const pugi::xml_node& config, SlicerProject& project) {
  for (const pugi::xml_node& node : config.children("object")) {
    ProjectObject& object = project.objects[xml_index(node.attribute("id").value())];
    object.name = name_in(setting(node, "name"));
    object.filament = index_or_zero(setting(node, "extruder"));
    for (const pugi::xml_node& volume : node.children("volume")) {
      std::string_view kind = setting(volume, "volume_type");
      if (kind.empty() && setting(volume, "modifier") == "1") kind = "ParameterModifier";
      object.volumes.push_back({xml_index(volume.attribute("firstid").value()),
                                xml_index(volume.attribute("lastid").value()), part_of(volume, kind)});
    }
    for (const pugi::xml_node& part : node.children("part")) {
      object.parts[xml_index(part.attribute("id").value())] =
          part_of(part, part.attribute("subtype").value());
    }
  }
  for (const pugi::xml_node& node : config.children("plate")) {
    auto& plate = project.plates.emplace_back();
    for (const pugi::xml_node& instance : node.children("model_instance")) {
      plate.emplace(index_or_zero(setting(instance, "object_id")),
                    index_or_zero(setting(instance, "instance_id")));
    }
  }
}

bool read_config(ZipArchive& archive, const std::string& name, const std::string& file,
                 SlicerProject& project) {
  std::optional<std::string> bytes = archive.content(name);
  if (!bytes) return false;
  pugi::xml_document document;
  parse_xml(document, *bytes, file + ": " + name);
  try {
    read_objects(document.document_element(), project);
  } catch (const Malformed& problem) {
    throw ModelError(file, name, problem.what(), "save the project again");
  }
  return true;
}

void add_colour(SlicerProject& project, std::string_view text) {
  if (project.colours.size() < most_filaments) project.colours.push_back(css_colour(text).value_or(""));
}

/// PrusaSlicer's settings are comments: "; extruder_colour = #FF8000;#0000FF". An extruder without a colour
/// of its own has that of its filament.
void read_prusa_colours(ZipArchive& archive, SlicerProject& project) {
  const std::optional<std::string> text = archive.content("Metadata/Slic3r_PE.config");
  if (!text) return;
  const auto colours = [&](const std::string& key) {
    std::vector<std::string> result;
    const std::string start = "\n; " + key + " = ";
    const auto found = ("\n" + *text).find(start);
    if (found == std::string::npos) return result;
    std::string_view line = std::string_view(*text).substr(found + start.size() - 1);
    line = line.substr(0, line.find_first_of("\r\n"));
    while (result.size() < most_filaments) {
      const auto end = line.find(';');
      result.push_back(css_colour(line.substr(0, end)).value_or(""));
      if (end == std::string_view::npos) break;
      line.remove_prefix(end + 1);
    }
    return result;
  };
  const auto extruders = colours("extruder_colour"), filaments = colours("filament_colour");
  for (std::size_t i = 0; i < std::max(extruders.size(), filaments.size()); ++i) {
    std::string colour = i < extruders.size() ? extruders[i] : "";
    if (colour.empty() && i < filaments.size()) colour = filaments[i];
    project.colours.push_back(colour);
  }
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

/// The mean of filaments' colours by these weights, counted from filament 1; empty if one of them has none.
std::string blend(const std::vector<std::string>& colours, const std::map<std::size_t, double>& weights) {
  std::array<double, 3> sum{};
  double whole = 0;
  for (const auto& [filament, weight] : weights) {
    if (filament == 0 || filament > colours.size() || colours[filament - 1].empty()) return "";
    const unsigned long rgb = std::stoul(colours[filament - 1].substr(1), nullptr, 16);
    for (std::size_t i = 0; i < 3; ++i) sum[i] += weight * double(rgb >> (16 - 8 * i) & 255);
    whole += weight;
  }
  if (!(whole > 0)) return "";
  return fmt::format("#{:02x}{:02x}{:02x}", std::lround(sum[0] / whole), std::lround(sum[1] / whole),
                     std::lround(sum[2] / whole));
}

/// Slicers that blend filaments layer by layer number the blends behind the filaments. A blend is a row such
/// as "1,2,1,1,13,…,d0,…,1424": filaments, whether it is in use, percent of the second one; d1 if it was
/// deleted; a sequence of filaments, if it has one, counts more. Other fields say how it is laid.
void add_blends(SlicerProject& project, std::string_view definitions) {
  const std::vector<std::string> filaments = project.colours;
  for (const std::string_view row : split(definitions, ';')) {
    const std::vector<std::string_view> fields = split(row, ',');
    if (fields.size() < 5 || fields[2] != "1" ||
        std::find(fields.begin(), fields.end(), "d1") != fields.end())
      continue;
    std::map<std::size_t, double> weights;
    try {
      const double second = xml_number(fields[4]) / 100;
      weights[xml_index(fields[0])] += 1 - second;
      weights[xml_index(fields[1])] += second;
    } catch (const Malformed&) {
      weights.clear();
    }
    const std::string_view sequence = fields.back();
    constexpr std::size_t plain_fields = 7;
    if (fields.size() > plain_fields && !sequence.empty() &&
        sequence.find_first_not_of("0123456789") == std::string_view::npos) {
      weights.clear();
      for (const char filament : sequence) weights[std::size_t(filament - '0')] += 1;
    }
    add_colour(project, blend(filaments, weights));
  }
}

void read_bambu_colours(ZipArchive& archive, SlicerProject& project) {
  const std::optional<std::string> text = archive.content("Metadata/project_settings.config");
  if (!text || text->size() > largest_settings) return;
  const nlohmann::json settings = nlohmann::json::parse(*text, nullptr, false);
  const auto list = settings.is_object() ? settings.find("filament_colour") : settings.end();
  if (!settings.is_object() || list == settings.end() || !list->is_array()) return;
  for (const nlohmann::json& colour : *list)
    add_colour(project, colour.is_string() ? colour.get<std::string>() : "");
  const auto blends = settings.find("mixed_filament_definitions");
  if (blends != settings.end() && blends->is_string()) add_blends(project, blends->get<std::string>());
}

}  // namespace

Tint SlicerProject::tint(std::size_t filament) const {
  if (filament == 0) filament = 1;
  return {filament <= colours.size() ? colours[filament - 1] : "",
          {fmt::format("filament {}", filament), fmt::format("extruder {}", filament)}};
}

std::optional<SlicerProject> slicer_project(ZipArchive& archive, const std::string& file) {
  SlicerProject project;
  bool found = read_config(archive, "Metadata/Slic3r_PE_model.config", file, project);
  read_prusa_colours(archive, project);
  found = read_config(archive, "Metadata/model_settings.config", file, project) || found;
  if (project.colours.empty()) read_bambu_colours(archive, project);
  if (!found && project.colours.empty()) return std::nullopt;
  return project;
}

}  // namespace unicursal::core
