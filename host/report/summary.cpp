#include "host/report/summary.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace unicursal::host {
namespace {

std::string counted(std::uint64_t count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

}  // namespace

std::string duration_words(double seconds) {
  if (seconds < 60) return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<long>(std::lround(seconds));
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

std::string odd_widths(const Figures& f) {
  if (!(f.narrow_length > 0 || f.wide_length > 0)) return "";
  return fmt::format(
      "widths:    {:.1f} mm of bead narrower and {:.1f} mm wider than the profile's "
      "bead_width_range\n",
      f.narrow_length, f.wide_length);
}

std::string summary(const RunTotals& totals, const PlanningEffort& planning) {
  const Figures& f = totals.figures;
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{} layers, {} islands, {} closed curves, {:.1f} m of bead {:.3f} mm apart\n",
                 totals.layers, f.islands, f.curves, f.length / 1000, f.mean_spacing());
  fmt::format_to(out, "material:  {:.1f} mm³", totals.volume);
  for (const MaterialVolume& material : totals.materials) {
    fmt::format_to(out, ", {} {:.1f}", material.name, material.part);
  }
  fmt::format_to(out, "\nplanning:  {} ({} of processor time)\n", duration_words(planning.seconds),
                 duration_words(planning.cpu_seconds));
  if (totals.hurried_layers > 0) {
    fmt::format_to(out,
                   "hurried:   {} planned with less effort, at least {:.0f} %, so that the nozzle did not "
                   "have to wait\n",
                   counted(totals.hurried_layers, "layer"), 100 * totals.least_effort);
  }
  fmt::format_to(out, "printing:  about {} at {:.2f} mm³/s\n", duration_words(totals.print_seconds),
                 totals.flow);
  if (f.self_intersections + f.outside_segments > 0) {
    fmt::format_to(out, "defects:   {} self-intersections, {} segments outside\n", f.self_intersections,
                   f.outside_segments);
  }
  if (f.unfilled_area > 0 || f.far_area > 0) {
    fmt::format_to(out, "not filled: {:.2f} mm² too thin for a bead, {:.2f} mm² too far from one\n",
                   f.unfilled_area, f.far_area);
  }
  text += odd_widths(f);
  return text;
}

std::string summary(const Comparison& comparison) {
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "simulator: {} lines lost, {} run twice, {}\n", comparison.lines_lost,
                 comparison.lines_twice, comparison.in_order ? "all in order" : "OUT OF ORDER");
  const auto tell = [&out](const Comparison::Mixture& m) {
    fmt::format_to(out, "           {}: fed {:.2f} mm³ of {:.2f} ({:+.3f} %)\n", m.name, m.fed, m.intended,
                   100 * m.relative_error);
  };
  Comparison::Mixture shades;
  std::size_t count = 0;
  for (const Comparison::Mixture& mixture : comparison.mixtures) {
    if (mixture.name != mixed_between) {
      tell(mixture);
      continue;
    }
    ++count;
    shades.fed += mixture.fed;
    shades.intended += mixture.intended;
  }
  if (count > 0) {
    shades.name = counted(count, "mixture") + " in between";
    shades.relative_error = shades.fed / shades.intended - 1;
    tell(shades);
  }
  return text;
}

std::string summary(const DepositFindings& d) {
  if (d.area <= 0) return "";
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out,
                 "laid:      gaps {:.2f} %, overfill {:.2f} % of {:.0f} mm²; height {:.0f} to {:.0f} %\n",
                 100 * d.gap_fraction(), 100 * d.overfill_fraction(), d.area, 100 * d.fill.percentile(0.05),
                 100 * d.fill.percentile(0.95));
  fmt::format_to(out,
                 "outside:   {:.2f} mm³, other than the prime line ({:.1f} mm³) and the skirt ({:.1f} mm³)\n",
                 d.outside, d.prime, d.skirt);
  if (d.wrong > 0) {
    fmt::format_to(
        out,
        "mixtures:  {:.1f} mm² ({:.2f} %) nearer to another zone's; half of it within {:.2f} mm of a "
        "border, 90 % within {:.2f}\n",
        d.wrong, 100 * d.wrong_fraction(), d.wrong_distance.percentile(0.5),
        d.wrong_distance.percentile(0.9));
  }
  fmt::format_to(out, "           misplaced plastic {:.1f} mm² ({:.2f} %)\n", d.mixture_error,
                 100 * d.mixture_error / d.area);
  return text;
}

std::string summary(const MotionFindings& m) {
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "motion:    {:.2f} mm/s on average, {} of {:.1f} mm in all, {}", m.mean_speed,
                 counted(m.travels, "travel"), m.travel, counted(m.starvations, "starvation"));
  if (m.hasty_stops > 0) fmt::format_to(out, ", {} for late moves", counted(m.hasty_stops, "stop"));
  fmt::format_to(
      out, "\nflow:      within 5 % of {:.2f} mm³/s in {:.1f} % of the seconds ({:.1f} % of the instants)\n",
      m.nominal_flow, 100 * m.seconds_in_tolerance, 100 * m.instants_in_tolerance);
  if (m.seconds_in_tolerance < MotionFindings::hold_share && m.holdable_flow > 0) {
    fmt::format_to(out, "           about {:.2f} mm³/s could be held in {:.0f} % of them\n", m.holdable_flow,
                   100 * MotionFindings::hold_share);
  }
  return text;
}

}  // namespace unicursal::host
