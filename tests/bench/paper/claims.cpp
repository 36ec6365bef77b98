#include "tests/bench/paper/claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "core/geometry/region.hpp"
#include "tests/bench/paper/methods.hpp"

namespace unicursal::bench {
namespace {

/// Returns what speaks against a claim; empty if nothing does, nullopt if the case says nothing about it.
using Finding = std::optional<std::string>;

class Claims {
 public:
  explicit Claims(const Report& report) : report_(report) {}

  /// A claim about our curve on each part.
  void ours(const std::string& said, const std::string& source,
            const std::function<Finding(const PartReport&, const Figures&)>& look) {
    Claim claim{said, source, {}, 0};
    for (const PartReport& part : report_.parts) {
      const auto found = part.methods.find("ours");
      if (found != part.methods.end()) note(claim, look(part, found->second));
    }
    keep(std::move(claim));
  }

  /// A claim that our figure is less than that of another method on each part; `figure` may be absent.
  void less(const std::string& said, const std::string& source, const std::string& other,
            const std::string& format, const std::function<std::optional<double>(const Figures&)>& figure,
            bool or_equal = false) {
    ours(said, source, [&](const PartReport& part, const Figures& mine) -> Finding {
      const auto found = part.methods.find(other);
      if (found == part.methods.end()) return std::nullopt;
      const auto a = figure(mine), b = figure(found->second);
      if (!a || !b) return std::nullopt;
      if (*a < *b || (or_equal && *a <= *b)) return "";
      return part.part.title + ": " + fmt::format(fmt::runtime(format), *a) + " against " +
             fmt::format(fmt::runtime(format), *b);
    });
  }

  void whole(const std::string& said, const std::string& source, const Finding& finding) {
    Claim claim{said, source, {}, 0};
    note(claim, finding);
    keep(std::move(claim));
  }

  std::vector<Claim> take() { return std::move(claims_); }

 private:
  static void note(Claim& claim, const Finding& finding) {
    if (!finding) return;
    ++claim.cases;
    if (!finding->empty()) claim.against.push_back(*finding);
  }
  void keep(Claim claim) {
    if (claim.cases > 0) claims_.push_back(std::move(claim));
  }

