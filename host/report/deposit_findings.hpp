// What was laid on the bed against what the job wanted: of one layer, and added up over a print. Areas in
// mm², volumes in mm³, distances in mm; fills in layer heights.
//
// Outside is what lies farther from the outline than half the job's bead width: a bead whose middle runs on
// the outline reaches as far, and none should run beyond it. What is nearer than that is the rim of beads
// that belong there, which are as wide here and there as the curve has it.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <nlohmann/json_fwd.hpp>

namespace unicursal::host {

/// How much area has which value, in bins of equal width, and what follows from it.
class AreaHistogram {
 public:
  explicit AreaHistogram(double bin) : bin_(bin) {}

  void add(double value, double area);
  AreaHistogram& operator+=(const AreaHistogram& more);
  double area() const { return total_; }
  /// The value below which that part of the area lies; 0 when there is none.
  double percentile(double part) const;

 private:
  double bin_;
  std::map<int, double> areas_;
  double total_ = 0;
};

struct DepositFindings {
  double area = 0;              ///< that was to be filled
  double gaps = 0;              ///< of it, uncovered: the integral of what is missing to a full layer
  double overfill = 0;          ///< the integral of what stands above it
  double spilled = 0;           ///< laid beside the part, within a millimetre
  double outside = 0;           ///< mm³, laid anywhere outside, other than skirt and prime line
  double prime = 0, skirt = 0;  ///< mm³, where these are to be
  AreaHistogram fill{0.01};
  double fill_moment = 0, fill_squares = 0;  ///< ∫ fill, ∫ fill²

  double transition = 0;  ///< area of zones that are there to take up changes: its mixtures are not judged
  double wrong = 0;       ///< area where what arrived is nearer to another zone's mixture than to its own
  AreaHistogram wrong_distance{0.05};  ///< of the wrong places from the border of their material zone
  double mixture_error = 0;  ///< ∫ half the sum of the differences of all shares: area of misplaced plastic

  double gap_fraction() const { return area > 0 ? gaps / area : 0; }
  double overfill_fraction() const { return area > 0 ? overfill / area : 0; }
  double wrong_fraction() const { return area > 0 ? wrong / area : 0; }
  /// Standard deviation of the fill.
  double fill_deviation() const;

  DepositFindings& operator+=(const DepositFindings& more);
};

nlohmann::json to_json(const DepositFindings& findings);

}  // namespace unicursal::host
