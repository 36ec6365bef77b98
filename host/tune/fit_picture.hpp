// A picture to judge a fit by: the strip as the photo shows it, straightened, with lines where the fitted
// nozzle has changed its mixture by 5, 50 and 95 %; below it the measured and the fitted change of colour
// over the volume.
#pragma once

#include "core/picture/image.hpp"
#include "host/photo/sheet.hpp"
#include "host/tune/curve_fit.hpp"
#include "host/tune/strip.hpp"
#include "host/tune/strip_photo.hpp"

namespace unicursal::host {

picture::Image fit_picture(const Photo& photo, const Sheet& sheet, const Strip& strip,
                           const StripCurve& curve, const CurveFit& fit);

}  // namespace unicursal::host