  const Report& report_;
  std::vector<Claim> claims_;
};

constexpr double percent = 100;
constexpr double most_coverage = 0.0870, most_variation = 0.050;  ///< tests/README.md
constexpr double leaf_coverage = 0.0850, leaf_variation = 0.043;  ///< core/README.md
constexpr double passage_width = 3.6, narrow_share = 0.03;        ///< bead widths; of a part's area
constexpr double small_part = 200;                                ///< square bead widths

Finding against(bool holds, const std::string& why) {
  return holds ? "" : why;
}

bool wholly_isotropic(const Part& part) {
  return std::all_of(part.zones.begin(), part.zones.end(), [](const core::Zone& zone) {
    return zone.pattern.kind == core::PatternKind::isotropic;
  });
}

/// Whether more than a little of the part is narrower than the strands of the medial axis reach.
bool has_passages(const Part& part) {
  double narrow = 0;
  for (const core::Island& island : part.layer.islands) {
    const double radius = passage_width / 2 * part.width();
    narrow +=
        core::area(island.outline) - core::area(core::opened({island.outline}, radius, 0.01 * part.width()));
  }
  return narrow > narrow_share * part.area();
}

void about_our_curve(Claims& claims) {
  claims.ours("One closed curve fills each island: no travels within an island.", "README.md; paper §1",
              [](const PartReport& part, const Figures& f) -> Finding {
                return against(f.travels == 0, fmt::format("{}: {} travels", part.part.title, f.travels));
              });
  claims.ours("The curve does not meet itself and stays inside.", "core/README.md; paper §3",
              [](const PartReport& part, const Figures& f) -> Finding {
                return against(f.meetings + f.outside == 0,
                               fmt::format("{}: {} meetings, {} segments outside", part.part.title,
                                           f.meetings, f.outside));
              });
  claims.ours("The mean spacing is the asked bead width, within 3 %.", "tests/README.md",
              [](const PartReport& part, const Figures& f) -> Finding {
                const double ratio = part.part.area() / f.length / part.part.width();
                return against(std::abs(ratio - 1) <= 0.03,
                               fmt::format("{}: {:.3f} bead widths", part.part.title, ratio));
              });
  claims.ours(
      "Isotropic parts without narrow passages have E ≤ 0.0870 and a CV of bead widths ≤ 0.050, by the exact "
      "diagram.",
      "tests/README.md", [](const PartReport& part, const Figures& f) -> Finding {
        if (!wholly_isotropic(part.part) || has_passages(part.part) || !f.exact_coverage) return std::nullopt;
        const double w = part.part.width();
        if (part.part.area() < small_part * w * w) return std::nullopt;
        return against(
            *f.exact_coverage <= most_coverage && *f.exact_variation <= most_variation,
            fmt::format("{}: E {:.4f}, CV {:.3f}", part.part.title, *f.exact_coverage, *f.exact_variation));
      });
  claims.ours("The example leaf has E ≈ 0.0850 and a CV of at most 4.3 %.", "core/README.md",
              [](const PartReport& part, const Figures& f) -> Finding {
                if (part.part.name != "leaf" || !f.exact_coverage) return std::nullopt;
                return against(std::abs(*f.exact_coverage - leaf_coverage) < 5e-4 &&
                                   *f.exact_variation < leaf_variation + 2e-3,
                               fmt::format("E {:.4f}, CV {:.3f}", *f.exact_coverage, *f.exact_variation));
              });
  claims.ours(
      "The fewest crossings between materials: 2 (k − 1) for k pieces.", "core/README.md; paper Figure 25",
      [](const PartReport& part, const Figures& f) -> Finding {
        std::size_t pieces = 0;
        for (const core::Island& island : part.part.layer.islands) {
          std::map<std::size_t, std::vector<core::Polygon>> materials;
          for (const core::ZoneRegion& zone : island.zones) {
            core::Region& sum = materials[part.part.zones[zone.zone].material];
            sum = core::unite(sum, zone.polygons);
          }
          std::size_t here = 0;
          const double speck = 0.05 * part.part.width() * part.part.width();
          for (const auto& [material, region] : materials) {
            here += static_cast<std::size_t>(std::count_if(
                region.begin(), region.end(), [&](const core::Polygon& p) { return core::area(p) > speck; }));
          }
          pieces += here > 0 ? here - 1 : 0;
        }
        if (pieces == 0) return std::nullopt;
        return against(f.crossings <= 2 * pieces, fmt::format("{}: {} crossings, {} would do",
                                                              part.part.title, f.crossings, 2 * pieces));
      });
}

void against_others(Claims& claims) {
  for (const std::string other : {"zigzag", "fermat", "growth"}) {
    const std::string name = title_of(other);
    const std::string source = other == "growth" ? "paper §5.2" : "paper §5.1";
    claims.less("Our spacing varies less than that of " + name + " (CV).", source, other, "{:.3f}",
                [](const Figures& f) { return f.spacing.variation; });
    claims.less("Our curve leaves fewer gaps than " + name + ", each with beads of one width.", source, other,
                "{:.4f}", [](const Figures& f) { return f.constant.gaps; });
    claims.less("Our curve leaves fewer gaps than " + name + ", each with the segments' own areas.",
                "paper Figure 21", other, "{:.4f}", [](const Figures& f) { return f.own.gaps; });
    claims.less("Our curve follows the asked directions better than " + name + " (squared angle).",
                "paper §5.1", other, "{:.3f}", [](const Figures& f) { return f.alignment; });
    claims.less(
        "Our curve has no more crossings between materials than " + name + ".", "paper Figure 25", other,
        "{:.0f}", [](const Figures& f) -> std::optional<double> { return static_cast<double>(f.crossings); },
        true);
    claims.less("Planning takes less processor time than " + name + ".",
                other == "growth" ? "paper §5.2" : "claimed by nobody", other, "{:.2f} s",
                [](const Figures& f) { return f.seconds; });
  }
  claims.less("Directions in isotropic zones are spread more evenly than by a zigzag (E_iso).", "paper §1",
              "zigzag", "{:.5f}", [](const Figures& f) { return f.isotropy; });
  claims.less("Directions in isotropic zones are spread more evenly than by growth (E_iso).", "paper §5.2",
              "growth", "{:.5f}", [](const Figures& f) { return f.isotropy; });
}

void about_series(const Report& report, Claims& claims) {
  if (!report.spacing.empty()) {
    std::string worst;
    bool holds = true;
    for (const SpacingAgainstD& s : report.spacing) {
      const double off = std::max(s.most - s.mean, s.mean - s.least);
      if (off > 0.1) {
        holds = false;
        worst += fmt::format("d = {:.2f} mm: up to {:.3f} mm off; ", s.d, off);
      }
    }
    claims.whole("At one d the spacing of all shapes lies within ± 0.1 mm of their mean.", "paper Figure 13",
                 against(holds, worst));
  }
  if (report.held) {
    const HeldSpacing& h = *report.held;
    claims.whole("Whole plans have the asked spacing within 3 % on every one of the random shapes.",
                 "tests/README.md, there for whole jobs",
                 against(h.failed == 0 && h.least >= 0.97 && h.most <= 1.03,
                         fmt::format("{:.3f} to {:.3f} bead widths", h.least, h.most)));
  }
  if (report.costs.size() > 2) {
    const double shuffle = exponent(report.costs, &CostAtD::shuffle),
                 fairing = exponent(report.costs, &CostAtD::fairing_step);
    claims.whole("One call of Shuffle takes time ∝ N; the paper's is O(N²) at worst (exponent ≤ 1.15).",
                 "core/README.md; paper §4.3", against(shuffle <= 1.15, fmt::format("N^{:.2f}", shuffle)));
    claims.whole("One step of fairing takes time ∝ N; the paper's is O(N log N) (exponent ≤ 1.15).",
                 "core/README.md; paper §4.3", against(fairing <= 1.15, fmt::format("N^{:.2f}", fairing)));
  }
  if (!report.objectives.empty()) {
    double least = 1e300, most = 0;
    const ObjectiveReport *anisotropic = nullptr, *evenest = nullptr;
    for (const ObjectiveReport& o : report.objectives) {
      least = std::min(least, o.figures.spacing.mean);
      most = std::max(most, o.figures.spacing.mean);
      if (o.name == "anisotropic") anisotropic = &o;
      if (evenest == nullptr || o.figures.spacing.variation < evenest->figures.spacing.variation)
        evenest = &o;
    }
    claims.whole("The mean spacings under all objectives lie within 0.05 mm of each other.",
                 "paper Figure 14", against(most - least <= 0.05, fmt::format("{:.3f} mm", most - least)));
    if (anisotropic != nullptr)
      claims.whole(
          "The spacing varies least under the anisotropic objective.", "paper Figure 14",
          against(evenest == anisotropic,
                  fmt::format("CV {:.3f} anisotropic, {:.3f} {}", anisotropic->figures.spacing.variation,
                              evenest->figures.spacing.variation, evenest->name)));
  }
  if (report.smoothing)
    claims.whole("The smoothing term avoids sharp turns.", "paper Figure 15",
                 against(report.smoothing->sharpest_with < report.smoothing->sharpest_without,
                         fmt::format("{:.2f} rad with it, {:.2f} without", report.smoothing->sharpest_with,
                                     report.smoothing->sharpest_without)));
  Joining sum;
  for (const PartReport& part : report.parts) {
    sum.reconnected += part.joining.reconnected;
    sum.doubled += part.joining.doubled;
    sum.plain_reconnected += part.joining.plain_reconnected;
    sum.plain_doubled += part.joining.plain_doubled;
  }
  if (sum.reconnected + sum.doubled > 0) {
    const double with = doubled_share(sum.reconnected, sum.doubled),
                 without = doubled_share(sum.plain_reconnected, sum.plain_doubled);
    claims.whole("With refinement at most 3 % of the joins are doubled edges.", "paper Table 1",
                 against(with <= 0.03, fmt::format("{:.1f} %", percent * with)));
    claims.whole("Without refinement more than half of them are (see there).", "paper Table 1",
                 against(without > 0.5, fmt::format("{:.1f} %", percent * without)));
  }
}

}  // namespace

std::vector<Claim> claims(const Report& report) {
  Claims all(report);
  about_our_curve(all);
  against_others(all);
  about_series(report, all);
  return all.take();
}

}  // namespace unicursal::bench
