// Draws strands so that each differs visibly from its neighbours: a darker border, and a lighter core that
// follows one bead width behind, so that the round end of a new border never covers the core of the bead that
// it continues. The picture may show the bed from above or from any side; a strand is drawn as thick as its
// projection. mm in, pixels out.
#pragma once

#include <deque>

#include "core/picture/image.hpp"
#include "sim/bed/bead_store.hpp"

namespace unicursal::sim {

/// Affine projection: pixels = origin + x·along_x + y·along_y.
struct Projection {
  struct Pixel {
    double x = 0, y = 0;
  };
  Pixel origin, along_x, along_y;

  Pixel operator()(double x, double y) const;
  /// Returns the thickness in pixels of a strand of `width` mm that runs along (dx, dy).
  double thickness(double width, double dx, double dy) const;
};

struct Ink {
  double border = 0.45;  ///< Brightness of the border, relative to the bead's colour.
  double core = 1;       ///< Brightness of the core.
};

class Pen {
 public:
  Pen(picture::Image& image, const Projection& projection, const Ink& ink)
      : image_(image), projection_(projection), ink_(ink) {}
  ~Pen() { finish_run(); }
  Pen(const Pen&) = delete;
  Pen& operator=(const Pen&) = delete;

  void draw(const StoredBead& bead);
  void finish_run();

 private:
  void stroke(const StoredBead& bead, double width, double light);
  void draw_core();

  picture::Image& image_;
  Projection projection_;
  Ink ink_;
  std::deque<StoredBead> waiting_;  ///< Beads whose border is drawn, but not their core.
  double ahead_ = 0;                ///< Length of the waiting beads, mm.
};

}  // namespace unicursal::sim
