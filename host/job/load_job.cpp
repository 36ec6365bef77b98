#include "host/job/load_job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/model/read_part.hpp"
#include "host/job/keys.hpp"
#include "host/job/model_job.hpp"
#include "host/job/placing.hpp"
#include "host/job/print_keys.hpp"
#include "host/job/settings_file.hpp"
#include "host/job/sliced_file.hpp"
#include "host/job/sliced_job.hpp"
#include "host/job/usual_profile.hpp"
#include "host/job/zones.hpp"

namespace unicursal::host {
namespace {

constexpr double least_flow = 0.01, most_flow = 1000;  ///< mm³/s; below, moves are slower than firmwares can

/// Spacing of the curve ÷ distance of the seeds; the inverse of what the planner takes (tests/bench/spacing).
constexpr double bead_width_per_seed_distance = 1 / 2.05;

/// Far above anything printable, so that a typing error is reported instead of filling the memory.
constexpr double greatest_length = 10000;  // mm

constexpr double least_layer_height = 0.02;  ///< mm; below what the z axes of such printers can step

/// Plausible seed distances, in bead widths; outside, one of the two numbers is a typing error.
constexpr double least_seed_distance = 0.5;
constexpr double greatest_seed_distance = 4;

const char* const place_remedy = "write \"center\", \"as-is\" or [x, y] in mm on the bed";

std::vector<std::filesystem::path> read_files(const Section& part) {
  const char* const remedy =
      "name a drawing (.svg), meshes (.stl, .3mf, .obj, .amf), several in a list, or a slicer's .gcode";
  const toml::node* node = part.find("file");
  if (!node) part.fail("file", "is missing", remedy);
  const std::filesystem::path folder = part.file().parent_path();
  if (!node->is_array()) return {folder / part.text("file", remedy)};
  std::vector<std::filesystem::path> files;
  for (const toml::node& item : *node->as_array()) {
    const std::optional<std::string> name = item.value<std::string>();
    if (!name) part.fail("file", "holds something that is not a text", remedy);
    files.push_back(folder / *name);
  }
  if (files.empty()) part.fail("file", "is an empty list", remedy);
  return files;
}

double read_layer_height(const Section& part, const char* key, double nozzle) {
  const std::string remedy = fmt::format("write for example {} = 0.2", key);
  const double height = part.number(key, {0, greatest_length, true, "mm"}, remedy);
  if (height < least_layer_height) {
    part.fail(key, fmt::format("is {} mm, thinner than any printer can lay", height), remedy);
  }
  if (height > nozzle) {
    part.fail(key,
              fmt::format("is {} mm, more than the nozzle's opening of {} mm: beads would not stick", height,
                          nozzle),
              "lower it, or choose a profile with another nozzle");
  }
  return height;
}

/// What each part has of its own.
core::PartSource read_shape(const Section& part) {
  core::PartSource source;
  source.files = read_files(part);
  const Range length{0, greatest_length, true, "mm"};
  const bool drawing = std::any_of(source.files.begin(), source.files.end(), core::is_drawing_file);
  if (const toml::node* outline = part.find("outline")) {
    if (!drawing) part.fail("outline", "is for drawings, but the part is made of meshes", "remove it");
    source.strokes_are_contours = part.choice("outline", *outline, {"fills", "strokes"}) == "strokes";
  }
  if (drawing || part.has("height")) {
    source.height =
        part.number("height", length, "write how high the drawing is to become, for example height = 1.0");
  }
  return source;
}

core::PartSource read_source(const Section& part, double nozzle) {
  core::PartSource source = read_shape(part);
  source.layer_height = read_layer_height(part, "layer_height", nozzle);
  if (part.has("first_layer_height")) {
    source.first_layer_height = read_layer_height(part, "first_layer_height", nozzle);
  }
  return source;
}

std::size_t read_copies(const Section& part) {
  constexpr double most = 1000;
  const char* const remedy = "write a whole number, for example copies = 4";
  const double copies = part.number_or("copies", 1, between(1, most, ""), remedy);
  if (copies != std::floor(copies)) part.fail("copies", "is not a whole number", remedy);
  return static_cast<std::size_t>(copies);
}

Placement read_place(const Section& part) {
  Placement place;
  const toml::node* node = part.find("place");
  if (!node) return place;
  if (!node->is_array()) {
    if (!node->is_string()) part.fail("place", "is neither a name nor a point", place_remedy);
    const std::string name = part.choice("place", *node, {"center", "as-is"});
    place.kind = name == "center" ? Placement::Kind::center : Placement::Kind::as_is;
    return place;
  }
  const auto point =
      part.numbers_or<2>("place", {0, 0}, between(-greatest_length, greatest_length, "mm"), place_remedy);
  place.kind = Placement::Kind::at;
  place.point = {point[0], point[1]};
  return place;
}

std::optional<double> read_deposit(const Section& part, const gcode::Printer& printer) {
  const toml::node* node = part.find("deposit");
  if (!node) return {};
  if (!node->is_table()) {
    part.choice("deposit", *node, {"fill"});
    return {};
  }
  const Section deposit = part.section("deposit", keys::deposit, "write \"fill\" or { width = 0.4 }");
  const Range range{0, printer.bead_width_range[1], true, "mm"};
  return deposit.number("width", range, "write a width that the nozzle can lay");
}

void check_seed_distance(const Section& part, double distance, double bead_width) {
  const double least = least_seed_distance * bead_width, greatest = greatest_seed_distance * bead_width;
  if (distance >= least && distance <= greatest) return;
  part.fail(
      "seed_distance",
      fmt::format("is {:g} mm, which does not go with beads {:g} mm wide: between {:g} and {:g} mm does",
                  distance, bead_width, least, greatest),
      "leave out one of the two, or correct it");
}

void read_bead_width(const Section& part, Job& job) {
  const char* const remedy = "write for example bead_width = 0.45";
  const Range length{0, greatest_length, true, "mm"};
  if (part.has("seed_distance")) {
    job.seed_distance = part.number("seed_distance", length, "write the paper's d in mm, or leave it out");
  }
  if (!part.has("bead_width") && job.seed_distance) {
    job.bead_width = bead_width_from_seed_distance(*job.seed_distance);
  } else {
    job.bead_width = part.number("bead_width", length, remedy);
  }
  const auto [least, greatest] = job.profile.printer.bead_width_range;
  if (job.bead_width < least || job.bead_width > greatest) {
    part.fail(part.has("bead_width") ? "bead_width" : "seed_distance",
              fmt::format("asks for beads {} mm wide, but the printer lays {} to {} mm", job.bead_width,
                          least, greatest),
              "choose a width in that range, or a profile with another nozzle");
  }
  if (job.seed_distance) check_seed_distance(part, *job.seed_distance, job.bead_width);
}

double read_paint_depth(const Section& part, double bead_width) {
  return part.number_or("paint_depth", usual_paint_depth(bead_width), {0, greatest_length, true, "mm"},
                        "write how deep painted colours reach, in mm");
}

void read_flow(const Section& part, Job& job) {
  const double greatest = job.profile.printer.max_flow;
  job.print.flow = std::min(job.print.flow, greatest);
  const toml::node* node = part.find("flow");
  if (!node) return;
  if (node->is_string()) {
    part.choice("flow", *node, {"auto"});
    job.print.automatic_flow = true;
    return;
  }
  job.print.flow =
      part.number("flow", between(least_flow, most_flow, "mm³/s"), "write for example flow = 2.0");
  if (job.print.flow > greatest) {
    part.fail("flow",
              fmt::format("is {} mm³/s, but the printer melts at most {} mm³/s", job.print.flow, greatest),
              "lower it, or raise extruder.max_flow in the profile if that is wrong");
  }
}

void read_perimeters(const Section& part, Job& job) {
  const double count =
      part.number_or("perimeters", 0, between(0, 100, ""), "write a whole number of contours");
  job.perimeters = static_cast<int>(count);
  if (count != job.perimeters) part.fail("perimeters", "is not a whole number", "write for example 1");
}

void read_seam(const Section& part, Job& job) {
  const toml::node* node = part.find("seam");
  if (!node) return;
  const std::string seam =
      part.choice("seam", *node, {"hidden", "scattered", "aligned", "none-extra-travel"});
  if (seam == "scattered") job.print.seam = gcode::Seam::scattered;
  if (seam == "aligned") job.print.seam = gcode::Seam::aligned;
  if (seam == "none-extra-travel") job.print.seam = gcode::Seam::nearest;
}

std::filesystem::path profile_path(const Section& root, const std::optional<std::filesystem::path>& chosen) {
  if (chosen) return *chosen;
  std::filesystem::path path = root.file().parent_path() /
                               root.text("printer", "name a profile in the job, or give one with --profile");
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    root.fail("printer", fmt::format("names {}, which does not exist", path.string()),
              "check the path, or give a profile with --profile");
  }
  return path;
}

}  // namespace

