#include "host/lookahead/lookahead.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <numeric>
#include <thread>

#include "core/stopping.hpp"
#include "host/lookahead/foretold_times.hpp"
#include "host/lookahead/low_priority.hpp"
#include "host/lookahead/pacer.hpp"
#include "host/lookahead/timeline.hpp"

namespace unicursal::host {
namespace {

constexpr double margin = 1;  ///< how long before the printer needs it a layer is to be ready, s

/// The finaliser of SplitMix64 (Steele, Lea, Flood 2014), in which every input bit affects all output bits.
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

double area_of(const core::Layer& layer) {
  double area = 0;
  for (const core::Island& island : layer.islands) area += core::area(island.outline);
  return area;
}

/// A layer that is being sliced or planned, or waits to be handed over.
struct OpenLayer {
  PlannedLayer result;
  bool sliced = false;
  std::size_t begun = 0;     ///< number of islands
  std::size_t finished = 0;  ///< number of islands
  std::exception_ptr error;
  double area = 0;           ///< mm²
  double print_seconds = 0;  ///< estimated from the flow
  double sliced_at = 0;      ///< time on the printer's clock, s; in virtual time only
  double planned_cells = 0;  ///< total of the islands planned so far
  std::size_t shown_to = 0;  ///< number of the last viewer who has seen it
  bool being_shown = false;  ///< nobody may take it

  bool has_work() const { return sliced && !error && begun < result.plans.size(); }
  bool complete() const { return error ? begun == finished : sliced && finished == result.plans.size(); }
  bool may_be_taken() const { return complete() && !being_shown; }

  void add_effort(double part, double cells) {
    const double before = planned_cells;
    planned_cells += cells;
    if (planned_cells > 0) result.effort = (result.effort * before + part * cells) / planned_cells;
  }
};

/// An island that is being planned.
struct Attempt {
  double cells = 0;  ///< area ÷ bead width²
  double begun = 0;  ///< time on the clock, s
  double allowed = no_hurry;
  std::optional<double> cut;  ///< when its optimisers were stopped, s
};

}  // namespace

std::uint64_t island_seed(std::uint64_t job_seed, std::size_t layer, std::size_t island) {
  return mixed(mixed(mixed(job_seed) + layer) + island);
}

struct Lookahead::State {
  using Clock = std::chrono::steady_clock;

  State(const core::Part& source, const LookaheadOptions& chosen) : part(source), options(chosen) {
    if (!options.planner) options.planner = std::make_shared<const core::IslandPlanner>(part.zones());
    if (options.threads == 0) options.threads = std::max(1U, std::thread::hardware_concurrency());
    const bool in_seconds = options.horizon > 0 && options.flow > 0;
    if (options.ahead == 0) options.ahead = in_seconds ? most_ahead : default_ahead(options.threads);
    if (!in_seconds) options.horizon = no_hurry;
    next_layer = options.first;
    if (options.pace) pacer = Pacer(options.threads, options.pace->now ? 1 : options.pace->charge);
  }

  /// Separate from the constructor, so that if one thread cannot be started the destructor stops the others.
  void start() {
    for (std::size_t i = 0; i < options.threads; ++i) workers.emplace_back([this] { work(); });
  }

  ~State() {
    const std::lock_guard lock(mutex);
    stop();
  }

  std::size_t end() const { return options.first + options.count; }
  bool front_ready() const { return !open.empty() && open.front()->may_be_taken(); }
  bool exhausted() const { return cancelled || (open.empty() && next_layer == end()); }

  bool may_open() const {
    if (next_layer == end() || open.size() >= options.ahead) return false;
    return open.size() <= options.threads || seconds_ahead() < options.horizon;
  }

  double seconds_ahead() const {
    double sum = 0;
    for (const auto& layer : open) sum += layer->print_seconds;
    return sum;
  }

  /// The time at which the nozzle needs the layer, s.
  double need_of(const OpenLayer& layer) const {
    if (!position) return no_hurry;
    double need = *position;
    for (const auto& before : open) {
      if (before.get() == &layer) break;
      need = std::max(need, before->result.ready_at) + before->print_seconds;
    }
    return need;
  }

  OpenLayer* layer_with_work() const {
    const auto found = std::find_if(open.begin(), open.end(), [](const auto& l) { return l->has_work(); });
    return found == open.end() ? nullptr : found->get();
  }

  OpenLayer* layer_to_show() const {
    if (!viewer) return nullptr;
    for (const auto& layer : open) {
      if (!layer->complete() || layer->error) break;
      if (!layer->being_shown && layer->shown_to != viewer_number) return layer.get();
    }
    return nullptr;
  }

