#include "host/engine/read_plate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/model/plate.hpp"
#include "core/model/read_part.hpp"
#include "core/text/wording.hpp"
#include "firmware_gcode/toolpath/skirt.hpp"

namespace unicursal::host {
namespace {

[[noreturn]] void refuse(const Job& job, const std::string& place, const std::string& problem,
                         const std::string& remedy) {
  throw JobError(job.file.string(), place, problem, remedy);
}

/// The distance between parts, mm. One by one, the head stands beside finished parts, and the skirt of the
/// first part must not lie where another will stand.
double gap_of(const Job& job) {
  if (!job.one_by_one) return job.gap;
  constexpr double beside_skirt = 1;
  return std::max({job.gap, job.profile.clearance->radius,
                   gcode::skirt_reach(job.print.skirt, job.profile.printer) + beside_skirt});
}

/// The corners of all copies, part by part. Throws JobError with the number of copies that fit, if one part
/// is copied.
std::vector<core::Vec2> corners_on(const Job& job, const std::vector<core::Vec2>& sizes,
                                   const std::vector<std::size_t>& copies) {
  const core::Vec2 bed(job.profile.printer.bed[0], job.profile.printer.bed[1]);
  const auto corners_of = [&](std::size_t first) {
    std::vector<core::Vec2> all;
    for (std::size_t i = 0; i < sizes.size(); ++i)
      all.insert(all.end(), sizes.size() == 1 ? first : copies[i], sizes[i]);
    return core::arranged(all, bed, gap_of(job));
  };
  if (const auto corners = corners_of(copies.front())) return *corners;
  std::size_t fitting = 0;
  if (sizes.size() == 1) {
    for (std::size_t low = 1, high = copies.front(); low < high;) {
      const std::size_t middle = (low + high) / 2;
      if (corners_of(middle))
        fitting = middle, low = middle + 1;
      else
        high = middle;
    }
  }
  const std::string apart = job.one_by_one ? "order = \"together\"" : "a smaller gap";
  refuse(
      job, "part",
      fmt::format("does not fit on the bed of {:.1f} x {:.1f} mm together with its copies or the other parts",
                  bed.x(), bed.y()) +
          (job.one_by_one ? fmt::format(", {:.1f} mm apart so that the head strikes none", gap_of(job)) : ""),
      fitting > 0 ? fmt::format("write copies = {}, or {}", fitting, apart)
                  : "take parts away, turn them, or write " + apart);
}

/// The lowest first, so that the head passes above those that are finished; of equal height, the nearest
/// next.
std::vector<core::PlateItem> in_order(std::vector<core::PlateItem> items) {
  const auto height = [](const core::PlateItem& item) { return item.part->height(); };
  const auto centre = [](const core::PlateItem& item) -> core::Vec2 {
    return item.offset + item.part->extent().center();
  };
  std::stable_sort(items.begin(), items.end(),
                   [&](const auto& a, const auto& b) { return height(a) < height(b); });
  for (std::size_t i = 1; i < items.size(); ++i) {
    const core::Vec2 last = centre(items[i - 1]);
    const auto next = items.begin() + static_cast<std::ptrdiff_t>(i);
    const auto end =
        std::find_if(next, items.end(), [&](const auto& item) { return height(item) > height(*next); });
    std::iter_swap(next, std::min_element(next, end, [&](const auto& a, const auto& b) {
                     return (centre(a) - last).squaredNorm() < (centre(b) - last).squaredNorm();
                   }));
  }
  return items;
}

void check_heights(const Job& job, const std::vector<core::PlateItem>& items) {
  const double free = job.profile.clearance->height;
  for (std::size_t i = 0; i + 1 < items.size(); ++i) {
    const double height = items[i].part->height();
    if (height <= free) continue;
    refuse(
        job, "part.order",
        fmt::format(
            "is \"one-by-one\", but a part of {:.1f} mm would be struck while the next is printed: only the "
            "last may be higher than the clearance_height of {:g} mm",
            height, free),
        "write order = \"together\", or make the parts lower");
  }
}

}  // namespace

std::unique_ptr<const core::Part> read_plate(const Job& job) {
  if (job.one_by_one && !job.profile.clearance) {
    refuse(job, "part.order",
           "is \"one-by-one\", but the profile does not say how far the head reaches around the nozzle",
           "measure it, and write clearance_radius and clearance_height in [printer] of the profile");
  }
  std::vector<bool> matched(job.source.zones.size(), false);
  std::vector<std::shared_ptr<const core::Part>> parts{core::read_part(job.source, job.shaping, &matched)};
  std::vector<std::size_t> copies{job.copies};
  for (const PlatePart& part : job.more) {
    parts.push_back(core::read_part(part.source, part.shaping, &matched));
    copies.push_back(part.copies);
  }
  for (std::size_t i = 0; i < matched.size(); ++i) {
    if (!matched[i])
      refuse(
          job, "zone",
          fmt::format("select = {} matches nothing in any part", core::in_quotes(job.source.zones[i].select)),
          "see what zones can select with `unicursal inspect`");
  }
  std::vector<core::Vec2> sizes;
  for (const auto& part : parts) sizes.push_back(part->extent().size());
  const std::vector<core::Vec2> corners = corners_on(job, sizes, copies);
  std::vector<core::PlateItem> items;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t n = 0; n < copies[i]; ++n)
      items.push_back({parts[i], corners[items.size()] - parts[i]->extent().min});
  }
  if (!job.one_by_one) return core::plate_of(std::move(items));
  items = in_order(std::move(items));
  check_heights(job, items);
  return core::plate_in_turn(std::move(items));
}

}  // namespace unicursal::host
