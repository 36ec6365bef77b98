#include "core/drawing/drawing_notes.hpp"

#include <fmt/format.h>

namespace unicursal::core {
namespace {

/// What follows the place.
const char* sentence(Finding finding) {
  switch (finding) {
    case Finding::faint:
      return "less than half opaque, so it does not count; make it opaque if it belongs to the part";
    case Finding::translucent:
      return "partly transparent; it counts as opaque, in its own colour";
    case Finding::hairline:
      return "a stroke of less than 0.15 mm, which is left out; make it wider, or write outline = "
             "\"strokes\" in "
             "[part] if it is a contour";
    case Finding::outside:
      return "outside of the page, at least in part; what is outside is left out";
    case Finding::soft_mask:
      return "masked gradually; it is kept where the mask lets more than half through";
    case Finding::filter:
      return "drawn without its filter";
    case Finding::blend:
      return "drawn without its blend mode";
    case Finding::pattern:
      return "filled with a pattern, which becomes one zone";
    case Finding::missing_server:
      return "painted with a gradient or pattern that the drawing does not hold; it is left out";
    case Finding::missing_target:
      return "a reference to what the drawing does not hold; it is left out";
    case Finding::circle_of_links:
      return "a reference that leads back to itself; it is left out";
    case Finding::picture:
      return "a picture, which is skipped; convert it to a path if it belongs to the part";
    case Finding::foreign:
      return "not a part of SVG, and is skipped; convert it to a path if it belongs to the part";
    case Finding::text_on_path:
      return "text along a path, which is skipped; convert it to a path if it belongs to the part";
    case Finding::text_look:
      return "drawn without the decoration, the length or the direction that is asked for; convert it to a "
             "path "
             "if that matters";
  }
  return "";
}

}  // namespace

void DrawingNotes::finish() {
  for (std::size_t i = 0; i < finding_kinds; ++i) {
    const Tally& tally = tallies_[i];
    if (tally.count == 0) continue;
    const std::string others =
        tally.count > 1 ? fmt::format(" ({} more like this)", tally.count - 1) : std::string();
    notes_.add(fmt::format("{} is {}{}", tally.first, sentence(Finding(i)), others));
  }
  tallies_ = {};
}

}  // namespace unicursal::core
