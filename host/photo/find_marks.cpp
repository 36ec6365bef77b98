#include "host/photo/find_marks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "host/photo/marks.hpp"

namespace unicursal::host {
namespace {

constexpr std::size_t search_side = 1600;         ///< pixels of the longer side; larger photos are reduced
constexpr double surroundings[] = {0.015, 0.03};  ///< half the side of the windows, in longer sides
constexpr double contrasts[] = {0.02, 0.06};      ///< least difference from the mean, of 0…1
constexpr std::size_t openings[] = {0, 1, 2};     ///< half the width of lines that are left out, pixels
constexpr double largest_mark = 1.0 / 6;          ///< of the longer side
constexpr std::size_t most_places = 300;          ///< a photo with more of them shows a pattern
constexpr double least_disk = 9;                  ///< pixels of the reduced photo
constexpr double roundness = 0.2;                 ///< how far areas may differ from those of ellipses
constexpr double likeness = 0.4;                  ///< how far the shapes of disk and ring may differ

/// One channel of the photo, reduced.
struct Plane {
  std::size_t width = 0, height = 0;
  std::vector<float> values;
};

std::size_t reduction(const Photo& photo) {
  const std::size_t side = std::max(photo.width(), photo.height());
  return (side + search_side - 1) / search_side;
}

Plane reduced(const Photo& photo, std::uint8_t picture::Colour::*channel) {
  const std::size_t by = reduction(photo);
  Plane plane{photo.width() / by, photo.height() / by, {}};
  plane.values.reserve(plane.width * plane.height);
  const float whole = 255.0F * static_cast<float>(by * by);
  for (std::size_t y = 0; y < plane.height; ++y) {
    for (std::size_t x = 0; x < plane.width; ++x) {
      std::uint32_t sum = 0;
      for (std::size_t j = 0; j < by; ++j) {
        for (std::size_t i = 0; i < by; ++i) sum += photo.at(x * by + i, y * by + j).*channel;
      }
      plane.values.push_back(static_cast<float>(sum) / whole);
    }
  }
  return plane;
}

/// The plane minus its mean over squares around each pixel.
std::vector<float> standing_out(const Plane& plane, std::size_t half) {
  const std::size_t w = plane.width, h = plane.height, stride = w + 1;
  std::vector<double> sums((w + 1) * (h + 1));
  for (std::size_t y = 0; y < h; ++y) {
    double row = 0;
    for (std::size_t x = 0; x < w; ++x) {
      row += plane.values[y * w + x];
      sums[(y + 1) * stride + x + 1] = sums[y * stride + x + 1] + row;
    }
  }
  std::vector<float> result(w * h);
  for (std::size_t y = 0; y < h; ++y) {
    const std::size_t top = y < half ? 0 : y - half, bottom = std::min(h, y + half + 1);
    for (std::size_t x = 0; x < w; ++x) {
      const std::size_t left = x < half ? 0 : x - half, right = std::min(w, x + half + 1);
      const double sum = sums[bottom * stride + right] - sums[top * stride + right] -
                         sums[bottom * stride + left] + sums[top * stride + left];
      const double mean = sum / static_cast<double>((bottom - top) * (right - left));
      result[y * w + x] = plane.values[y * w + x] - static_cast<float>(mean);
    }
  }
  return result;
}

using Mask = std::vector<std::uint8_t>;

Mask beyond(const std::vector<float>& values, float sign, float least) {
  Mask mask(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) mask[i] = values[i] * sign >= least ? 1 : 0;
  return mask;
}

/// Along rows or columns: each pixel becomes 1 if at least `count` of the 2·`half` + 1 around it are.
Mask counted(const Mask& mask, std::size_t width, std::size_t half, std::size_t count, bool along_rows) {
  const std::size_t height = mask.size() / width, length = along_rows ? width : height;
  const std::size_t lines = along_rows ? height : width, step = along_rows ? 1 : width;
  Mask result(mask.size());
  for (std::size_t line = 0; line < lines; ++line) {
    const std::size_t first = along_rows ? line * width : line;
    std::size_t sum = 0;
    for (std::size_t i = 0; i < std::min(half, length); ++i) sum += mask[first + i * step];
    for (std::size_t i = 0; i < length; ++i) {
      if (i + half < length) sum += mask[first + (i + half) * step];
      if (i > half) sum -= mask[first + (i - half - 1) * step];
      result[first + i * step] = sum >= count ? 1 : 0;
    }
  }
  return result;
}

/// Without what is narrower than 2·`half` + 1 pixels, such as the lines of a grid on the bed.
Mask opened(const Mask& mask, std::size_t width, std::size_t half) {
  if (half == 0) return mask;
  const std::size_t all = 2 * half + 1;
  const Mask eroded = counted(counted(mask, width, half, all, true), width, half, all, false);
  return counted(counted(eroded, width, half, 1, true), width, half, 1, false);
}

/// A connected group of pixels, by its moments.
struct Blob {
  double area = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  std::size_t left = std::numeric_limits<std::size_t>::max(), right = 0, top = left, bottom = 0;

