#include "core/model/ray_index.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace unicursal::core {
namespace {

using Box2 = Eigen::AlignedBox2d;

constexpr std::size_t most_rows = 1024, entries_per_facet = 8;

std::vector<Box2> boxes_of(const ClosedMesh& mesh) {
  std::vector<Box2> boxes(mesh.facets.size());
  for (std::size_t f = 0; f < boxes.size(); ++f) {
    for (const auto v : mesh.facets[f]) boxes[f].extend(Eigen::Vector2d(mesh.vertices[v].tail<2>()));
  }
  return boxes;
}

}  // namespace

std::size_t RayIndex::row(double value, int axis) const {
  const double at = std::floor((value - low_[axis]) / cell_[axis]);
  return static_cast<std::size_t>(std::clamp(at, 0.0, double(rows_ - 1)));
}

RayIndex::RayIndex(const ClosedMesh& mesh) {
  const std::vector<Box2> boxes = boxes_of(mesh);
  Box2 whole;
  for (const Box2& box : boxes) whole.extend(box);
  if (!whole.isEmpty()) low_ = whole.min();
  const auto for_each_cell = [&](const Box2& box, const auto& visit) {
    const std::size_t last_y = row(box.max().x(), 0), last_z = row(box.max().y(), 1);
    for (std::size_t z = row(box.min().y(), 1); z <= last_z; ++z) {
      for (std::size_t y = row(box.min().x(), 0); y <= last_y; ++y) visit(z * rows_ + y);
    }
  };
  const auto divide = [&](std::size_t rows) {
    rows_ = rows;
    if (!whole.isEmpty()) cell_ = (whole.sizes() / double(rows)).cwiseMax(1e-9);
  };
  // Facets that span many cells would fill the memory: then the cells are larger.
  std::size_t rows = std::clamp<std::size_t>(std::size_t(std::sqrt(double(boxes.size()))), 1, most_rows);
  for (;; rows /= 2) {
    divide(rows);
    std::size_t entries = 0;
    for (const Box2& box : boxes) {
      entries += (row(box.max().x(), 0) - row(box.min().x(), 0) + 1) *
                 (row(box.max().y(), 1) - row(box.min().y(), 1) + 1);
    }
    if (rows == 1 || entries <= entries_per_facet * boxes.size()) break;
  }
  begins_.assign(rows_ * rows_ + 1, 0);
  for (const Box2& box : boxes) for_each_cell(box, [&](std::size_t cell) { ++begins_[cell + 1]; });
  for (std::size_t cell = 1; cell < begins_.size(); ++cell) begins_[cell] += begins_[cell - 1];
  facets_.resize(begins_.back());
  std::vector<std::size_t> next(begins_.begin(), begins_.end() - 1);
  for (std::uint32_t f = 0; f < boxes.size(); ++f)
    for_each_cell(boxes[f], [&](std::size_t cell) { facets_[next[cell]++] = f; });
}

std::span<const std::uint32_t> RayIndex::near(double y, double z) const {
  const std::size_t cell = row(z, 1) * rows_ + row(y, 0);
  return std::span(facets_).subspan(begins_[cell], begins_[cell + 1] - begins_[cell]);
}

}  // namespace unicursal::core
