#include "core/drawing/svg_shapes.hpp"

#include <algorithm>
#include <vector>

#include "core/text/malformed.hpp"
#include "core/text/number_scanner.hpp"

namespace unicursal::core {

std::optional<std::string> draw_points(std::string_view points, bool closed, Outline& outline) {
  NumberScanner scanner(points);
  std::optional<std::string> mistake;
  bool first = true;
  try {
    for (scanner.skip_separator(); !scanner.at_end(); scanner.skip_separator()) {
      const double x = scanner.required(), y = scanner.required();
      first ? outline.move_to({x, y}) : outline.line_to({x, y});
      first = false;
    }
  } catch (const TooFar&) {
    throw;
  } catch (const Malformed& problem) {
    mistake = problem.what();
  }
  if (closed) outline.close();
  return mistake;
}

void draw_ellipse(const Vec2& center, const Vec2& radii, Outline& outline) {
  if (!(radii.minCoeff() > 0)) return;
  const Vec2 left = center - Vec2(radii.x(), 0), right = center + Vec2(radii.x(), 0);
  outline.move_to(right);
  outline.arc_to(radii, 0, false, true, left);
  outline.arc_to(radii, 0, false, true, right);
  outline.close();
}

void draw_rect(const RectShape& rect, Outline& outline) {
  if (!(rect.size.minCoeff() > 0)) return;
  const double rx = std::clamp(rect.rx.value_or(rect.ry.value_or(0)), 0.0, rect.size.x() / 2);
  const double ry = std::clamp(rect.ry.value_or(rect.rx.value_or(0)), 0.0, rect.size.y() / 2);
  const Vec2 a = rect.corner, b = rect.corner + rect.size, radii(rx, ry);
  outline.move_to({a.x() + rx, a.y()});
  outline.line_to({b.x() - rx, a.y()});
  outline.arc_to(radii, 0, false, true, {b.x(), a.y() + ry});
  outline.line_to({b.x(), b.y() - ry});
  outline.arc_to(radii, 0, false, true, {b.x() - rx, b.y()});
  outline.line_to({a.x() + rx, b.y()});
  outline.arc_to(radii, 0, false, true, {a.x(), b.y() - ry});
  outline.line_to({a.x(), a.y() + ry});
  outline.arc_to(radii, 0, false, true, {a.x() + rx, a.y()});
  outline.close();
}

}  // namespace unicursal::core
