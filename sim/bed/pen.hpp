// Draws strands so that each can be told from its neighbours: a darker border, and a core that lies one bead
// width behind it, so that the round end of a new border never bites into the core of the bead that it
// continues. The picture may show the bed from above or from any side: a strand's thickness is that of its
// projection. mm in, pixels out.
#pragma once

#include <deque>

#include "core/picture/image.hpp"
#include "sim/bed/bead_store.hpp"

namespace unicursal::sim {

/// Affine: pixels = origin + x·along_x + y·along_y.
struct Projection {
  struct Pixel {
    double x = 0, y = 0;
  };
  Pixel origin, along_x, along_y;

  Pixel operator()(double x, double y) const;
  /// Pixels across a strand of `width` mm that runs along (dx, dy).
  double thickness(double width, double dx, double dy) const;
};

struct Ink {
  double border = 0.45;  ///< light of the border, of the bead's own colour
  double core = 1;       ///< and of the core
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
  std::deque<StoredBead> waiting_;  ///< border drawn, core not yet
  double ahead_ = 0;                ///< mm of them
};

}  // namespace unicursal::sim
