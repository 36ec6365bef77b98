#include "firmware_gcode/mixing/schedule.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace unicursal::gcode {
namespace {

constexpr double fine = 1.0 / 16;           ///< of the mixing volume: step where survivors may switch
constexpr double coarse = 1.0 / 4;          ///< step elsewhere
constexpr double finest = 0.05;             ///< mm³, for chambers that hardly mix
constexpr double gradient_step = 1.0 / 16;  ///< of the mixing volume: closer shades do not show
constexpr double late = 0.25;  ///< mixing volumes behind a border within which a switch may still come
constexpr double switch_cost = 0.002;  ///< mixing volumes: avoids useless switches
constexpr double hopeless =
    1.5;  ///< mixing volumes: survivors more expensive than the best by this are dropped
constexpr double alike = 0.01;  ///< shares: survivors that differ less are merged
constexpr std::size_t most_survivors = 400;
constexpr int steps_to_settle = 4;
constexpr double same_place = 1e-9;  ///< mm³

/// One sequence of switches so far (a survivor of Viterbi's algorithm).
struct Survivor {
  double cost = 0;
  Tanks tanks;
  std::size_t run_fed = 0;  ///< index of the run for which the feeders deliver
  Shade shade;
  std::vector<Switch> switches;          ///< those that are not certain yet
  const Overshoot* overshoot = nullptr;  ///< its pulses are being fed; the shade follows
  std::size_t pulse = 0;                 ///< index of the pulse being fed
  double pulse_end = 0;                  ///< volume at the inlet of the tanks

  const Shade& fed() const { return overshoot ? overshoot->pulses[pulse].shade : shade; }
};

bool feed_alike(const Survivor& a, const Survivor& b) {
  return a.shade == b.shade && a.overshoot == b.overshoot &&
         (!a.overshoot || (a.pulse == b.pulse && a.pulse_end == b.pulse_end));
}

}  // namespace

struct Schedule::State {
  State(const Palette& of, const ScheduleOptions& with)
      : palette(of),
        options(with),
        wanted(of),
        step(std::max(fine * with.chamber.mixing_volume, finest)),
        long_step(std::max(coarse * with.chamber.mixing_volume, finest)),
        lead(with.chamber.delay(with.before_border) - with.chamber.dead_volume),
        reach(std::max(with.chamber.delay(with.early) - with.chamber.dead_volume, step)),
        after(std::max(late * with.chamber.mixing_volume, step)),
        gradient_lead(with.chamber.mean_delay() - with.chamber.dead_volume),
        at(with.chamber.dead_volume) {}

  void switch_at_borders();
  void decide();
  void begin();
  bool near_border() const;
  double border_of(std::size_t run) const;
  double next_place() const;
  double lead_into(std::size_t run) const;
  const Overshoot* overshoot_between(const Shade& from, const Shade& to) const;
  void branch();
  void change(std::size_t survivor, std::size_t run, const Shade& shade, const Overshoot* overshoot);
  Shares pass(Survivor& survivor, double to) const;
  void follow_gradients();
  double loss(const Mismatch& bad) const;
  void advance(double to);
  void prune();
  void settle();
  void make_certain(const Switch& made);
  Shade shade_for(const WantedRun& run) const;

  const Palette& palette;
  const ScheduleOptions options;
  WantedRuns wanted;
  const double step, long_step;
  const double lead;   ///< mm³ from a switch until the wanted fraction of it leaves the tanks
  const double reach;  ///< how far before a run survivors may switch to it
  const double after;
  const double gradient_lead;

  double at;  ///< volume at the inlet of the tanks up to which all is computed; that plastic was fed
              ///< dead_volume earlier
  std::size_t here = 0;  ///< index of the run at `at`
  bool ended = false;
  std::vector<Survivor> survivors;
  double sure = 0;
  std::vector<Switch> made;
  std::optional<Shade> last_made;
  double next_gradient_step = 0;
  int steps = 0;  ///< since the survivors were last compared
};

void Schedule::State::make_certain(const Switch& next) {
  if (last_made && palette.mixture(*last_made) == palette.mixture(next.shade)) return;
  last_made = next.shade;
  made.push_back(next);
}

/// For comparison: as if the chamber responded at once.
void Schedule::State::switch_at_borders() {
  for (; here < wanted.past(); ++here) {
    const WantedRun& run = wanted.run(here);
    double volume = std::max(run.begin, sure);
    make_certain({volume, palette.shade(run.material, run.part_at(volume))});
    for (const auto& [end, part] : run.parts) {
      if (end <= sure) continue;
      make_certain({volume, palette.shade(run.material, part)});
      volume = end;
    }
    if (here + 1 == wanted.past()) break;  // the last run may still grow
  }
  sure = wanted.end();
  wanted.forget_before(here);
}

Shade Schedule::State::shade_for(const WantedRun& run) const {
  return palette.shade(run.material, run.part_at(at + gradient_lead));
}

