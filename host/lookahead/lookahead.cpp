#include "host/lookahead/lookahead.hpp"

#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <asio/post.hpp>
#include <asio/redirect_error.hpp>
#include <asio/steady_timer.hpp>
#include <asio/this_coro.hpp>
#include <asio/use_awaitable.hpp>
#include <cassert>
#include <chrono>
#include <condition_variable>
#include <ctime>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace unicursal::host {
namespace {

/// Added to the niceness of planning threads, so that the link is served first on a busy machine.
constexpr int planner_niceness = 10;

/// Best effort: where it is refused, planning just competes on equal terms.
void lower_priority() {
  const sched_param parameters{};
  pthread_setschedparam(pthread_self(), SCHED_BATCH, &parameters);
  const auto thread = static_cast<id_t>(gettid());
  setpriority(PRIO_PROCESS, thread, planner_niceness);
}

/// Steele, Lea, Flood 2014: the finaliser of SplitMix64, which spreads every bit over all.
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

double thread_cpu_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double volume(const core::Layer& layer) {
  double area = 0;
  for (const core::Island& island : layer.islands) area += core::area(island.outline);
  return area * layer.height;
}

/// A layer between being sliced and being handed over.
struct OpenLayer {
  PlannedLayer result;
  bool sliced = false;
  std::size_t begun = 0;     ///< islands
  std::size_t finished = 0;  ///< islands
  std::exception_ptr error;
  double print_seconds = 0;  ///< as the flow foretells

  bool has_work() const { return sliced && !error && begun < result.plans.size(); }
  bool complete() const { return error ? begun == finished : sliced && finished == result.plans.size(); }
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
    if (options.ahead == 0) options.ahead = options.threads + 2;
    next_layer = options.first;
  }

  /// Apart from construction, so that the destructor stops those that did start when one could not.
  void start() {
    for (std::size_t i = 0; i < options.threads; ++i) workers.emplace_back([this] { work(); });
  }

  ~State() {
    const std::lock_guard lock(mutex);
    stop();
  }

  std::size_t end() const { return options.first + options.count; }
  bool may_open() const { return open.size() < options.ahead && next_layer < end(); }
  bool front_ready() const { return !open.empty() && open.front()->complete(); }
  bool exhausted() const { return cancelled || (open.empty() && next_layer == end()); }

  OpenLayer* layer_with_work() const {
    const auto found = std::find_if(open.begin(), open.end(), [](const auto& l) { return l->has_work(); });
    return found == open.end() ? nullptr : found->get();
  }

  /// Older layers first: islands of open layers come before a new layer is cut.
  void work() {
    lower_priority();
    std::unique_lock lock(mutex);
    for (;;) {
      work_available.wait(lock, [&] { return cancelled || layer_with_work() || may_open(); });
      if (cancelled) return;
      if (OpenLayer* layer = layer_with_work())
        plan_one(lock, *layer);
      else
        slice_one(lock);
      if (front_ready()) wake_consumer();
    }
  }

  void slice_one(std::unique_lock<std::mutex>& lock) {
    OpenLayer& layer = *open.emplace_back(std::make_unique<OpenLayer>());
    most_open = std::max(most_open, open.size());
    const std::size_t index = next_layer++;
    run(lock, layer, [&] {
      layer.result.layer = part.layer(index);
      layer.result.plans.resize(layer.result.layer.islands.size());
      if (options.flow > 0) layer.print_seconds = volume(layer.result.layer) / options.flow;
    });
    layer.sliced = true;
    work_available.notify_all();
  }

  void plan_one(std::unique_lock<std::mutex>& lock, OpenLayer& layer) {
    const std::size_t island = layer.begun++;
    run(lock, layer, [&] {
      core::PlanOptions plan = options.plan;
      plan.seed = island_seed(options.plan.seed, layer.result.layer.index, island);
      layer.result.plans[island] =
          options.planner->plan(layer.result.layer.islands[island], layer.result.layer.z, plan);
    });
    ++layer.finished;
  }

  /// Runs `step` unlocked and keeps the first error for the consumer.
  void run(std::unique_lock<std::mutex>& lock, OpenLayer& layer, const std::function<void()>& step) {
    std::exception_ptr error;
    begin_effort();
    lock.unlock();
    const double cpu_before = thread_cpu_seconds();
    try {
      step();
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    const double spent = thread_cpu_seconds() - cpu_before;
    layer.result.cpu_seconds += spent;
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
    if (wake_coroutine) wake_coroutine();
    wake_coroutine = nullptr;
  }

  /// Precondition: locked, and front_ready() or exhausted().
  std::optional<PlannedLayer> take() {
    if (cancelled || open.empty()) return {};
    const std::unique_ptr<OpenLayer> layer = std::move(open.front());
    open.pop_front();
    work_available.notify_all();
    if (!layer->error) return std::move(layer->result);
    stop();
    std::rethrow_exception(layer->error);
  }

  void stop() {
    cancelled = true;
    work_available.notify_all();
    wake_consumer();
  }

  const core::Part& part;
  LookaheadOptions options;
  mutable std::mutex mutex;
  std::condition_variable work_available, consumer;
  std::function<void()> wake_coroutine;
  std::deque<std::unique_ptr<OpenLayer>> open;  ///< by layer
  std::size_t next_layer = 0;
  std::size_t most_open = 0;
  bool cancelled = false;
  PlanningEffort effort;
  std::size_t active = 0;  ///< threads that are slicing or planning
  Clock::time_point busy_since;
  std::vector<std::jthread> workers;  ///< last, so that they end before what they use
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

const PlannedLayer* Lookahead::peek() {
  std::unique_lock lock(state_->mutex);
  state_->consumer.wait(lock, [&] { return state_->front_ready() || state_->exhausted(); });
  if (!state_->front_ready()) return nullptr;
  if (state_->open.front()->error) state_->take();
  return &state_->open.front()->result;
}

asio::awaitable<std::optional<PlannedLayer>> Lookahead::next() {
  using Timer = asio::steady_timer;
  const auto executor = co_await asio::this_coro::executor;
  for (;;) {
    const auto timer = std::make_shared<Timer>(executor, Timer::time_point::max());
    {
      const std::lock_guard lock(state_->mutex);
      if (state_->front_ready() || state_->exhausted()) co_return state_->take();
      // Posted, so it runs on the loop's thread, after this coroutine has gone to sleep there.
      state_->wake_coroutine = [executor, timer] { asio::post(executor, [timer] { timer->cancel(); }); };
    }
    asio::error_code cancelled;
    co_await timer->async_wait(asio::redirect_error(asio::use_awaitable, cancelled));
  }
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

std::size_t Lookahead::ahead() const {
  return state_->options.ahead;
}

std::size_t Lookahead::most_open() const {
  const std::lock_guard lock(state_->mutex);
  return state_->most_open;
}

}  // namespace unicursal::host
