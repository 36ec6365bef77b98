#include "host/job/zones.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/picture/hex_colour.hpp"
#include "host/job/colour_mixture.hpp"
#include "host/job/job.hpp"
#include "host/job/keys.hpp"
#include "host/job/nearest.hpp"

namespace unicursal::host {
namespace {

using Palette = std::vector<gcode::Material>;

constexpr std::size_t most_materials = 200;  ///< limit of the report's labels, which are bytes

const char* const mixture_remedy =
    "write the name of a mixture below [mixture] in quotes, or { from = \"…\", to = \"…\", along = [1, 0, 0] "
    "}";

const char* const pattern_remedy =
    "write a name such as \"isotropic\", { angle = 45 } or { field = \"directions.csv\" }";

gcode::Mixture read_mixture(const Section& section, std::string_view name, std::size_t feeders) {
  const std::string example = fmt::format("write one share of 0 or more for each of the {} feeders", feeders);
  const std::vector<double> shares = section.numbers(name, at_least(0, ""), example);
  if (shares.size() != feeders) {
    section.fail(name, fmt::format("has {} shares, but the printer has {} feeders", shares.size(), feeders),
                 example);
  }
  try {
    return gcode::Mixture(gcode::Shares::of(shares));
  } catch (const core::DataError& error) {
    section.fail(name, error.problem(), error.remedy());
  }
}

/// The mixture that comes nearest to a colour.
gcode::Mixture mixture_of_colour(const Section& section, std::string_view name, const Profile& profile,
                                 std::vector<std::string>& notes) {
  const char* const remedy =
      "write six hexadecimal digits, such as \"#e0604a\", or one share for each feeder";
  const auto wanted = picture::colour_in(section.text(name, remedy));
  if (!wanted) section.fail(name, "is neither a list of numbers nor a colour", remedy);
  const ColourMixture found = mixture_near(*wanted, profile);
  notes.push_back(fmt::format("mixture \"{}\": {}", name, in_words(found, *wanted)));
  return gcode::Mixture(found.shares);
}

Palette read_palette(const Section& root, const Profile& profile, std::vector<std::string>& notes) {
  const Section section =
      root.section("mixture", {}, "write [mixture] and below it for example white = [0.34, 0.33, 0.33]");
  Palette palette;
  for (auto&& [key, node] : section.table()) {
    palette.push_back({std::string(key.str()),
                       node.is_string() ? mixture_of_colour(section, key.str(), profile, notes)
                                        : read_mixture(section, key.str(), profile.printer.feeders),
                       {},
                       false});
  }
  return palette;
}

core::Pattern named_pattern(const Section& zone, const toml::node& node) {
  const std::string name =
      zone.choice("pattern", node, {"isotropic", "anisotropic", "parallel", "orthogonal", "none"});
  core::Pattern pattern;
  if (name == "none") pattern.kind = core::PatternKind::none;
  if (name == "anisotropic") pattern.kind = core::PatternKind::anisotropic;
  if (name == "parallel") pattern.kind = core::PatternKind::parallel;
  if (name == "orthogonal") pattern.kind = core::PatternKind::orthogonal;
  return pattern;
}

core::Pattern directed_pattern(const Section& zone) {
  const Section table = zone.section("pattern", keys::pattern, pattern_remedy);
  if (table.has("angle") == table.has("field")) {
    zone.fail("pattern", "needs either an angle or a field", pattern_remedy);
  }
  core::Pattern pattern;
  if (table.has("angle")) {
    pattern.kind = core::PatternKind::angle;
    pattern.angle =
        table.number("angle", between(-360, 360, "°"), "write degrees counter-clockwise from +x") *
        std::numbers::pi / 180;
  } else {
    pattern.kind = core::PatternKind::field;
    pattern.field =
        zone.file().parent_path() / table.text("field", "name a CSV file of x, y, angle in degrees");
    std::error_code error;
    if (!std::filesystem::is_regular_file(pattern.field, error)) {
      table.fail("field", fmt::format("names {}, which does not exist", pattern.field.string()),
                 "check the path");
    }
  }
  return pattern;
}

core::Pattern read_pattern(const Section& zone) {
  core::Pattern pattern;
  if (const toml::node* node = zone.find("pattern")) {
    pattern = node->is_table() ? directed_pattern(zone) : named_pattern(zone, *node);
  }
  if (const toml::node* node = zone.find("boundary")) {
    pattern.along_zone_border = zone.choice("boundary", *node, {"island", "zone"}) == "zone";
  }
  return pattern;
}

const gcode::Material& find_material(const Section& zone, std::string_view key, const Palette& palette) {
  const std::string name = zone.text(key, mixture_remedy);
  std::vector<std::string> names;
  for (const gcode::Material& material : palette) {
    if (material.name == name) return material;
    names.push_back(material.name);
  }
  const std::string close = nearest(name, names);
  zone.fail(key, fmt::format("is \"{}\", which is not defined", name),
            close.empty() ? "define it below [mixture]"
                          : fmt::format("define it below [mixture], or did you mean \"{}\"?", close));
}

/// Shares are normalised, so [3, 0, 1] and [0.6, 0, 0.2] may differ by rounding.
bool equal(const gcode::Mixture& a, const gcode::Mixture& b) {
  constexpr double rounding = 1e-9;
  return std::equal(a.shares().begin(), a.shares().end(), b.shares().begin(),
                    [](double x, double y) { return std::abs(x - y) < rounding; });
}

bool equal(const std::optional<gcode::Gradient>& a, const std::optional<gcode::Gradient>& b) {
  if (!a || !b) return !a && !b;
  return equal(a->to, b->to) && a->along == b->along && a->begin == b->begin && a->end == b->end;
}

/// Zones of equal mixture form one material zone, also if the mixtures' names differ.
std::size_t index_in(std::vector<gcode::Material>& used, const gcode::Material& material) {
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (equal(used[i].mixture, material.mixture) && equal(used[i].gradient, material.gradient) &&
        used[i].transition == material.transition) {
      return i;
    }
  }
  used.push_back(material);
  return used.size() - 1;
}

std::array<double, 3> read_direction(const Section& gradient) {
  const char* const remedy = "write the direction in the part's frame, for example along = [1, 0, 0]";
  const std::vector<double> along = gradient.numbers("along", between(-1e6, 1e6, ""), remedy);
  if (along.size() != 3) gradient.fail("along", "does not have three numbers", remedy);
  const double length = std::hypot(along[0], along[1], along[2]);
  if (!(length > 0)) gradient.fail("along", "has no length", remedy);
  return {along[0] / length, along[1] / length, along[2] / length};
}

/// A gradient without `over` goes from one end of its zones to the other.
gcode::Material read_gradient(const Section& zone, const Palette& palette) {
  const Section section = zone.section("mixture", keys::gradient, mixture_remedy);
  gcode::Material material = find_material(section, "from", palette);
  const gcode::Material& to = find_material(section, "to", palette);
  material.name += " to " + to.name;
  material.gradient = gcode::Gradient{to.mixture, read_direction(section), 0, 0};
  if (section.has("over")) {
    const char* const remedy = "write where it begins and ends along the direction, mm in the part's frame";
    const auto over = section.numbers_or<2>("over", {0, 0}, between(-1e4, 1e4, "mm"), remedy);
    if (over[0] >= over[1]) section.fail("over", "does not end after it begins", remedy);
    material.gradient->begin = over[0];
    material.gradient->end = over[1];
  }
  return material;
}

gcode::Material read_material(const Section& zone, const Palette& palette) {
  const toml::node* node = zone.find("mixture");
  gcode::Material material =
      node && node->is_table() ? read_gradient(zone, palette) : find_material(zone, "mixture", palette);
  material.transition = zone.flag_or("transition", false, "write true or false");
  if (material.transition && material.gradient) {
    zone.fail("transition", "is true for a gradient", "use either the one or the other");
  }
  return material;
}

core::Zone read_zone(const Section& section, const Palette& palette, std::vector<gcode::Material>& used) {
  core::Zone zone;
  zone.select = section.text("select", "write a fill colour, an object's name or a file's name in quotes");
  zone.pattern = read_pattern(section);
  zone.material = index_in(used, read_material(section, palette));
  if (used.size() > most_materials) {
    section.fail("mixture", fmt::format("is the mixture number {}", used.size()),
                 fmt::format("use at most {} different mixtures in one job", most_materials));
  }
  return zone;
}

}  // namespace

ZonesAndMaterials read_zones(const Section& root, const Profile& profile, std::vector<std::string>& notes) {
  const char* const remedy = "write [[zone]] and below it select, pattern and mixture";
  const toml::node* node = root.find("zone");
  if (!node) root.fail("zone", "is missing", remedy);
  const toml::array* list = node->as_array();
  if (!list || list->empty() || !list->is_homogeneous<toml::table>()) {
    root.fail("zone", "is not a list of zones", remedy);
  }
  const Palette palette = read_palette(root, profile, notes);
  ZonesAndMaterials result;
  for (const toml::node& item : *list) {
    const Section section(root.file(), *item.as_table(), fmt::format("zone[{}]", result.zones.size()),
                          keys::zone);
    result.zones.push_back(read_zone(section, palette, result.materials));
  }
  return result;
}

}  // namespace unicursal::host
