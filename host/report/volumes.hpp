// How much of each mixture a job wants, and how much the simulator's feeders fed. mm³, mm.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "firmware_gcode/print/chunk.hpp"
#include "firmware_gcode/print/print_settings.hpp"

namespace unicursal::host {

struct MaterialVolume {
  std::string name;
  gcode::Mixture asked;
  gcode::Mixture intended;  ///< after floor share and quantisation
  double part = 0;          ///< Σ area × layer height
  double prime = 0;         ///< laid beside the part beforehand

  double total() const { return part + prime; }
};

/// Adds the layer's beads to the volumes of their materials.
void add_layer(std::vector<MaterialVolume>& volumes, const gcode::PlacedLayer& layer,
               const std::vector<std::size_t>& zone_materials);

/// The name of mixtures within gradients, and of overshoots.
inline constexpr const char* mixed_between = "between";

/// The volumes that the feeders were commanded, by mixture: those of the schedule, which differ from the
/// zones' where mixtures change. Mixtures that no material has are called `mixed_between`.
std::vector<MaterialVolume> fed_volumes(const std::vector<gcode::MixtureVolume>& fed,
                                        const std::vector<MaterialVolume>& materials);

/// mm³ for each feeder, of all mixtures together; for no feeder if there are no mixtures.
gcode::PerFeeder feeder_volumes(const std::vector<MaterialVolume>& volumes);

nlohmann::json to_json(const std::vector<MaterialVolume>& volumes);

/// What the comparison needs besides the simulator's report.
struct Fed {
  double filament_diameter = 1.75;  ///< mm
  double feeder_steps_per_mm = 400;
  std::uint64_t lines_sent = 0;   ///< numbered lines, each once
  gcode::PerFeeder flow_factors;  ///< the factors by which feeders turn more
};

/// Steps of each feeder compared with the intended volume of each mixture, and what became of every line.
struct Comparison {
  struct Mixture {
    std::string name;
    double intended = 0;                 ///< mm³
    double fed = 0;                      ///< mm³, from the feeders' steps
    double relative_error = 0;           ///< of the sum, signed
    gcode::PerFeeder feeder_error = {};  ///< of each feeder, relative to its intended volume
  };
  std::vector<Mixture> mixtures;
  /// Greatest magnitude of the mixtures' relative errors, feeders included. Mixtures in between are fed so
  /// briefly that single steps of a feeder would count; they are judged together, and each feeder against all
  /// of them.
  double worst_error = 0;
  std::int64_t lines_lost = 0;
  std::int64_t lines_twice = 0;
  bool in_order = false;

  bool lines_whole() const { return lines_lost == 0 && lines_twice == 0 && in_order; }
};

/// `simulator`: the report of the simulator; missing numbers count as zero.
Comparison compare(const std::vector<MaterialVolume>& volumes, const nlohmann::json& simulator,
                   const Fed& fed);

nlohmann::json to_json(const Comparison& comparison);

}  // namespace unicursal::host
