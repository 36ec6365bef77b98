// Watches how much of each layer stays without plastic, and puts it into words. mm, mm².
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "host/lookahead/planned_layer.hpp"

namespace unicursal::host {

/// A layer that leaves more than this share of its area bare is worth a warning. Farther than 0.75 bead
/// widths from every strand counts as bare; sharp corners alone stay below it.
inline constexpr double bare_share_to_warn_of = 0.05;
/// A layer that leaves more than this bare is refused, unless it is allowed.
inline constexpr double bare_share_to_refuse = 0.5;

class BareWatch {
 public:
  /// `least_width` mm: of a bead.
  BareWatch(double bead_width, double least_width) : bead_width_(bead_width), least_width_(least_width) {}

  /// Measures a layer and returns the share of its area that stays bare.
  double look(const PlannedLayer& planned);
  /// One sentence about all layers that are worth a warning; empty if none is.
  std::string warning() const;
  /// "leaves 64 % of layer 1 (z = 0.20 mm) without plastic", of the last layer.
  std::string fault() const;
  /// The keys are explained in host/report/README.md.
  nlohmann::json to_json() const;

 private:
  struct Found {
    std::size_t layer = 0;
    double top = 0, area = 0, walls = 0, share = 0;
  };
  double bead_width_, least_width_;
  double area_ = 0, walls_ = 0, whole_ = 0;  ///< sums over all layers
  std::size_t warned_of_ = 0;
  Found last_, worst_;
};

}  // namespace unicursal::host