double bead_width_from_seed_distance(double d) {
  return bead_width_per_seed_distance * d;
}

namespace {

constexpr const char* part_remedy = "write [part] and below it file, layer_height and bead_width";

/// The tables of the parts: [part], or several [[part]].
std::vector<Section> part_sections(const Section& root) {
  constexpr std::size_t most_parts = 100;
  const toml::node* node = root.find("part");
  const toml::array* list = node ? node->as_array() : nullptr;
  if (!list) return {root.section("part", keys::part, part_remedy)};
  if (list->empty() || !list->is_homogeneous<toml::table>())
    root.fail("part", "is not a list of parts", part_remedy);
  if (list->size() > most_parts)
    root.fail("part", fmt::format("has more than {} parts", most_parts), "print them in several jobs");
  std::vector<Section> sections;
  for (const toml::node& item : *list) {
    const std::string name = fmt::format("part[{}]", sections.size());
    const toml::table& table = *item.as_table();
    if (sections.empty()) {
      sections.emplace_back(root.file(), table, name, keys::part);
      continue;
    }
    const Section any(root.file(), table, name, keys::part);
    for (const std::string& key : keys::part) {
      if (any.has(key) &&
          std::find(keys::more_part.begin(), keys::more_part.end(), key) == keys::more_part.end())
        any.fail(key, "is given for a further part, but holds for the whole print",
                 "write it in the first [[part]]");
    }
    sections.push_back(any);
  }
  return sections;
}

void read_more_parts(const std::vector<Section>& sections, Job& job) {
  for (std::size_t i = 1; i < sections.size(); ++i) {
    PlatePart part{read_shape(sections[i]), {}, read_copies(sections[i])};
    part.source.layer_height = job.source.layer_height;
    part.source.first_layer_height = job.source.first_layer_height;
    part.shaping = {read_pose(sections[i], part.source), read_paint_depth(sections[i], job.bead_width)};
    part.source.zones = job.source.zones;
    job.more.push_back(std::move(part));
  }
}

/// Directions from a file, and a part's own coordinates, mean one part.
void check_plate(const Section& part, const Job& job) {
  if (!is_plate(job)) return;
  if (job.place.kind == Placement::Kind::as_is)
    part.fail("place", "is \"as-is\", but several parts are arranged on the bed",
              "write \"center\" or a point");
  for (const core::Zone& zone : job.source.zones) {
    if (zone.pattern.kind != core::PatternKind::field) continue;
    part.fail(job.copies > 1 ? "copies" : "file",
              "makes several parts, but a zone takes its directions from a file, which is made for one",
              "print one part, or choose another pattern");
  }
}

Job read_job(const SettingsFile& file, const std::filesystem::path& path,
             const std::optional<std::filesystem::path>& profile) {
  const Section root = file.root(keys::job);
  Job job;
  job.file = path;
  job.profile = load_profile(profile_path(root, profile));
  const std::vector<Section> parts = part_sections(root);
  const Section& part = parts.front();
  for (const std::filesystem::path& named : read_files(part)) {
    refuse_binary_gcode(named);
    if (!is_sliced_file(named)) continue;
    if (parts.size() > 1 || part.find("file")->is_array())
      part.fail("file", "names a slicer's G-code beside another part", "print it alone");
    job.source.files = {named};
    read_sliced(root, part, job);
    return job;
  }
  refuse_sliced_keys(part);
  job.source = read_source(part, job.profile.printer.nozzle);
  job.place = read_place(part);
  job.line_width = read_deposit(part, job.profile.printer);
  read_bead_width(part, job);
  job.shaping = {read_pose(part, job.source), read_paint_depth(part, job.bead_width)};
  job.copies = read_copies(part);
  job.gap = part.number_or("gap", job.gap, between(0.5, 1000, "mm"), "write for example gap = 5.0");
  if (const toml::node* order = part.find("order"))
    job.one_by_one = part.choice("order", *order, {"together", "one-by-one"}) == "one-by-one";
  read_flow(part, job);
  read_print_keys(part, job);
  read_perimeters(part, job);
  job.allow_bare = part.flag_or("allow_bare", false, "write true or false");
  read_seam(part, job);
  job.print.change_before_border =
      part.number_or("change_before_border", 0.5, between(0.05, 0.95, ""),
                     "write the share of a change that may fall before its border");
  ZonesAndMaterials zones = read_zones(root, job.profile, job.warnings);
  job.source.zones = std::move(zones.zones);
  job.print.materials = std::move(zones.materials);
  read_more_parts(parts, job);
  check_plate(part, job);
  return job;
}

/// A model, or a slicer's G-code, is printed with the defaults of its own job.
Job job_for_model(const std::filesystem::path& model, const std::optional<std::filesystem::path>& chosen,
                  UnnamedPrinter unnamed) {
  if (std::error_code error; !std::filesystem::exists(model, error))
    throw core::FileError(model.string(), "", "does not exist", "check the path");
  const std::optional<std::filesystem::path> own = chosen ? chosen : own_profile();
  const bool sliced = is_sliced_file(model);
  if (!own && unnamed == UnnamedPrinter::refuse) {
    throw JobError(model.string(), "",
                   sliced ? "is a slicer's G-code, which does not say on which printer it is printed"
                          : "is a model, which does not say on which printer it is printed",
                   "name a profile with --profile, or make your own with `unicursal setup`");
  }
  const std::filesystem::path profile = own ? *own : common_frame();
  const std::string text = sliced ? plain_sliced_job(model, profile)
                                  : model_job({model}, load_profile(profile), model.parent_path()).text;
  Job job = read_job(SettingsFile(model, text), model, profile);
  job.text = text;
  if (!own) {
    job.warnings.push_back(
        "no profile is named: a common frame with a nozzle of 0.6 mm is assumed; name yours with --profile, "
        "or make it with `unicursal setup`");
  }
  return job;
}

}  // namespace

Job load_job(const std::filesystem::path& path, const std::optional<std::filesystem::path>& profile) {
  if (core::is_model_file(path) || is_sliced_file(path)) {
    throw JobError(path.string(), "",
                   is_sliced_file(path) ? "is a slicer's G-code, not a job" : "is a model, not a job",
                   "write a job for it with `unicursal new`");
  }
  return read_job(SettingsFile(path), path, profile);
}

Job load_job_or_model(const std::filesystem::path& path, const std::optional<std::filesystem::path>& profile,
                      UnnamedPrinter unnamed) {
  refuse_binary_gcode(path);
  const bool own = core::is_model_file(path) || is_sliced_file(path);
  return own ? job_for_model(path, profile, unnamed) : load_job(path, profile);
}

}  // namespace unicursal::host
