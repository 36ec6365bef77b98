// One picture for each layer, top view. The first shows everything, the others are cropped alike to what lies
// above it, so that a prime line does not shrink the part. Since that is known only at the end, the beads
// wait in a file in the pictures' folder, which is removed after drawing; memory holds a few bytes for each
// layer. Each bead is a capsule as wide as its volume makes it, with a darker border, drawn in the order of
// printing: overlaps show as borders across older beads, gaps as background.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <vector>

#include "sim/bed/deposit.hpp"

namespace unicursal::sim {

class BeadPictures : public BeadSink {
 public:
  /// Makes the folder and removes an older print's pictures from it. `pixel`: mm. Throws std::system_error
  /// when folder or file cannot be made.
  BeadPictures(std::filesystem::path folder, double pixel);
  ~BeadPictures() override;
  BeadPictures(const BeadPictures&) = delete;
  BeadPictures& operator=(const BeadPictures&) = delete;

  void bead(std::size_t layer, const Bead& bead, double width) override;
  /// Draws deposit-0000.png and so on, one for each layer. Pixels grow where a side would exceed 4096 of
  /// them.
  void draw();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  std::filesystem::path folder_, waiting_;
  double pixel_;
  std::unique_ptr<std::FILE, Close> file_;
  std::vector<std::uint64_t> beads_;  ///< in each layer
  Extents all_, above_;  ///< of the centre lines: of the first layer and all others, of the others
  double widest_ = 0;    ///< mm
};

}  // namespace unicursal::sim