/// Creates a survivor for each of the first materials.
void Schedule::State::begin() {
  here = 0;
  while (wanted.run(here).end <= at && here + 1 < wanted.past()) ++here;
  const Tanks fresh(options.chamber, Mixture::equal(palette.feeders()).shares());
  for (std::size_t i = 0; i < wanted.past() && wanted.run(i).begin <= at + reach; ++i) {
    const Shade shade = shade_for(wanted.run(i));
    survivors.push_back({0, fresh, i, shade, {{0, shade}}});
  }
}

/// The last run may still grow, so that its border is unknown.
double Schedule::State::border_of(std::size_t run) const {
  const bool final = ended || run + 1 < wanted.past();
  return final ? wanted.run(run).end : std::numeric_limits<double>::infinity();
}

bool Schedule::State::near_border() const {
  return border_of(here) - at < reach + same_place || (here > 0 && at - wanted.run(here).begin < after);
}

/// The next volume to stop at: a grid step, a border, or the best place of a single change.
double Schedule::State::next_place() const {
  const bool in_gradient = palette.is_gradient(wanted.run(here).material);
  double place = at + (near_border() || in_gradient ? step : long_step);
  if (border_of(here) - reach > at + same_place) place = std::min(place, border_of(here) - reach);
  for (std::size_t i = here; i < wanted.past() && border_of(i) - reach < place; ++i) {
    for (const double before : {lead, lead_into(i + 1)}) {
      const double best = border_of(i) - before;
      if (best > at + same_place) place = std::min(place, best);
    }
  }
  return std::min(place, border_of(here));
}

/// The lead of a change into a run that is made with an overshoot.
double Schedule::State::lead_into(std::size_t run) const {
  if (run >= wanted.past()) return lead;
  const Overshoot* by = overshoot_between({wanted.run(run - 1).material, 0}, {wanted.run(run).material, 0});
  return by ? by->lead : lead;
}

const Overshoot* Schedule::State::overshoot_between(const Shade& from, const Shade& to) const {
  return options.overshoots ? options.overshoots->between(from.material, to.material) : nullptr;
}

/// Adds a copy of a survivor that switches here.
void Schedule::State::change(std::size_t survivor, std::size_t run, const Shade& shade,
                             const Overshoot* overshoot) {
  Survivor changed = survivors[survivor];
  const std::size_t switches = 1 + (overshoot ? overshoot->pulses.size() : 0);
  changed.cost += static_cast<double>(switches) * switch_cost * options.chamber.mixing_volume;
  changed.run_fed = run;
  changed.shade = shade;
  changed.overshoot = overshoot;
  changed.pulse = 0;
  if (overshoot) changed.pulse_end = at + overshoot->pulses.front().volume;
  changed.switches.push_back({at - options.chamber.dead_volume, changed.fed()});
  survivors.push_back(std::move(changed));
}

/// Survivors deliver for the runs in their order, each once, and never go back to an earlier run. So
/// survivors differ in where they have switched and not in how often.
void Schedule::State::branch() {
  const std::size_t count = survivors.size();
  for (std::size_t s = 0; s < count; ++s) {
    if (survivors[s].run_fed < here && survivors[s].shade == shade_for(wanted.run(here)))
      survivors[s].run_fed = here;
  }
  for (std::size_t i = here; i < wanted.past() && wanted.run(i).begin <= at + reach; ++i) {
    if (i == here && here > 0 && at - wanted.run(i).begin >= after) continue;
    const Shade shade = shade_for(wanted.run(i));
    for (std::size_t s = 0; s < count; ++s) {
      if (survivors[s].run_fed >= i || survivors[s].shade == shade) continue;
      change(s, i, shade, nullptr);
      if (const Overshoot* by = overshoot_between(survivors[s].shade, shade)) change(s, i, shade, by);
    }
  }
}

void Schedule::State::follow_gradients() {
  if (at < next_gradient_step) return;
  next_gradient_step = at + std::max(gradient_step * options.chamber.mixing_volume, finest);
  for (Survivor& survivor : survivors) {
    if (!palette.is_gradient(survivor.shade.material) || survivor.run_fed < wanted.first()) continue;
    const Shade shade = shade_for(wanted.run(survivor.run_fed));
    if (shade == survivor.shade) continue;
    survivor.shade = shade;
    survivor.switches.push_back({at - options.chamber.dead_volume, shade});
  }
}

/// The misplaced fraction, plus 1 if a person (and the report) takes the plastic for another material. The
/// second term would pull every change to its 50 % point, so that it is left out if another fraction is asked
/// for.
double Schedule::State::loss(const Mismatch& bad) const {
  return bad.misplaced + (bad.wrong && options.before_border == 0.5 ? 1 : 0);
}

