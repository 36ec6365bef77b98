// Every bead of a print, waiting in a file to be drawn when the part's extent is known. The file lies in the
// pictures' folder and is removed in the end; memory holds a few bytes for each layer. mm.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "core/picture/image.hpp"
#include "sim/bed/deposit.hpp"

namespace unicursal::sim {

struct StoredBead {
  float x0, y0, x1, y1, width;
  picture::Colour colour;

  double length() const;
};

struct StoredLayer {
  double z = 0, height = 0;
  std::uint64_t beads = 0;
};

class BeadStore : public BeadSink {
 public:
  /// Throws std::system_error when the file cannot be made, and when the disk is full later on.
  explicit BeadStore(const std::filesystem::path& folder);
  ~BeadStore() override;
  BeadStore(const BeadStore&) = delete;
  BeadStore& operator=(const BeadStore&) = delete;

  void bead(std::size_t layer, const DepositedLayer& about, const Bead& bead, double width) override;

  /// In the order of printing. `use` gets a layer's number and each of its beads.
  void for_each(const std::function<void(std::size_t layer, const StoredBead& bead)>& use);

  const std::vector<StoredLayer>& layers() const { return layers_; }
  /// Of the centre lines, without a prime line: a straight strand laid first, in one go, apart from the rest.
  Extents part() const;
  double widest() const { return widest_; }

 private:
  void note_place(std::size_t layer, const Bead& bead);

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, Close> file_;
  std::vector<StoredLayer> layers_;
  Extents first_, rest_;  ///< of the strand laid first, and of all after it
  Position end_;          ///< of the bead before
  bool in_first_ = true;
  double widest_ = 0;
};

}  // namespace unicursal::sim
