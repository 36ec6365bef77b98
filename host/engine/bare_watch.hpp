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
/// A layer that leaves more than this share bare counts as mostly bare.
inline constexpr double mostly_bare = 0.5;
/// If mostly bare layers leave more than this share of the whole part bare, it is refused, unless that is
/// allowed. The tips of pointed parts, which no bead fits, stay far below it.
inline constexpr double bare_share_to_refuse = 0.02;

class BareWatch {
 public:
  void look(const PlannedLayer& planned);
  /// Whether the layers so far are to be refused.
  bool leaves_too_much() const { return mostly_bare_area_ > bare_share_to_refuse * whole_; }
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
  double mostly_bare_area_ = 0;              ///< what mostly bare layers leave bare, mm²
  std::size_t warned_of_ = 0;
  Found worst_;
};

}  // namespace unicursal::host
