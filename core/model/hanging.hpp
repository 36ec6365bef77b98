// Finds places that would be printed in the air: islands with nothing below them, and layers without any
// island between others. Overhangs of islands that rest on something are not reported.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/geometry/region.hpp"
#include "core/model/part.hpp"

namespace unicursal::core {

class HangingCheck {
 public:
  /// Takes the layers in order, from the first one on.
  void add(const Layer& layer);

  /// One sentence for each such island or run of empty layers, at most ten; a last one counts those that were
  /// left out. Empty layers at the end do not count.
  std::vector<std::string> sentences() const;

 private:
  void report(std::string sentence);

  Region below_;
  bool begun_ = false;
  std::size_t empty_from_ = 0, empty_ = 0;  ///< the run of empty layers that the last ones belong to
  double empty_height_ = 0;                 ///< mm above the underside at which it begins
  std::vector<std::string> sentences_;
  std::size_t left_out_ = 0;
};

}  // namespace unicursal::core
