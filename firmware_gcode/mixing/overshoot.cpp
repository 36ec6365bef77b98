#include "firmware_gcode/mixing/overshoot.hpp"

#include <algorithm>
#include <array>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace unicursal::gcode {
namespace {

constexpr double cell = 1.0 / 24;       ///< of the mixing volume: step of the computation
constexpr double reckoned = 2.5;        ///< mixing volumes after which a change is complete
constexpr std::size_t most_pulses = 2;  ///< a third one gains hardly anything
constexpr int longest = 24;             ///< cells in a pulse
constexpr double pays = 0.95;           ///< of the cost without the pulse: a smaller gain is not worth a tool
constexpr double first_stride = 0.16, last_stride = 0.02;  ///< of the shares, in the search
constexpr std::size_t refined = 3;  ///< best points of the coarse grid that are refined
constexpr double blur = 0.1;  ///< relative: "nearer" fades over this width, which gives the search a slope
constexpr double least_gain = 1e-6;

/// A nozzle that the printer may have instead of the one in its profile.
struct NozzleVariant {
  double volumes;  ///< factor of the volumes
  int tanks;       ///< additional tanks
  double weight;
};
constexpr std::array<NozzleVariant, 3> variants{{{1, 0, 2}, {0.85, -1, 1}, {1.15, 1, 1}}};

/// The step response in the middle of each cell, behind the dead volume of the profile.
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
  Shares shares;  ///< the last feeder has what the others leave (give_last_the_rest())
  int cells = 0;
};
using Pulses = boost::container::static_vector<Pulse, most_pulses>;

void give_last_the_rest(Shares& shares) {
  double rest = 1;
  for (std::size_t f = 0; f + 1 < shares.size(); ++f) rest -= shares[f];
  shares[shares.size() - 1] = std::max(0.0, rest);
}

/// All shares of so many feeders in steps of 1 ÷ `grid`.
std::vector<Shares> shares_on_grid(std::size_t feeders, int grid) {
  std::vector<Shares> all;
  Shares shares = Shares::zeros(feeders);
  const std::function<void(std::size_t, int)> choose = [&](std::size_t feeder, int left) {
    if (feeder + 1 == feeders) {
      give_last_the_rest(shares);
      all.push_back(shares);
      return;
    }
    for (int part = 0; part <= left; ++part) {
      shares[feeder] = part / static_cast<double>(grid);
      choose(feeder + 1, left - part);
    }
  };
  choose(0, grid);
  return all;
}

/// A change from one mixture to another, and the cost of carrying it out with given pulses.
class Change {
 public:
  Change(const std::vector<Shares>& materials, const std::vector<Answer>& answers, std::size_t from,
         std::size_t to, double before_border)
      : materials_(materials), answers_(answers), from_(from), to_(to), before_border_(before_border) {
    for (const Shares& material : materials) {
      apart_from_.push_back(squared_distance(material, materials[from]));
      apart_to_.push_back(squared_distance(material, materials[to]));
    }
  }

  struct Cost {
    double cost = std::numeric_limits<double>::infinity();  ///< cells of plastic
    std::size_t lead = 0;                                   ///< cells
  };

