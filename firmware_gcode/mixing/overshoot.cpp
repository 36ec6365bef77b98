#include "firmware_gcode/mixing/overshoot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace unicursal::gcode {
namespace {

using Shares = Tanks::Shares;

constexpr double cell = 1.0 / 24;       ///< of the mixing volume: a step of what is reckoned
constexpr double reckoned = 2.5;        ///< mixing volumes after which nothing of a change is left
constexpr std::size_t most_pulses = 2;  ///< a third would hardly gain anything
constexpr int longest = 24;             ///< cells of one pulse
constexpr double pays = 0.95;           ///< of the cost without it: less gain is not worth a tool
constexpr double first_stride = 0.16, last_stride = 0.02;  ///< of the shares, in the search
constexpr std::size_t refined = 3;                         ///< of the coarse grid's best, each by itself
constexpr double blur =
    0.1;  ///< of a squared distance, in which "nearer" fades, so that the search has a slope
constexpr double least_gain = 1e-6;

/// A nozzle that the printer may have instead of the one in its profile.
struct NozzleVariant {
  double volumes;  ///< factor
  int tanks;       ///< more
  double weight;
};
constexpr std::array<NozzleVariant, 3> variants{{{1, 0, 2}, {0.85, -1, 1}, {1.15, 1, 1}}};

/// What has arrived of a step in the middle of each cell, the dead volume of the profile left out.
using Answer = std::vector<double>;

Answer answer_of(const ChamberModel& profile, const NozzleVariant& variant, double step) {
  ChamberModel model = profile;
  model.dead_volume *= variant.volumes;
  model.mixing_volume *= variant.volumes;
  model.tanks = static_cast<std::size_t>(
      std::clamp(static_cast<int>(profile.tanks) + variant.tanks, 1, static_cast<int>(max_tanks)));
  Answer answer(static_cast<std::size_t>(std::ceil(reckoned * profile.mixing_volume / step)));
  for (std::size_t i = 0; i < answer.size(); ++i) {
    answer[i] = model.step_response(profile.dead_volume + (static_cast<double>(i) + 0.5) * step);
  }
  return answer;
}

struct Pulse {
  std::array<double, 2> shares{};  ///< of feeders 1 and 2; the third has the rest
  int cells = 0;
};
using Pulses = std::vector<Pulse>;

Shares full(const Pulse& pulse) {
  return {pulse.shares[0], pulse.shares[1], std::max(0.0, 1 - pulse.shares[0] - pulse.shares[1])};
}

/// A change from one mixture to another, and what ways of making it cost.
class Change {
 public:
  Change(const std::vector<Shares>& materials, const std::vector<Answer>& answers, std::size_t from,
         std::size_t to, double before_border)
      : materials_(materials), answers_(answers), from_(from), to_(to), before_border_(before_border) {}

  struct Cost {
    double cost = std::numeric_limits<double>::infinity();  ///< cells of plastic
    std::size_t lead = 0;                                   ///< cells
  };

  /// With the border where it is best.
  Cost of(const Pulses& pulses) const {
    // Every cell's cost as one before the border and as one behind it: the border is moved through them.
    const std::size_t count = answers_.front().size();
    std::vector<double> more(count, 0);  ///< by having the cell before the border instead of behind it
    double cost = 0;
    for (std::size_t n = 0; n < answers_.size(); ++n) {
      for (std::size_t i = 0; i < count; ++i) {
        const Shares out = arrived(pulses, answers_[n], i);
        const double behind = variants[n].weight * before_border_ * loss(to_, out);
        more[i] += variants[n].weight * (1 - before_border_) * loss(from_, out) - behind;
        cost += behind;
      }
    }
    Cost best;
    for (std::size_t i = 0; i < count; ++i) {
      if (cost < best.cost - least_gain) best = {cost, i};
      cost += more[i];
    }
    return best;
  }

 private:
  Shares arrived(const Pulses& pulses, const Answer& answer, std::size_t at) const {
    Shares out = materials_[from_], fed = out;
    std::size_t begun = 0;
    const auto step_to = [&](const Shares& next) {
      for (std::size_t f = 0; at >= begun && f < max_feeders; ++f)
        out[f] += (next[f] - fed[f]) * answer[at - begun];
      fed = next;
    };
    for (const Pulse& pulse : pulses) {
      step_to(full(pulse));
      begun += static_cast<std::size_t>(pulse.cells);
    }
    step_to(materials_[to_]);
    return out;
  }

  double loss(std::size_t wanted, const Shares& out) const {
    const double misplaced_share = misplaced(out, materials_[wanted]);
    if (before_border_ != 0.5) return misplaced_share;  // as in the schedule
    const double own = squared_distance(out, materials_[wanted]);
    double wrong = 0;
    for (std::size_t i = 0; i < materials_.size(); ++i) {
      if (i == wanted) continue;
      const double apart = squared_distance(materials_[i], materials_[wanted]);
      if (apart == 0) continue;
      const double nearer = (own - squared_distance(out, materials_[i])) / apart;
      wrong = std::max(wrong, std::clamp(0.5 + nearer / blur, 0.0, 1.0));
    }
    return misplaced_share + wrong;
  }

  const std::vector<Shares>& materials_;
  const std::vector<Answer>& answers_;
  std::size_t from_, to_;
  double before_border_;
};

struct Found {
  Pulses pulses;
  Change::Cost cost;

