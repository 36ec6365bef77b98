// What is on the spools of a printer's feeders: [[filament]] of a profile. mm, g/cm³; prices for one kg.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/picture/filaments.hpp"
#include "firmware_gcode/print/printer.hpp"

namespace unicursal::host {

class Section;

struct Filament {
  std::string name;  ///< "feeder 2" unless the profile names it
  picture::Colour colour;
  std::string material = "PLA";
  double diameter = 1.75;
  double density = 1.24;
  std::optional<double> price;  ///< of one kg
  /// Thickness through which hardly any light passes any more; absent: not measured. Nothing depends on it
  /// yet.
  std::optional<double> see_through;
  /// How strongly it colours mixtures in red, green and blue; absent: 1.
  std::optional<picture::Light> strength;
};

struct Filaments {
  std::vector<Filament> of_feeders;           ///< one for each feeder
  std::string currency = "EUR";               ///< of all prices
  bool named = false;                         ///< by the profile
  bool listed = false;                        ///< by [[filament]]
  double lift = picture::Mixing::usual_lift;  ///< of [colours], as of picture::Mixing
  std::vector<picture::Mixing::Pair> losses;

  picture::Mixing mixing() const;
  picture::Filaments colours() const;
};

/// The filaments of a printer about which a profile says nothing.
Filaments usual_filaments(const gcode::Printer& printer);

/// The number of [[filament]] of a profile; absent if it has none. Throws JobError if it is not a list of
/// tables.
std::optional<std::size_t> filament_count(const Section& root);

/// Reads [colours] and [[filament]], or else the names in extruder.filaments. The printer's feeders have been
/// read. A filament that is thicker or thinner than extruder.filament_diameter changes the flow factor of its
/// feeder, since the firmware counts lengths. Throws JobError.
Filaments read_filaments(const Section& root, const Section& extruder, gcode::Printer& printer);

}  // namespace unicursal::host