  /// The cost with the border at its best place.
  Cost of(const Pulses& pulses) const {
    // A cell costs differently before and behind the border. Start with all cells behind it, then move it on.
    const std::size_t count = answers_.front().size();
    std::vector<double> more(count, 0);  ///< cost of the cell before the border minus its cost behind it
    double cost = 0;
    for (std::size_t n = 0; n < answers_.size(); ++n) {
      for (std::size_t i = 0; i < count; ++i) {
        const Shares out = arrived(pulses, answers_[n], i);
        const double behind = variants[n].weight * before_border_ * loss(to_, apart_to_, out);
        more[i] += variants[n].weight * (1 - before_border_) * loss(from_, apart_from_, out) - behind;
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
    Shares out = materials_[from_];
    const Shares* fed = &materials_[from_];
    std::size_t begun = 0;
    const auto step_to = [&](const Shares& next) {
      if (at >= begun) {
        const double part = answer[at - begun];
        for_each_feeder(out.size(), [&](std::size_t f) { out[f] += (next[f] - (*fed)[f]) * part; });
      }
      fed = &next;
    };
    for (const Pulse& pulse : pulses) {
      step_to(pulse.shares);
      begun += static_cast<std::size_t>(pulse.cells);
    }
    step_to(materials_[to_]);
    return out;
  }

  /// `apart`: the squared distances of all materials from the wanted one.
  double loss(std::size_t wanted, const std::vector<double>& apart, const Shares& out) const {
    const double misplaced_share = misplaced(out, materials_[wanted]);
    if (before_border_ != 0.5) return misplaced_share;  // like the schedule
    const double own = squared_distance(out, materials_[wanted]);
    double wrong = 0;
    for (std::size_t i = 0; i < materials_.size(); ++i) {
      if (i == wanted || apart[i] == 0) continue;
      const double nearer = (own - squared_distance(out, materials_[i])) / apart[i];
      wrong = std::max(wrong, std::clamp(0.5 + nearer / blur, 0.0, 1.0));
    }
    return misplaced_share + wrong;
  }

  const std::vector<Shares>& materials_;
  const std::vector<Answer>& answers_;
  std::size_t from_, to_;
  std::vector<double> apart_from_, apart_to_;
  double before_border_;
};

struct Found {
  Pulses pulses;
  Change::Cost cost;

  bool operator<(const Found& other) const { return cost.cost < other.cost.cost; }
};

/// Finds the cheapest way to carry out a change.
class Search {
 public:
  Search(const Change& change, std::size_t feeders, double floor)
      : change_(change), feeders_(feeders), floor_(floor) {}

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
  /// The cost of the pulses, clamped to what the floor share allows.
  Found at(Pulses pulses) const {
    for (Pulse& pulse : pulses) {
      pulse.cells = std::clamp(pulse.cells, 1, longest);
      for (std::size_t f = 0; f + 1 < feeders_; ++f) {
        double most = 1 - static_cast<double>(feeders_ - 1 - f) * floor_;
        for (std::size_t before = 0; before < f; ++before) most -= pulse.shares[before];
        pulse.shares[f] = std::clamp(pulse.shares[f], floor_, std::max(floor_, most));
      }
      give_last_the_rest(pulse.shares);
    }
    const Change::Cost cost = change_.of(pulses);
    return {std::move(pulses), cost};
  }

  /// Adds a pulse before or behind the others.
  Found with_one_more(const Pulses& pulses) const {
    std::vector<Found> coarse;
    constexpr int grid = 3;
    for (const Shares& shares : shares_on_grid(feeders_, grid)) {
      for (const int cells : {2, 5, 9}) {
        Pulses more = pulses;
        more.push_back({shares, cells});
        coarse.push_back(at(more));
        if (pulses.empty()) continue;
        std::rotate(more.begin(), more.end() - 1, more.end());
        coarse.push_back(at(std::move(more)));
      }
    }
    std::stable_sort(coarse.begin(), coarse.end());
    for (std::size_t i = 0; i < refined; ++i) refine(coarse[i]);
    return *std::min_element(coarse.begin(), coarse.begin() + refined);
  }

  /// Pattern search: moves every number in turn by a stride up and down; halves the stride if no move
  /// improves.
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

  std::vector<Pulses> neighbours(const Pulses& pulses, std::size_t p, double stride, int cells) const {
    std::vector<Pulses> result;
    const std::size_t last = feeders_ - 1;
    result.reserve(2 + feeders_ * last);
    for (const int sign : {-1, 1}) {
      result.push_back(pulses);
      result.back()[p].cells += sign * cells;
      // Moves share from each feeder to each other one; at() gives the last one the rest.
      for (std::size_t f = 0; f < last; ++f) {
        result.push_back(pulses);
        result.back()[p].shares[f] += sign * stride;
      }
      for (std::size_t f = 0; f < last; ++f) {
        for (std::size_t other = f + 1; other < last; ++other) {
          result.push_back(pulses);
          result.back()[p].shares[f] += sign * stride;
          result.back()[p].shares[other] -= sign * stride;
        }
      }
    }
    return result;
  }

  const Change& change_;
  std::size_t feeders_;
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
      const Found found = Search(change, palette.feeders(), options.floor_share).best(most);
      if (found.pulses.empty()) continue;
      Overshoot overshoot;
      overshoot.lead = static_cast<double>(found.cost.lead) * step;
      for (const Pulse& pulse : found.pulses) {
        overshoot.pulses.push_back({palette.add(Mixture(pulse.shares)), pulse.cells * step});
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
