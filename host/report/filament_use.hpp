// How much filament of each feeder a print takes: metres, grams and money, what lies beside the part apart.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/job/profile.hpp"
#include "host/report/totals.hpp"

namespace unicursal::host {

struct FilamentAmount {
  double metres = 0;           ///< m
  double grams = 0;            ///< g
  std::optional<double> cost;  ///< in Filaments::currency; absent: the price is not known
};

/// mm³ of a filament.
FilamentAmount amount_of(double volume, const Filament& filament);
/// "1.20 m, 3.6 g, 0.09 EUR"
std::string in_words(const FilamentAmount& amount, const std::string& currency);
/// `metres`, `grams`, and `cost` if it is known.
nlohmann::json to_json(const FilamentAmount& amount);
/// A sum has a cost as long as all its parts have one.
void add(FilamentAmount& sum, const FilamentAmount& more);

/// Of one feeder, or of all together.
struct FilamentUse {
  FilamentAmount all;
  FilamentAmount aside;  ///< of `all`: beside the part, as prime line and skirt
};

struct FilamentUses {
  std::vector<FilamentUse> of_feeders;
  FilamentUse total;  ///< without a cost unless the prices of all filaments that were fed are known
};

/// What the feeders were commanded for these totals.
FilamentUses filament_uses(const RunTotals& totals, const Profile& profile);

/// The same for a report.
nlohmann::json used_filament_json(const RunTotals& totals, const Profile& profile);

/// A line for each filament that was fed, and one for all; empty if none was.
std::string used_filament(const RunTotals& totals, const Profile& profile);

}  // namespace unicursal::host
