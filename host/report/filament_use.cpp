#include "host/report/filament_use.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/picture/hex_colour.hpp"
#include "core/text/printable.hpp"

namespace unicursal::host {
namespace {

constexpr std::size_t widest_name = 24;  ///< characters on a terminal

/// mm³
gcode::PerFeeder by_feeder(const std::vector<gcode::MixtureVolume>& volumes, std::size_t feeders) {
  gcode::PerFeeder sum = gcode::PerFeeder::zeros(feeders);
  for (const gcode::MixtureVolume& one : volumes) {
    for (std::size_t f = 0; f < feeders; ++f) sum[f] += one.volume * one.mixture.share(f);
  }
  return sum;
}

nlohmann::json use_json(const FilamentUse& use) {
  nlohmann::json json = to_json(use.all);
  json["beside_part"] = to_json(use.aside);
  return json;
}

std::string words_of(const FilamentUse& use, const std::string& currency) {
  std::string text = in_words(use.all, currency);
  if (use.aside.grams > 0) text += fmt::format(" ({:.1f} g of it beside the part)", use.aside.grams);
  return text;
}

}  // namespace

FilamentAmount amount_of(double volume, const Filament& filament) {
  const double area = std::numbers::pi / 4 * filament.diameter * filament.diameter;
  FilamentAmount amount;
  amount.metres = volume / area / 1000;
  amount.grams = volume * filament.density / 1000;
  if (filament.price) amount.cost = *filament.price * amount.grams / 1000;
  return amount;
}

std::string in_words(const FilamentAmount& amount, const std::string& currency) {
  constexpr std::size_t widest_currency = 8;
  std::string text = fmt::format("{:.2f} m, {:.1f} g", amount.metres, amount.grams);
  if (amount.cost)
    text += fmt::format(", {:.2f} {}", *amount.cost, core::printable(currency, widest_currency));
  return text;
}

nlohmann::json to_json(const FilamentAmount& amount) {
  nlohmann::json json = {{"metres", amount.metres}, {"grams", amount.grams}};
  if (amount.cost) json["cost"] = *amount.cost;
  return json;
}

void add(FilamentAmount& sum, const FilamentAmount& more) {
  sum.metres += more.metres;
  sum.grams += more.grams;
  if (more.grams > 0 && !more.cost) sum.cost.reset();
  if (sum.cost) *sum.cost += more.cost.value_or(0);
}

FilamentUses filament_uses(const RunTotals& totals, const Profile& profile) {
  const std::vector<Filament>& filaments = profile.filaments.of_feeders;
  const gcode::PerFeeder all = by_feeder(totals.fed, filaments.size());
  const gcode::PerFeeder aside = by_feeder(totals.aside, filaments.size());
  FilamentUses uses;
  uses.total.all.cost = uses.total.aside.cost = 0.0;
  for (std::size_t f = 0; f < filaments.size(); ++f) {
    uses.of_feeders.push_back({amount_of(all[f], filaments[f]), amount_of(aside[f], filaments[f])});
    add(uses.total.all, uses.of_feeders.back().all);
    add(uses.total.aside, uses.of_feeders.back().aside);
  }
  return uses;
}

nlohmann::json used_filament_json(const RunTotals& totals, const Profile& profile) {
  const FilamentUses uses = filament_uses(totals, profile);
  const Filaments& filaments = profile.filaments;
  nlohmann::json feeders = nlohmann::json::array();
  for (std::size_t f = 0; f < uses.of_feeders.size(); ++f) {
    const Filament& filament = filaments.of_feeders[f];
    nlohmann::json json = use_json(uses.of_feeders[f]);
    json["name"] = filament.name;
    json["colour"] = picture::hex_of(filament.colour);
    json["material"] = filament.material;
    feeders.push_back(std::move(json));
  }
  nlohmann::json total = use_json(uses.total);
  if (total.contains("cost")) total["currency"] = filaments.currency;
  return {{"feeders", feeders}, {"total", total}};
}

std::string used_filament(const RunTotals& totals, const Profile& profile) {
  const FilamentUses uses = filament_uses(totals, profile);
  const Filaments& filaments = profile.filaments;
  std::string text;
  std::size_t fed = 0;
  const auto line = [&text](const std::string& of_what) {
    text += (text.empty() ? "filament:  " : "           ") + of_what + "\n";
  };
  for (std::size_t f = 0; f < uses.of_feeders.size(); ++f) {
    if (uses.of_feeders[f].all.grams <= 0) continue;
    line(core::printable(filaments.of_feeders[f].name, widest_name) + ": " +
         words_of(uses.of_feeders[f], filaments.currency));
    ++fed;
  }
  if (fed > 1) line("in all: " + words_of(uses.total, filaments.currency));
  return text;
}

}  // namespace unicursal::host