  bool operator<(const Found& other) const { return cost.cost < other.cost.cost; }
};

/// Of the ways to make a change, the cheapest.
class Search {
 public:
  Search(const Change& change, double floor) : change_(change), floor_(floor) {}

  Found best(std::size_t most) const {
    Found best{{}, change_.of({})};
    for (std::size_t count = 1; count <= most; ++count) {
      Found more = with_one_more(best.pulses);
      if (more.cost.cost > pays * best.cost.cost) break;
      best = std::move(more);
    }
    return best;
  }

 private:
  /// As near as the floor allows.
  Found at(Pulses pulses) const {
    for (Pulse& pulse : pulses) {
      pulse.cells = std::clamp(pulse.cells, 1, longest);
      pulse.shares[0] = std::clamp(pulse.shares[0], floor_, std::max(floor_, 1 - 2 * floor_));
      const double rest = 1 - floor_ - pulse.shares[0];
      pulse.shares[1] = std::clamp(pulse.shares[1], floor_, std::max(floor_, rest));
    }
    const Change::Cost cost = change_.of(pulses);
    return {std::move(pulses), cost};
  }

  /// Before the others or behind them.
  Found with_one_more(const Pulses& pulses) const {
    std::vector<Found> coarse;
    constexpr int grid = 3;
    for (int a = 0; a <= grid; ++a) {
      for (int b = 0; a + b <= grid; ++b) {
        for (const int cells : {2, 5, 9}) {
          const Pulse pulse{{a / static_cast<double>(grid), b / static_cast<double>(grid)}, cells};
          Pulses more = pulses;
          more.push_back(pulse);
          coarse.push_back(at(more));
          if (pulses.empty()) continue;
          std::rotate(more.begin(), more.end() - 1, more.end());
          coarse.push_back(at(std::move(more)));
        }
      }
    }
    std::stable_sort(coarse.begin(), coarse.end());
    for (std::size_t i = 0; i < refined; ++i) refine(coarse[i]);
    return *std::min_element(coarse.begin(), coarse.begin() + refined);
  }

  /// Every number in turn a stride up and down; shorter strides when none is better.
  void refine(Found& best) const {
    int cells = 4;
    for (double stride = first_stride; stride >= last_stride; stride /= 2, cells = std::max(1, cells / 2)) {
      for (bool better = true; better;) {
        better = false;
        for (std::size_t p = 0; p < best.pulses.size(); ++p) {
          for (const Pulses& moved : neighbours(best.pulses, p, stride, cells)) {
            Found found = at(moved);
            if (found.cost.cost > best.cost.cost - least_gain) continue;
            best = std::move(found);
            better = true;
          }
        }
      }
    }
  }

  static std::vector<Pulses> neighbours(const Pulses& pulses, std::size_t p, double stride, int cells) {
    std::vector<Pulses> result;
    for (const int sign : {-1, 1}) {
      result.push_back(pulses);
      result.back()[p].cells += sign * cells;
      // From each feeder to each other one.
      for (const std::array<double, 2>& way : {std::array{1.0, 0.0}, {0.0, 1.0}, {1.0, -1.0}}) {
        result.push_back(pulses);
        for (std::size_t f = 0; f < 2; ++f) result.back()[p].shares[f] += sign * stride * way[f];
      }
    }
    return result;
  }

  const Change& change_;
  double floor_;
};

}  // namespace

PaletteWithOvershoots with_overshoots(Palette palette, const OvershootOptions& options) {
  const std::size_t count = palette.size(), changes = count * (count - 1);
  Overshoots overshoots;
  bool possible =
      changes > 0 && options.chamber.mixing_volume > 0 && count + changes <= options.most_mixtures;
  for (std::size_t i = 0; i < count; ++i) possible = possible && !palette.is_gradient(i);
  if (!possible) return {std::move(palette), std::move(overshoots)};
  const std::size_t most = std::min(most_pulses, (options.most_mixtures - count) / changes);
  const double step = cell * options.chamber.mixing_volume;
  std::vector<Answer> answers;
  for (const NozzleVariant& variant : variants) answers.push_back(answer_of(options.chamber, variant, step));
  std::vector<Shares> materials;
  for (std::size_t i = 0; i < count; ++i) materials.push_back(palette.mixture(Shade{i, 0}).shares());
  for (std::size_t from = 0; from < count; ++from) {
    for (std::size_t to = 0; to < count; ++to) {
      if (from == to) continue;
      const Change change(materials, answers, from, to, options.before_border);
      const Found found = Search(change, options.floor_share).best(most);
      if (found.pulses.empty()) continue;
      Overshoot overshoot;
      overshoot.lead = static_cast<double>(found.cost.lead) * step;
      for (const Pulse& pulse : found.pulses) {
        overshoot.pulses.push_back({palette.add(Mixture(full(pulse))), pulse.cells * step});
      }
      overshoots.add(from, to, std::move(overshoot));
    }
  }
  return {std::move(palette), std::move(overshoots)};
}

void Overshoots::add(std::size_t from, std::size_t to, Overshoot overshoot) {
  known_[{from, to}] = std::move(overshoot);
}

const Overshoot* Overshoots::between(std::size_t from, std::size_t to) const {
  const auto found = known_.find({from, to});
  return found == known_.end() ? nullptr : &found->second;
}

}  // namespace unicursal::gcode
