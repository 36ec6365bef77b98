#include "host/tune/chart_photo.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "host/photo/even_light.hpp"

namespace unicursal::host {
namespace {

constexpr double most_clipped = 0.05;  ///< share of the pixels of a patch
constexpr double darkest_seen = 0.002;
constexpr double full_trust = 0.05;      ///< linear; the logarithm of darker light is less certain
constexpr double contrast_range = 0.15;  ///< how far the exponent of a camera's contrast usually is from 1
constexpr double reference_noise = 0.03;
constexpr int rounds = 6;
constexpr double one_colour = 8;          ///< greatest ΔE between the quarters of a patch
constexpr double most_mixed_part = 0.25;  ///< share of the patches that may be spoilt

core::Box box_of(const Chart& chart) {
  return {chart.marks[0], chart.marks[2]};
}

/// From what a camera shows to the light that was there: in each channel a factor, and a common exponent.
struct CameraLaw {
  std::array<double, 3> offset{};
  double exponent = 1;

  picture::Light undone(const picture::Light& seen) const {
    picture::Light light{};
    for (std::size_t c = 0; c < light.size(); ++c)
      light[c] = std::exp((std::log(std::max(darkest_seen, seen[c])) - offset[c]) / exponent);
    return light;
  }
};

/// Of the references, whose light `model` foretells.
CameraLaw camera_law(const Chart& chart, const std::vector<SeenPatch>& seen,
                     const picture::Filaments& model) {
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  const double prior = 1 / (contrast_range * contrast_range);
  normal(3, 3) = prior;
  right(3) = prior;
  for (const SeenPatch& one : seen) {
    const ChartPatch& patch = chart.patches[one.patch];
    if (!patch.feeder) continue;
    const std::vector<double> shares(patch.mixture.shares().begin(), patch.mixture.shares().end());
    const picture::Light expected = mixed_light(shares, model);
    for (std::size_t c = 0; c < expected.size(); ++c) {
      const double light = std::max(darkest_seen, one.light[c]);
      const double trust = std::clamp(light / full_trust, 0.05, 1.0) / reference_noise;
      Eigen::Vector4d row = Eigen::Vector4d::Zero();
      row(static_cast<Eigen::Index>(c)) = 1;
      row(3) = std::log(std::max(darkest_seen, expected[c]));
      normal += trust * trust * row * row.transpose();
      right += trust * trust * std::log(light) * row;
    }
  }
  normal.diagonal().array() += 1e-9;
  const Eigen::Vector4d found = normal.ldlt().solve(right);
  return {{found(0), found(1), found(2)}, std::clamp(found(3), 0.5, 2.0)};
}

/// Whether the quarters of a patch look alike. They do not if a border of patches runs through it. A patch
/// that is too bright for the camera says nothing.
bool of_one_colour(const Sheet& sheet, const core::Box& middle) {
  const core::Vec2 quarter = middle.size() / 4;
  std::vector<picture::Lab> seen;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      const core::Vec2 place = middle.center() + core::Vec2(x * quarter.x(), y * quarter.y());
      const auto light = sheet.light(place, {1, 0}, quarter.x(), quarter.y());
      if (light.clipped > most_clipped) return true;
      seen.push_back(picture::lab_of(light.light));
    }
  }
  for (const picture::Lab& one : seen) {
    if (picture::difference(one, seen.front()) > one_colour ||
        picture::difference(one, seen.back()) > one_colour)
      return false;
  }
  return true;
}

/// Another chart may have its marks in similar places, but not its patches.
void expect_this_chart(const Sheet& sheet, const Chart& chart, const std::filesystem::path& file) {
  const auto mixed = std::count_if(chart.patches.begin(), chart.patches.end(), [&](const ChartPatch& patch) {
    return !of_one_colour(sheet, patch.middle);
  });
  const auto all = std::ssize(chart.patches);
  if (static_cast<double>(mixed) <= most_mixed_part * static_cast<double>(all)) return;
  throw core::DataError(
      file.string(), "",
      fmt::format("shows another chart than this profile's: {} of its {} patches are not of one colour",
                  mixed, all),
      "use the profile with which the chart was printed, with the dead and mixing volume that it had then, "
      "and a "
      "photo without reflections");
}

}  // namespace

SheetPlan sheet_plan(const Chart& chart) {
  return {chart.marks, chart.print.line_width, {}};
}

std::vector<SeenPatch> read_chart(const Sheet& sheet, const Chart& chart, const std::filesystem::path& file) {
  std::vector<SeenPatch> seen;
  std::vector<KnownPlace> known;
  for (std::size_t i = 0; i < chart.patches.size(); ++i) {
    const ChartPatch& patch = chart.patches[i];
    const core::Vec2 half = patch.middle.size() / 2;
    const SeenLight light = sheet.light(patch.middle.center(), {1, 0}, half.x(), half.y());
    if (light.pixels == 0)
      throw core::DataError(file.string(), "", fmt::format("does not show patch {}", i + 1),
                            "take a photo of the whole chart");
    if (light.clipped > most_clipped) continue;
    seen.push_back({i, light.light, 1});
    if (patch.feeder) known.push_back({patch.middle.center(), light.light, *patch.feeder});
  }
  const std::size_t feeders = chart.patches.front().mixture.feeders();
  for (std::size_t f = 0; f < feeders; ++f) {
    const auto same = [f](const KnownPlace& one) { return one.material == f; };
    if (std::any_of(known.begin(), known.end(), same)) continue;
    throw core::DataError(file.string(), "", fmt::format("shows feeder {} too bright", f + 1),
                          "take a photo with less exposure, without reflections");
  }
  expect_this_chart(sheet, chart, file);
  const EvenLight even(known, box_of(chart));
  for (SeenPatch& one : seen) one.light = even.evened(chart.patches[one.patch].middle.center(), one.light);
  return seen;
}

ChartFit fit_photo(const Chart& chart, const Filaments& filaments, const std::vector<SeenPatch>& seen) {
  // The references hold a little of the other filaments, so how filaments mix and what the camera does are
  // found in turns.
  ChartFit fit{filaments, {}, 0, 0};
  for (int round = 0; round < rounds; ++round) {
    const CameraLaw law = camera_law(chart, seen, fit.filaments.colours());
    std::vector<SeenPatch> undone = seen;
    for (SeenPatch& one : undone) one.light = law.undone(one.light);
    fit = fit_chart(chart, filaments, undone, picture::PureColours::kept);
  }
  return fit;
}

}  // namespace unicursal::host