/// Feeds the survivor up to `to` and returns the mean outflow.
Shares Schedule::State::pass(Survivor& survivor, double to) const {
  Shares mean = Shares::zeros(palette.feeders());
  for (double from = at; from < to;) {
    const double end = survivor.overshoot ? std::min(to, survivor.pulse_end) : to;
    if (end > from) {
      const Shares out = survivor.tanks.pass(palette.mixture(survivor.fed()).shares(), end - from);
      for_each_feeder(mean.size(), [&](std::size_t f) { mean[f] += out[f] * (end - from) / (to - at); });
    }
    from = std::max(from, end);
    if (!survivor.overshoot || end < survivor.pulse_end) continue;
    if (++survivor.pulse == survivor.overshoot->pulses.size())
      survivor.overshoot = nullptr;
    else
      survivor.pulse_end += survivor.overshoot->pulses[survivor.pulse].volume;
    survivor.switches.push_back({end - options.chamber.dead_volume, survivor.fed()});
  }
  return mean;
}

void Schedule::State::advance(double to) {
  const double volume = to - at, middle = (at + to) / 2;
  const WantedRun& run = wanted.run(here);
  const Shares want = wanted.shares(run, middle);
  // The first half of a run holds the tail of the change before it, the second half the head of the next.
  const double left = border_of(here) - middle;
  const bool head = left < reach && left < middle - run.begin;
  const double weight = 2 * run.weight * volume * (head ? 1 - options.before_border : options.before_border);
  for (Survivor& survivor : survivors) {
    survivor.cost += weight * loss(mismatch(palette, run, want, pass(survivor, to)));
  }
  at = to;
  while (wanted.run(here).end <= at + same_place && here + 1 < wanted.past()) ++here;
}

void Schedule::State::prune() {
  std::stable_sort(survivors.begin(), survivors.end(),
                   [](const Survivor& a, const Survivor& b) { return a.cost < b.cost; });
  const double limit = survivors.front().cost + std::max(hopeless * options.chamber.mixing_volume, finest);
  std::vector<Survivor> kept;
  for (Survivor& survivor : survivors) {
    if (survivor.cost > limit || kept.size() == most_survivors) break;
    const bool seen = std::any_of(kept.begin(), kept.end(), [&](const Survivor& other) {
      return feed_alike(other, survivor) && other.tanks.is_like(survivor.tanks, alike);
    });
    if (!seen) kept.push_back(std::move(survivor));
  }
  survivors = std::move(kept);
}

/// Hands over the switches that all survivors share; beyond the horizon, the best survivor decides.
void Schedule::State::settle() {
  steps = 0;
  prune();
  const double dead = options.chamber.dead_volume;
  const double overdue = ended && at >= wanted.end() - same_place
                             ? std::numeric_limits<double>::infinity()
                             : at - dead - std::max(options.horizon * options.chamber.mixing_volume, step);
  for (;;) {
    const std::vector<Switch>& best = survivors.front().switches;
    const auto agrees = [&best](const Survivor& s) {
      if (best.empty() || s.switches.empty()) return best.empty() && s.switches.empty();
      return s.switches.front().at == best.front().at && s.switches.front().shade == best.front().shade;
    };
    const bool agreed = std::all_of(survivors.begin(), survivors.end(), agrees);
    if (!agreed) {
      double next = std::numeric_limits<double>::infinity();
      for (const Survivor& s : survivors) {
        if (!s.switches.empty()) next = std::min(next, s.switches.front().at);
      }
      if (next > overdue) {
        sure = std::max(sure, next);
        return;
      }
      std::erase_if(survivors, [&](const Survivor& s) { return !agrees(s); });
    }
    if (survivors.front().switches.empty()) break;
    make_certain(survivors.front().switches.front());
    for (Survivor& s : survivors) s.switches.erase(s.switches.begin());
  }
  sure = std::max(sure, ended && at >= wanted.end() - same_place ? wanted.end() : at - dead);
}

void Schedule::State::decide() {
  if (!options.look_ahead) return switch_at_borders();
  if (wanted.past() == 0) return;
  const double limit = ended ? wanted.end() : wanted.end() - reach;
  if (survivors.empty()) {
    if (limit <= at && !ended) return;
    begin();
  }
  // The result must not depend on when take() is called, so that a step is cut short only at the end.
  while (at < limit - same_place) {
    const double to = next_place();
    if (to > limit) break;
    if (near_border()) branch();
    follow_gradients();
    advance(to);
    if (++steps >= steps_to_settle) settle();
  }
  if (ended) settle();
  wanted.forget_before(here > 0 ? here - 1 : 0);
}

Schedule::Schedule(const Palette& palette, const ScheduleOptions& options)
    : state_(std::make_unique<State>(palette, options)) {
  assert(options.before_border > 0 && options.before_border < 1);
}
Schedule::~Schedule() = default;
Schedule::Schedule(Schedule&&) noexcept = default;

void Schedule::add(const WantedBead& piece) {
  state_->wanted.add(piece);
}

void Schedule::end() {
  state_->ended = true;
}

std::vector<Switch> Schedule::take() {
  state_->decide();
  return std::exchange(state_->made, {});
}

double Schedule::certain() const {
  return state_->sure;
}

}  // namespace unicursal::gcode
