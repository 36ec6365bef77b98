// What was laid on the bed compared with what the job wanted, of one layer or added up over a print. Areas in
// mm², volumes in mm³, distances in mm, fills in layer heights.
//
// "Outside" means farther from the outline than half the job's bead width. A bead whose middle runs on the
// outline reaches so far, and none should run beyond it. Nearer than that lies the rim of beads that belong
// there, whose widths vary along the curve.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <nlohmann/json_fwd.hpp>

namespace unicursal::host {

/// Area by value, in bins of equal width.
class AreaHistogram {
 public:
  explicit AreaHistogram(double bin) : bin_(bin) {}

  void add(double value, double area);
  AreaHistogram& operator+=(const AreaHistogram& more);
  double area() const { return total_; }
  /// The value below which this fraction of the area lies; 0 if the histogram is empty.
  double percentile(double part) const;

 private:
  double bin_;
  std::map<int, double> areas_;
  double total_ = 0;
};

struct DepositFindings {
  double area = 0;              ///< area that was to be filled
  double gaps = 0;              ///< integral of what is missing from a full layer
  double overfill = 0;          ///< integral of what stands above a full layer
  double spilled = 0;           ///< area laid beside the part, within 1 mm
  double outside = 0;           ///< mm³ laid outside, without skirt and prime line
  double prime = 0, skirt = 0;  ///< mm³ laid where these should be
  AreaHistogram fill{0.01};
  double fill_moment = 0, fill_squares = 0;  ///< ∫ fill, ∫ fill²

  double transition = 0;               ///< area of transition zones, whose mixtures are not judged
  double wrong = 0;                    ///< area whose mixture is nearer to another zone's than to its own
  AreaHistogram wrong_distance{0.05};  ///< distance of wrong places from their material zone's border
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
