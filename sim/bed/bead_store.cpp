#include "sim/bed/bead_store.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <system_error>

namespace unicursal::sim {

namespace {

constexpr double joined = 0.01;     // mm between two beads that count as one strand
constexpr double widest_drawn = 5;  // mm: limit for beads of a nozzle that hardly moves

[[noreturn]] void fail(const std::filesystem::path& file) {
  throw std::system_error(errno != 0 ? errno : EIO, std::generic_category(), file.string());
}

}  // namespace

double StoredBead::length() const {
  return std::hypot(x1 - x0, y1 - y0);
}

BeadStore::BeadStore(const std::filesystem::path& folder, const picture::Filaments& filaments)
    : path_(folder / ".deposit.beads"), filaments_(filaments) {
  file_.reset(std::fopen(path_.c_str(), "w+b"));
  if (!file_) fail(path_);
}

BeadStore::~BeadStore() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

void BeadStore::bead(std::size_t layer, const DepositedLayer& about, const Bead& bead, double width) {
  layers_.resize(std::max(layers_.size(), layer + 1));
  layers_[layer].z = about.z;
  layers_[layer].height = about.height;
  ++layers_[layer].beads;
  const double drawn = std::min(width, widest_drawn);
  widest_ = std::max(widest_, drawn);
  note_place(layer, bead);
  const auto narrow = [](double mm) { return static_cast<float>(mm); };
  const StoredBead stored{narrow(bead.from.x), narrow(bead.from.y),
                          narrow(bead.to.x),   narrow(bead.to.y),
                          narrow(drawn),       picture::colour_of(bead.shares, filaments_)};
  if (std::fwrite(&stored, sizeof stored, 1, file_.get()) != 1) fail(path_);
}

void BeadStore::note_place(std::size_t layer, const Bead& bead) {
  const bool goes_on = first_.empty() || std::hypot(bead.from.x - end_.x, bead.from.y - end_.y) < joined;
  in_first_ = in_first_ && goes_on && layer == 0;
  Extents& extents = in_first_ ? first_ : rest_;
  extents.include(bead.from);
  extents.include(bead.to);
  end_ = bead.to;
}

Extents BeadStore::part() const {
  const double thickness = std::min(first_.max_x - first_.min_x, first_.max_y - first_.min_y);
  if (!rest_.empty() && thickness < widest_) return rest_;
  Extents all = rest_;
  if (first_.empty()) return all;
  all.include({first_.min_x, first_.min_y, first_.min_z});
  all.include({first_.max_x, first_.max_y, first_.max_z});
  return all;
}

void BeadStore::for_each(const std::function<void(std::size_t layer, const StoredBead& bead)>& use) {
  std::rewind(file_.get());
  for (std::size_t layer = 0; layer < layers_.size(); ++layer) {
    for (std::uint64_t i = 0; i < layers_[layer].beads; ++i) {
      StoredBead bead{};
      if (std::fread(&bead, sizeof bead, 1, file_.get()) != 1) fail(path_);
      use(layer, bead);
    }
  }
  std::fseek(file_.get(), 0, SEEK_END);
}

}  // namespace unicursal::sim
