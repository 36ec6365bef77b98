// All beads of a print, kept in a file until the extents of the part are known and they can be drawn. The
// file lies in the folder of the pictures, and the destructor removes it. Memory holds a few bytes for each
// layer. mm.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "core/picture/filaments.hpp"
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
  /// Throws std::system_error if the file cannot be made; bead() does if the disk is full.
  explicit BeadStore(const std::filesystem::path& folder, const picture::Filaments& filaments = {});
  ~BeadStore() override;
  BeadStore(const BeadStore&) = delete;
  BeadStore& operator=(const BeadStore&) = delete;

  void bead(std::size_t layer, const DepositedLayer& about, const Bead& bead, double width) override;

  /// Calls `use` for every bead in the order of printing, with the index of its layer.
  void for_each(const std::function<void(std::size_t layer, const StoredBead& bead)>& use);

  const std::vector<StoredLayer>& layers() const { return layers_; }
  /// Extents of the centre lines, without a prime line (a straight strand that is laid first, in one stroke).
  Extents part() const;
  double widest() const { return widest_; }

 private:
  void note_place(std::size_t layer, const Bead& bead);

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  std::filesystem::path path_;
  picture::Filaments filaments_;
  std::unique_ptr<std::FILE, Close> file_;
  std::vector<StoredLayer> layers_;
  Extents first_, rest_;  ///< Extents of the first strand, and of everything after it.
  Position end_;          ///< The end of the previous bead.
  bool in_first_ = true;
  double widest_ = 0;
};

}  // namespace unicursal::sim
