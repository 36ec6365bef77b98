#include "host/job/filament.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "core/picture/hex_colour.hpp"
#include "core/text/wording.hpp"
#include "firmware_gcode/print/bounds.hpp"
#include "host/job/keys.hpp"
#include "host/job/settings_file.hpp"

namespace unicursal::host {
namespace {

/// g/cm³, from the data sheets of common brands; a name such as "PLA silk" counts as PLA.
struct Plastic {
  std::string_view name;
  double density;
};
constexpr std::array<Plastic, 11> plastics{{{"PLA", 1.24},
                                            {"PETG", 1.27},
                                            {"PET", 1.34},
                                            {"PCTG", 1.23},
                                            {"PC", 1.20},
                                            {"ABS", 1.04},
                                            {"ASA", 1.07},
                                            {"TPU", 1.21},
                                            {"PA", 1.14},
                                            {"HIPS", 1.04},
                                            {"PVA", 1.23}}};

const char* const list_remedy =
    "write [[filament]] once for each feeder and below it for example colour = \"#2660c4\"";
const char* const losses_remedy =
    "write two feeders and the losses of red, green and blue, for example losses = [[1, 2, 0.3, 0.2, 0.2]]";
constexpr double strongest = 1000, greatest_loss = 100;
const char* const name_remedy = "write one name for each feeder, for example [\"red\", \"white\", \"blue\"]";

std::optional<double> density_of(const std::string& material) {
  const std::string lower = core::lower(material);
  const auto named = [&](const Plastic& plastic) {
    const std::string name = core::lower(std::string(plastic.name));
    const bool ends =
        lower.size() == name.size() || std::isalpha(static_cast<unsigned char>(lower[name.size()])) == 0;
    return lower.starts_with(name) && ends;
  };
  const auto found = std::find_if(plastics.begin(), plastics.end(), named);
  return found == plastics.end() ? std::nullopt : std::optional(found->density);
}

std::string usual_name(std::size_t feeder) {
  return fmt::format("feeder {}", feeder + 1);
}

const toml::array* filament_list(const Section& root) {
  const toml::node* node = root.find("filament");
  if (!node) return nullptr;
  const toml::array* list = node->as_array();
  if (!list || list->empty() || !list->is_homogeneous<toml::table>())
    root.fail("filament", "is not a list of filaments", list_remedy);
  return list;
}

Filament read_filament(const Section& section, Filament filament) {
  filament.name = section.text_or("name", filament.name, "write for example name = \"sky blue\"");
  if (section.has("colour")) {
    const char* const remedy = "write six hexadecimal digits, for example colour = \"#2660c4\"";
    const auto colour = picture::colour_in(section.text("colour", remedy));
    if (!colour) section.fail("colour", "is not a colour", remedy);
    filament.colour = *colour;
  }
  filament.material = section.text_or("material", filament.material, "write for example material = \"PETG\"");
  filament.diameter = section.number_or(
      "diameter", filament.diameter,
      between(gcode::bounds::filament_diameter.least, gcode::bounds::filament_diameter.greatest, "mm"),
      "write for example diameter = 1.74");
  const std::string weigh =
      fmt::format("write the g/cm³ of its data sheet, for example density = {}", filament.density);
  const std::optional<double> known = density_of(filament.material);
  if (!known && !section.has("density"))
    section.fail(
        "density",
        fmt::format("is missing, and the density of {} is not known", core::in_quotes(filament.material)),
        weigh);
  constexpr double heaviest = 20;  // g/cm³; plastics with metal reach 4
  filament.density =
      section.number_or("density", known.value_or(filament.density), between(0.1, heaviest, "g/cm³"), weigh);
  constexpr double dearest = 1e6;
  if (section.has("price"))
    filament.price = section.number("price", between(0, dearest, "for one kg"),
                                    "write the price of one kg, for example price = 24.9");
  constexpr double thickest = 1000;  // mm
  if (section.has("see_through"))
    filament.see_through =
        section.number("see_through", between(0.01, thickest, "mm"),
                       "write the thickness that light hardly passes, for example see_through = 4.0");
  if (section.has("strength"))
    filament.strength = section.numbers_or("strength", picture::Light{}, {0, strongest, true, ""},
                                           "write strength = [red, green, blue], or leave it out");
  return filament;
}

std::string read_currency(const Section& section) {
  const char* const remedy = "write for example currency = \"EUR\"";
  const std::string currency = section.text("currency", remedy);
  constexpr std::size_t longest = 8;
  const bool bad =
      std::any_of(currency.begin(), currency.end(), [](unsigned char c) { return c < ' ' || c == 127; });
  if (currency.empty() || currency.size() > longest || bad)
    section.fail("currency", fmt::format("is not a name of 1 to {} characters", longest), remedy);
  return currency;
}

picture::Mixing::Pair read_loss(const Section& section, const toml::node& node, std::size_t feeders) {
  const toml::array* list = node.as_array();
  if (!list || list->size() != 5)
    section.fail("losses", "is not a list of lists of five numbers", losses_remedy);
  std::array<double, 5> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::optional<double> number = (*list)[i].value<double>();
    if (!number || !(std::abs(*number) <= greatest_loss))
      section.fail("losses", fmt::format("holds something that is not a number up to {:g}", greatest_loss),
                   losses_remedy);
    numbers[i] = *number;
  }
  const auto feeder = [&](double number) {
    if (number != std::floor(number) || number < 1 || number > static_cast<double>(feeders))
      section.fail("losses", fmt::format("names feeder {:g}, but there are {} feeders", number, feeders),
                   losses_remedy);
    return static_cast<std::size_t>(number) - 1;
  };
  const picture::Mixing::Pair pair{
      feeder(numbers[0]), feeder(numbers[1]), {numbers[2], numbers[3], numbers[4]}};
  if (pair.one == pair.other)
    section.fail("losses", fmt::format("names feeder {} twice in one list", pair.one + 1), losses_remedy);
  return pair;
}

void read_colours(const Section& section, Filaments& filaments) {
  filaments.lift =
      section.number_or("lift", filaments.lift, between(0.001, 1, ""), "write for example lift = 0.05");
  const toml::node* node = section.find("losses");
  if (!node) return;
  const toml::array* list = node->as_array();
  if (!list) section.fail("losses", "is not a list", losses_remedy);
  for (const toml::node& one : *list) {
    const picture::Mixing::Pair pair = read_loss(section, one, filaments.of_feeders.size());
    const auto same = [&](const picture::Mixing::Pair& other) {
      return std::minmax(pair.one, pair.other) == std::minmax(other.one, other.other);
    };
    if (std::any_of(filaments.losses.begin(), filaments.losses.end(), same))
      section.fail("losses", fmt::format("holds feeders {} and {} twice", pair.one + 1, pair.other + 1),
                   "keep one list of the two");
    filaments.losses.push_back(pair);
  }
}

/// extruder.filaments
void read_names(const Section& section, Filaments& filaments) {
  const toml::node* node = section.find("filaments");
  if (!node) return;
  const toml::array* list = node->as_array();
  if (!list) section.fail("filaments", "is not a list", name_remedy);
  const std::size_t feeders = filaments.of_feeders.size();
  if (list->size() != feeders)
    section.fail("filaments", fmt::format("has {} names, but there are {} feeders", list->size(), feeders),
                 name_remedy);
  for (std::size_t f = 0; f < feeders; ++f) {
    const std::optional<std::string> name = (*list)[f].value<std::string>();
    if (!name) section.fail("filaments", "holds something that is not a text", name_remedy);
    filaments.of_feeders[f].name = *name;
  }
  filaments.named = true;
}

}  // namespace