  /// Older layers first: islands of open layers are planned before a new layer is sliced.
  void work() {
    lower_priority();
    const core::StopScope scope(given_up.get_token());
    Timeline time(options.pace);
    std::unique_lock lock(mutex);
    for (;;) {
      work_available.wait(lock,
                          [&] { return cancelled || layer_to_show() || layer_with_work() || may_open(); });
      if (cancelled) return;
      if (OpenLayer* planned = layer_to_show())
        show_one(lock, *planned);
      else if (OpenLayer* layer = layer_with_work())
        plan_one(lock, *layer, time);
      else
        slice_one(lock, time);
      if (front_ready()) wake_consumer();
    }
  }

  void slice_one(std::unique_lock<std::mutex>& lock, Timeline& time) {
    OpenLayer& layer = *open.emplace_back(std::make_unique<OpenLayer>());
    most_open = std::max(most_open, open.size());
    const std::size_t index = next_layer++;
    time.begin(room_since);
    run(lock, layer, time, [&] {
      layer.result.layer = part.layer(index);
      layer.result.plans.resize(layer.result.layer.islands.size());
      layer.result.bare.resize(layer.result.plans.size());
    });
    layer.area = area_of(layer.result.layer);
    layer.print_seconds = foretold_seconds(layer.result.layer, options.flow);
    layer.sliced_at = time.ended();
    layer.sliced = true;
    work_available.notify_all();
  }

  void plan_one(std::unique_lock<std::mutex>& lock, OpenLayer& layer, Timeline& time) {
    const std::size_t index = layer.begun++;
    const core::Island& island = layer.result.layer.islands[index];
    time.begin(layer.sliced_at);
    Attempt attempt = attempt_at(layer, island, time);
    core::PlanOptions plan = options.plan;
    plan.seed = island_seed(options.plan.seed, layer.result.layer.index, index);
    plan.threads = threads_for(layer);
    plan.budget_spent = [&] { return enough(layer, attempt, time); };
    run(lock, layer, time, [&] {
      layer.result.plans[index] = options.planner->plan(island, layer.result.layer.z, plan);
      layer.result.bare[index] = core::look_for_bare(layer.result.plans[index], island.outline,
                                                     plan.bead_width, plan.min_bead_width);
    });
    if (!layer.error) learn(layer, attempt, layer.result.plans[index].effort, time.now());
    ++layer.finished;
  }

  void show_one(std::unique_lock<std::mutex>& lock, OpenLayer& layer) {
    layer.being_shown = true;
    layer.shown_to = viewer_number;
    const auto show = viewer;
    lock.unlock();
    try {
      show(layer.result);
    } catch (...) {
      // A layer that cannot be shown, such as for want of memory, is printed all the same.
    }
    lock.lock();
    layer.being_shown = false;
    shown.notify_all();
  }

  bool nothing_is_shown() const {
    return std::none_of(open.begin(), open.end(), [](const auto& layer) { return layer->being_shown; });
  }

  /// The print waits for its first layer, so if that has a single island, it may use all threads. Not in
  /// virtual time, which charges every thread for its own work.
  int threads_for(const OpenLayer& layer) const {
    const bool alone = layer.result.layer.index == options.first && layer.result.plans.size() == 1;
    return alone && options.pace && options.pace->now ? static_cast<int>(options.threads) : 1;
  }

  Attempt attempt_at(const OpenLayer& layer, const core::Island& island, const Timeline& time) const {
    const double area = core::area(island.outline), w = options.plan.bead_width;
    const double share = layer.area > 0 ? area / layer.area : 1;
    Attempt attempt{area / (w * w), time.now(), no_hurry, {}};
    if (options.pace && !options.patient)
      attempt.allowed = pacer.allowance(need_of(layer) - attempt.begun, layer.print_seconds, share);
    return attempt;
  }

  /// Called without the lock, between the steps of the optimisers: whether they are to stop.
  bool enough(const OpenLayer& layer, Attempt& attempt, const Timeline& time) const {
    if (cancelled || attempt.cut) return true;
    if (!options.pace || options.patient) return false;
    const std::lock_guard lock(mutex);
    const double now = time.now(), done = now + pacer.tail(attempt.cells);
    if (done - attempt.begun < attempt.allowed && done + margin < need_of(layer)) return false;
    attempt.cut = now;
    return true;
  }

  /// Updates the pacer and the layer's effort after an island.
  void learn(OpenLayer& layer, const Attempt& attempt, const core::Effort& effort_taken, double now) {
    const double steps = std::accumulate(effort_taken.begin(), effort_taken.end(), 0.0);
    if (attempt.cut)
      pacer.learn_tail(attempt.cells, now - *attempt.cut);
    else
      pacer.learn_full(steps);
    layer.add_effort(attempt.cut ? pacer.part_of_full(steps) : 1, attempt.cells);
  }

