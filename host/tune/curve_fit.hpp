// Computes the dead volume, the mixing volume and the tanks of a nozzle from the colour of a strip, as it was
// seen all along the bead. mm³. The model is that of transition_fit.hpp; here the whole curve is fitted.
//
// Colours do not change in proportion to shares: a little red shows in white at once, a little white in red
// hardly. Lines whose shares of the change are known (`perception`, and both pure mixtures) show how the
// colour answers to a share, in the same photo. Between them each channel is interpolated: after the law of
// Beer and Lambert, and that of Kubelka and Munk, the logit of the way that the logarithm of its light has
// gone differs from the logit of the share by about a constant; that difference is a parabola here, and
// constant below 1.5 % and above 98.5 %. So the fit needs no model of the filaments and no calibrated camera.
// Departure: it is not known how a bed shines through, nor how a camera bends colours; `lanes` and `bent`
// stand for both.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "host/tune/strip.hpp"
#include "host/tune/transition_fit.hpp"

namespace unicursal::host {

/// Encoded red, green and blue, 0…1: steps of equal size look about equally large.
using Seen = std::array<double, 3>;

/// A place of the strip.
struct CurvePoint {
  double passed = 0;  ///< volume since the switch
  Seen colour{};
  double fat = 0;    ///< how wide the bead is, from the thin reference lines (0) to the fat ones (1)
  double trust = 1;  ///< 0: of no use
  /// Natural logarithms of how much brighter this place is lit than the reference lines. The colour has been
  /// evened; but cameras bend light colours less than dark ones, so that something remains.
  Seen brightness{};
  /// The straight piece of the strip that it lies on. The bed below each may shine through differently.
  std::size_t lane = 0;
};

/// The colours of the reference lines, indexed by Shade, and the standard deviation of each. The bed shines
/// through a thin bead more than through a fat one, so there are lines of both widths.
struct ReferenceColours {
  struct Lines {
    std::array<Seen, shade_count> colour{};
    std::array<double, shade_count> doubt{};
  };
  Lines thin, fat;
};

/// How the colour answers to a share.
class ColourAnswer {
 public:
  explicit ColourAnswer(const ReferenceColours& references);

  /// The colour after a share of the change, 0 to 1.
  Seen operator()(double share, double fat) const;
  /// How far a colour has gone from the first pure one (0) to the second (1), in encoded values.
  double change(const Seen& colour, double fat) const;
  /// Channels that hardly differ between both pure colours say nothing.
  bool uses(std::size_t channel) const { return used_[channel]; }

 private:
  struct Channel {
    double from = 0, to = 0;        ///< logarithms of the light
    std::array<double, 3> lifts{};  ///< of the lines of `perception`
  };
  static Channel channel_of(const ReferenceColours::Lines& lines, std::size_t channel);

  std::array<Channel, 3> thin_, fat_;
  std::array<bool, 3> used_{};
};

struct CurveFit {
  Estimate dead, mixing, tanks;  ///< uncertainty: two standard deviations
  double scatter = 0;            ///< of the points around the curve, encoded
  /// By how much the strip's own pure colours differ from those of the reference lines; the second one also
  /// on each lane (the last of them on all further ones).
  static constexpr std::size_t most_lanes = 4;
  Seen low{}, high{};
  std::array<Seen, most_lanes> lanes{};
  /// By how much more than the first colour the second one answers to brightness.
  Seen bent{};

  /// The colour that the fit foretells at the place of a point.
  Seen colour_at(const CurvePoint& point, const ColourAnswer& answer) const;
};

/// Throws core::DataError if the points are not the curve of a nozzle, or end before its change does. `file`
/// is that of the photo, for messages.
CurveFit fit_curve(const std::vector<CurvePoint>& points, const ReferenceColours& references,
                   const std::filesystem::path& file);

}  // namespace unicursal::host