picture::Mixing Filaments::mixing() const {
  picture::Mixing mixing;
  mixing.lift = lift;
  mixing.pairs = losses;
  const bool strong = std::any_of(of_feeders.begin(), of_feeders.end(),
                                  [](const Filament& filament) { return filament.strength.has_value(); });
  for (const Filament& filament : of_feeders) {
    if (!strong) break;
    mixing.strengths.push_back(filament.strength.value_or(picture::Light{1, 1, 1}));
  }
  return mixing;
}

picture::Filaments Filaments::colours() const {
  std::vector<picture::Colour> pure;
  for (const Filament& filament : of_feeders) pure.push_back(filament.colour);
  return picture::Filaments(pure, mixing());
}

Filaments usual_filaments(const gcode::Printer& printer) {
  Filaments filaments;
  for (std::size_t f = 0; f < printer.feeders; ++f) {
    Filament filament;
    filament.name = usual_name(f);
    filament.colour = picture::usual_filaments.at(f);
    filament.diameter = printer.filament_diameter;
    filaments.of_feeders.push_back(filament);
  }
  return filaments;
}

std::optional<std::size_t> filament_count(const Section& root) {
  const toml::array* list = filament_list(root);
  return list ? std::optional(list->size()) : std::nullopt;
}

Filaments read_filaments(const Section& root, const Section& extruder, gcode::Printer& printer) {
  Filaments filaments = usual_filaments(printer);
  read_colours(root.section_or_empty("colours", keys::colours), filaments);
  const toml::array* list = filament_list(root);
  if (!list) {
    read_names(extruder, filaments);
    return filaments;
  }
  if (extruder.has("filaments"))
    extruder.fail("filaments", "names the filaments a second time", "keep the names below [[filament]] only");
  if (list->size() != printer.feeders)
    root.fail("filament",
              fmt::format("stands there {} times, but extruder.feeders is {}", list->size(), printer.feeders),
              list_remedy);
  filaments.listed = true;
  std::optional<std::string> currency;
  for (std::size_t f = 0; f < printer.feeders; ++f) {
    const Section section(root.file(), *(*list)[f].as_table(), fmt::format("filament[{}]", f),
                          keys::filament);
    Filament& filament = filaments.of_feeders[f];
    filament = read_filament(section, filament);
    filaments.named = filaments.named || section.has("name");
    if (section.has("currency")) {
      const std::string own = read_currency(section);
      if (currency && *currency != own)
        section.fail("currency",
                     fmt::format("is {}, but another filament's is {}", core::in_quotes(own),
                                 core::in_quotes(*currency)),
                     "write all prices in one currency");
      currency = own;
    }
    const double factor =
        printer.flow_factors[f] * std::pow(printer.filament_diameter / filament.diameter, 2);
    if (!gcode::bounds::flow_factor.hold(factor))
      section.fail("diameter",
                   fmt::format("is {:g} mm, which is too far from extruder.filament_diameter of {:g} mm",
                               filament.diameter, printer.filament_diameter),
                   "measure it again, or correct extruder.filament_diameter");
    printer.flow_factors[f] = factor;
  }
  filaments.currency = currency.value_or(filaments.currency);
  return filaments;
}

}  // namespace unicursal::host
