// A test print in a photo: where its places lie, and what colour they have.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/picture/lab.hpp"
#include "host/photo/marks.hpp"
#include "host/photo/photo.hpp"
#include "host/photo/view.hpp"

namespace unicursal::host {

/// A straight line of plastic beside which the bed is bare. mm.
struct BareStroke {
  core::Vec2 from{0, 0}, to{0, 0};
  double width = 0;
  double clear = 0;  ///< how far the bed is bare on both sides of the line
};

/// What a photo of a test print is expected to show.
struct SheetPlan {
  MarkPlaces marks{};
  double line = 0;                  ///< width of the lines of the marks, mm
  std::vector<BareStroke> strokes;  ///< by which the place of everything is refined
};

/// Four places in the photo, pixels: of the marks at the front left, front right, back right and back left.
using GivenCorners = std::array<core::Vec2, 4>;

/// The colour of a small piece of the print.
struct SeenLight {
  picture::Light light{};  ///< as the camera shows it: the middle half of the pixels, by brightness
  double clipped = 0;      ///< share of the pixels in which a channel is at its end, 255
  std::size_t pixels = 0;  ///< of the photo; 0: the place is not in it
};

class Sheet {
 public:
  /// Finds the marks, or takes the `corners`, and refines the view by the strokes. `file` is for messages.
  /// Throws core::DataError if the photo does not show the whole print, or another one.
  Sheet(const Photo& photo, const SheetPlan& plan, const std::optional<GivenCorners>& corners,
        const std::filesystem::path& file);

  const View& view() const { return view_; }

  /// A rectangle of the print: `half_along` mm to both sides along `direction` (of length 1), and
  /// `half_across` across.
  SeenLight light(const core::Vec2& place, const core::Vec2& direction, double half_along,
                  double half_across) const;

  /// Share of the plan's strokes that were found where they should be; 1 if the plan has none.
  double agreement() const { return agreement_; }

 private:
  void check_slant(const SheetPlan& plan, const std::filesystem::path& file) const;
  double refine(const SheetPlan& plan, std::vector<Sighting> marks, double reach, std::size_t lens);

  const Photo& photo_;
  View view_;
  double agreement_ = 1;
};

}  // namespace unicursal::host
