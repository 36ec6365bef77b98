#include "sim/bed/pen.hpp"

#include <cmath>

#include "core/picture/filaments.hpp"

namespace unicursal::sim {

namespace {

constexpr double core_part = 0.78;  // of the bead's width

}  // namespace

Projection::Pixel Projection::operator()(double x, double y) const {
  return {origin.x + x * along_x.x + y * along_y.x, origin.y + x * along_x.y + y * along_y.y};
}

/// A strand's area scales with the projection's determinant, its length with the factor of its direction.
double Projection::thickness(double width, double dx, double dy) const {
  const double determinant = std::abs(along_x.x * along_y.y - along_x.y * along_y.x);
  const double length = std::hypot(dx, dy);
  if (length == 0) return width * std::sqrt(determinant);
  const double projected = std::hypot(dx * along_x.x + dy * along_y.x, dx * along_x.y + dy * along_y.y);
  return width * determinant * length / projected;
}

void Pen::draw(const StoredBead& bead) {
  if (!waiting_.empty() && (waiting_.back().x1 != bead.x0 || waiting_.back().y1 != bead.y0)) finish_run();
  stroke(bead, bead.width, ink_.border);
  waiting_.push_back(bead);
  ahead_ += bead.length();
  while (ahead_ - waiting_.front().length() > waiting_.front().width) draw_core();
}

void Pen::finish_run() {
  while (!waiting_.empty()) draw_core();
  ahead_ = 0;
}

void Pen::stroke(const StoredBead& bead, double width, double light) {
  const auto from = projection_(bead.x0, bead.y0), to = projection_(bead.x1, bead.y1);
  image_.stroke(from.x, from.y, to.x, to.y,
                projection_.thickness(width, bead.x1 - bead.x0, bead.y1 - bead.y0),
                picture::lit(bead.colour, light));
}

void Pen::draw_core() {
  const StoredBead& bead = waiting_.front();
  stroke(bead, bead.width * core_part, ink_.core);
  ahead_ -= bead.length();
  waiting_.pop_front();
}

}  // namespace unicursal::sim