  /// Runs `step` without the lock and keeps the first error for the consumer.
  void run(std::unique_lock<std::mutex>& lock, OpenLayer& layer, Timeline& time,
           const std::function<void()>& step) {
    std::exception_ptr error;
    begin_effort();
    lock.unlock();
    try {
      step();
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    const double spent = time.end();
    layer.result.cpu_seconds += spent;
    layer.result.ready_at = std::max(layer.result.ready_at, time.ended());
    end_effort(spent);
    if (error && !layer.error) layer.error = error;
  }

  void begin_effort() {
    if (active++ == 0) busy_since = Clock::now();
  }

  void end_effort(double cpu_seconds) {
    effort.cpu_seconds += cpu_seconds;
    if (--active == 0) effort.seconds += std::chrono::duration<double>(Clock::now() - busy_since).count();
  }

  void wake_consumer() {
    consumer.notify_all();
    if (listener) listener();
  }

  /// Precondition: locked, and front_ready() or exhausted().
  std::optional<PlannedLayer> take() {
    if (cancelled || open.empty()) return {};
    const std::unique_ptr<OpenLayer> layer = std::move(open.front());
    open.pop_front();
    room_since = last_report;
    // Until the next report, the next layer is assumed to be needed when this one is printed.
    if (position) *position = std::max(*position, layer->result.ready_at) + layer->print_seconds;
    work_available.notify_all();
    if (!layer->error) return std::move(layer->result);
    stop();
    std::rethrow_exception(layer->error);
  }

  void stop() {
    cancelled = true;
    given_up.request_stop();
    work_available.notify_all();
    wake_consumer();
  }

  const core::Part& part;
  LookaheadOptions options;
  Pacer pacer{1, 1};
  mutable std::mutex mutex;
  std::condition_variable work_available, consumer, shown;
  std::function<void()> listener;
  std::function<void(const PlannedLayer&)> viewer;
  std::size_t viewer_number = 0;
  std::deque<std::unique_ptr<OpenLayer>> open;  ///< in order of layers
  std::size_t next_layer = 0;
  std::size_t most_open = 0;
  std::atomic<bool> cancelled = false;
  std::stop_source given_up;  ///< with `cancelled`; ends what is being sliced or planned
  /// Time at which the printer needs the next layer, s; absent until it prints.
  std::optional<double> position;
  double last_report = 0;  ///< time of the last report, s
  double room_since = 0;   ///< time at which a layer was last taken, s
  PlanningEffort effort;
  std::size_t active = 0;  ///< number of threads that are slicing or planning
  Clock::time_point busy_since;
  std::vector<std::jthread> workers;  ///< the last member, so that they end before the members that they use
};

Lookahead::Lookahead(const core::Part& part, const LookaheadOptions& options)
    : state_(std::make_unique<State>(part, options)) {
  assert(options.first + options.count <= part.layer_count());
  state_->start();
}

Lookahead::~Lookahead() = default;

std::optional<PlannedLayer> Lookahead::wait() {
  std::unique_lock lock(state_->mutex);
  state_->consumer.wait(lock, [&] { return state_->front_ready() || state_->exhausted(); });
  return state_->take();
}

bool Lookahead::ready() const {
  const std::lock_guard lock(state_->mutex);
  return state_->front_ready() || state_->exhausted();
}

void Lookahead::on_ready(std::function<void()> listener) {
  const std::lock_guard lock(state_->mutex);
  state_->listener = std::move(listener);
}

void Lookahead::on_planned(std::function<void(const PlannedLayer&)> viewer) {
  const bool nobody = !viewer;
  std::unique_lock lock(state_->mutex);
  std::swap(state_->viewer, viewer);  // the former one goes away when the lock has been released
  ++state_->viewer_number;
  state_->work_available.notify_all();
  if (nobody) state_->shown.wait(lock, [this] { return state_->nothing_is_shown(); });
}

void Lookahead::printed(double now, double left) {
  const std::lock_guard lock(state_->mutex);
  state_->last_report = now;
  state_->position = now + left;
}

void Lookahead::cancel() {
  const std::lock_guard lock(state_->mutex);
  state_->stop();
}

PlanningEffort Lookahead::effort() const {
  const std::lock_guard lock(state_->mutex);
  return state_->effort;
}

Waiting Lookahead::waiting() const {
  const std::lock_guard lock(state_->mutex);
  Waiting waiting;
  for (const auto& layer : state_->open) {
    if (!layer->complete() || layer->error) break;
    ++waiting.layers;
    waiting.seconds += layer->print_seconds;
  }
  return waiting;
}

std::size_t Lookahead::threads() const {
  return state_->options.threads;
}

std::size_t Lookahead::most_open() const {
  const std::lock_guard lock(state_->mutex);
  return state_->most_open;
}

}  // namespace unicursal::host
