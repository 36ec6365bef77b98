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
  void look(const PlannedLayer& planned);
  std::size_t layers() const { return layers_; }  ///< that it has looked at
  /// The greatest share of a layer's area that stays bare.
  double worst_share() const { return worst_.share; }
  /// One sentence about all layers that are worth a warning; empty if none is.
  std::string warning() const;
  /// "leaves 64 % of layer 1 (z = 0.20 mm) without plastic", of the worst layer.
  std::string fault() const;
  /// The keys are explained in host/report/README.md.
  nlohmann::json to_json() const;

 private:
  struct Found {
    std::size_t layer = 0;
    double top = 0, area = 0, walls = 0, share = 0;
  };
  double area_ = 0, walls_ = 0, whole_ = 0;  ///< sums over all layers
  std::size_t layers_ = 0, warned_of_ = 0;
  Found worst_;
};

}  // namespace unicursal::host