  void add(std::size_t column, std::size_t row) {
    const auto cx = static_cast<double>(column), cy = static_cast<double>(row);
    area += 1, x += cx, y += cy, xx += cx * cx, xy += cx * cy, yy += cy * cy;
    left = std::min(left, column), right = std::max(right, column);
    top = std::min(top, row), bottom = std::max(bottom, row);
  }
  void finish() {
    x /= area, y /= area;
    // A pixel is a square, whose own moment is 1/12.
    xx = xx / area - x * x + 1.0 / 12, yy = yy / area - y * y + 1.0 / 12, xy = xy / area - x * y;
  }
  double spread() const { return std::sqrt(std::max(1e-12, xx * yy - xy * xy)); }
  /// Its area ÷ that of a filled ellipse with the same moments.
  double fullness() const { return area / (4 * std::numbers::pi * spread()); }
  std::size_t side() const { return std::max(right - left, bottom - top) + 1; }
};

/// Groups of pixels of the mask, joined by their sides.
std::vector<Blob> blobs_in(const Mask& mask, std::size_t width) {
  constexpr std::uint32_t none = 0;
  std::vector<std::uint32_t> label(mask.size(), none), parent{none};
  const auto root = [&parent](std::uint32_t at) {
    while (parent[at] != at) at = parent[at] = parent[parent[at]];
    return at;
  };
  for (std::size_t at = 0; at < mask.size(); ++at) {
    if (mask[at] == 0) continue;
    const std::uint32_t before = at % width > 0 ? label[at - 1] : none;
    const std::uint32_t above = at >= width ? label[at - width] : none;
    if (before == none && above == none) {
      label[at] = static_cast<std::uint32_t>(parent.size());
      parent.push_back(label[at]);
    } else if (before == none || above == none) {
      label[at] = std::max(before, above);
    } else {
      const std::uint32_t a = root(before), b = root(above);
      label[at] = parent[std::max(a, b)] = std::min(a, b);
    }
  }
  std::vector<Blob> blobs(parent.size());
  for (std::size_t at = 0; at < mask.size(); ++at) {
    if (label[at] != none) blobs[root(label[at])].add(at % width, at / width);
  }
  std::erase_if(blobs, [](const Blob& blob) { return blob.area < least_disk; });
  for (Blob& blob : blobs) blob.finish();
  return blobs;
}

bool like_disk(const Blob& blob) {
  return std::abs(blob.fullness() - 1) < roundness;
}

/// The fullness of a ring is (b² − a²) ÷ (b² + a²) for its radii a and b; blur and light change them.
bool like_ring(const Blob& blob) {
  constexpr double least = 0.15, most = 0.65;
  return blob.fullness() > least && blob.fullness() < most;
}

bool belong_together(const Blob& disk, const Blob& ring) {
  const MarkSizes sizes(1);
  const double wanted =
      (sizes.ring_inner * sizes.ring_inner + sizes.ring_outer * sizes.ring_outer) / (sizes.disk * sizes.disk);
  const double ratio = ring.spread() / disk.spread();
  if (ratio < wanted / 2.2 || ratio > wanted * 2.2) return false;
  if (disk.left <= ring.left || disk.right >= ring.right || disk.top <= ring.top ||
      disk.bottom >= ring.bottom)
    return false;
  const double radius = 2 * std::sqrt(disk.spread());
  if (std::hypot(disk.x - ring.x, disk.y - ring.y) > 0.35 * radius + 0.3) return false;
  const double d = disk.spread(), r = ring.spread();
  return std::abs(disk.xx / d - ring.xx / r) < likeness && std::abs(disk.yy / d - ring.yy / r) < likeness &&
         std::abs(disk.xy / d - ring.xy / r) < likeness;
}

FoundMark mark_of(const Blob& disk, const Blob& ring, std::size_t by) {
  const MarkSizes sizes(1);
  const double part = sizes.ring_inner / sizes.ring_outer;
  const core::Vec2 middle((disk.x + ring.x) / 2 + 0.5, (disk.y + ring.y) / 2 + 0.5);
  const double outer = std::sqrt(4 * ring.spread() / (1 + part * part));
  return {middle * static_cast<double>(by), outer * static_cast<double>(by), 1};
}

void add_pairs(std::vector<Blob> blobs, std::size_t longest, std::size_t by, std::vector<FoundMark>& found) {
  std::erase_if(blobs, [&](const Blob& blob) {
    return blob.side() > longest || !(like_disk(blob) || like_ring(blob));
  });
  std::sort(blobs.begin(), blobs.end(), [](const Blob& a, const Blob& b) { return a.x < b.x; });
  for (const Blob& ring : blobs) {
    if (!like_ring(ring)) continue;
    const double near = 0.2 * static_cast<double>(ring.side()) + 1;
    auto disk = std::lower_bound(blobs.begin(), blobs.end(), ring.x - near,
                                 [](const Blob& blob, double x) { return blob.x < x; });
    for (; disk != blobs.end() && disk->x < ring.x + near; ++disk) {
      if (like_disk(*disk) && belong_together(*disk, ring)) found.push_back(mark_of(*disk, ring, by));
    }
  }
}

/// The same mark is seen in several channels.
std::vector<FoundMark> merged(const std::vector<FoundMark>& found) {
  std::vector<FoundMark> marks;
  for (const FoundMark& seen : found) {
    if (marks.size() == most_places) break;
    const auto same = std::find_if(marks.begin(), marks.end(), [&](const FoundMark& mark) {
      return (mark.centre - seen.centre).norm() < 0.5 * std::min(mark.radius, seen.radius);
    });
    if (same == marks.end()) {
      marks.push_back(seen);
      continue;
    }
    const auto votes = static_cast<double>(same->votes);
    same->centre = (same->centre * votes + seen.centre) / (votes + 1);
    same->radius = (same->radius * votes + seen.radius) / (votes + 1);
    ++same->votes;
  }
  std::stable_sort(marks.begin(), marks.end(),
                   [](const FoundMark& a, const FoundMark& b) { return a.votes > b.votes; });
  return marks;
}

}  // namespace

std::vector<FoundMark> find_marks(const Photo& photo) {
  const std::size_t by = reduction(photo);
  std::vector<FoundMark> found;
  for (const auto channel : {&picture::Colour::r, &picture::Colour::g, &picture::Colour::b}) {
    const Plane plane = reduced(photo, channel);
    if (plane.width == 0 || plane.height == 0) return {};
    const double side = static_cast<double>(std::max(plane.width, plane.height));
    for (const double around : surroundings) {
      const std::vector<float> values =
          standing_out(plane, static_cast<std::size_t>(std::ceil(around * side)));
      for (const double contrast : contrasts) {
        for (const float sign : {-1.0F, 1.0F}) {
          const Mask mask = beyond(values, sign, static_cast<float>(contrast));
          for (const std::size_t half : openings)
            add_pairs(blobs_in(opened(mask, plane.width, half), plane.width),
                      static_cast<std::size_t>(largest_mark * side), by, found);
        }
      }
    }
  }
  return merged(found);
}

}  // namespace unicursal::host
