#include "host/idle/idle_printer.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <asio/co_spawn.hpp>
#include <asio/detached.hpp>
#include <cmath>
#include <utility>

#include "firmware_gcode/dialect/common_lines.hpp"
#include "firmware_gcode/dialect/dialect_named.hpp"
#include "firmware_gcode/dialect/number.hpp"
#include "firmware_gcode/dialect/share_writing.hpp"
#include "host/feeding/extrusion.hpp"
#include "host/idle/idle_state.hpp"

namespace unicursal::host {
namespace {

using Cause = IdleRefused::Why;

constexpr std::size_t most_waiting = 16;  ///< commands
constexpr auto farewell_patience = std::chrono::seconds(5);
constexpr auto motors_hold = std::chrono::seconds(1800);  ///< after the last motion
constexpr auto motors_doubt = std::chrono::seconds(60);
constexpr double brisk = 50, brisk_height = 10;  ///< mm/s of moves by hand
constexpr double rounding = 0.005;               ///< mm; M114 has two decimals
constexpr double coldest_push = 170;             ///< °C, Marlin's EXTRUDE_MINTEMP
constexpr double longest_push = 200;             ///< mm
constexpr std::array axis_names{'X', 'Y', 'Z'};

void check_heat(const char* sentence, std::optional<double> wanted, double most) {
  if (!wanted || (*wanted >= 0 && *wanted <= most)) return;
  throw IdleRefused(Cause::limit, nullptr, fmt::format(fmt::runtime(sentence), *wanted, most));
}

std::string feeding_in_words(const std::string& verb, const FeedingOrder& order, double length) {
  if (!order.feeder) return fmt::format("each feeder {} {:g} mm", verb, length);
  return fmt::format("feeder {} {} {:g} mm", *order.feeder + 1, verb, length);
}

const char* verb_of(FeedingKind kind) {
  switch (kind) {
    case FeedingKind::load:
      return "loads";
    case FeedingKind::purge:
      return "purges";
    case FeedingKind::unload:
      break;
  }
  return "pulls back";
}

}  // namespace

const char* name(IdleStatus::Connection connection) {
  switch (connection) {
    case IdleStatus::Connection::closed:
      return "closed";
    case IdleStatus::Connection::connecting:
      return "connecting";
    case IdleStatus::Connection::open:
      break;
  }
  return "open";
}

const char* name(IdleStatus::Action action) {
  switch (action) {
    case IdleStatus::Action::none:
      return "";
    case IdleStatus::Action::feeding:
      return "feeding";
    case IdleStatus::Action::heating:
      return "heating";
    case IdleStatus::Action::homing:
      break;
  }
  return "homing";
}

// ---- the state's part

void IdlePrinter::State::check_open() const {
  if (connection == IdleStatus::Connection::open && leave == Leave::no) return;
  if (connection == IdleStatus::Connection::connecting)
    throw IdleRefused(Cause::not_now, "connecting",
                      "the printer is being connected; try again in some seconds");
  throw IdleRefused(Cause::not_now, "not_connected", "the printer is not connected; connect it first");
}

void IdlePrinter::State::accept(Step step) {
  if (feeds())
    throw IdleRefused(Cause::not_now, "feeding",
                      "filament is being moved; wait until that is done, or cancel it");
  if (steps.size() >= most_waiting)
    throw IdleRefused(Cause::not_now, "too_many_waiting",
                      "too many commands wait; try again when the printer has done some");
  last_command = clock->now();
  problem.clear();
  if (hot()) step.lines.insert(step.lines.begin(), gcode::stay_watchful());
  steps.push_back(std::move(step));
  wake.notify();
  changed();
}

/// What waits is dropped; whoever has ordered filament to be moved learns that it has ended. A session that
/// moves some goes on, and says so itself.
void IdlePrinter::State::clear_steps(Ending of_feeding) {
  if (feeds() && !session && !fed) fed = of_feeding;
  steps.clear();
}

/// Motors that have let go lose their place.
void IdlePrinter::State::forget_slack_axes() {
  if (clock->now() < last_motion + motors_hold - motors_doubt) return;
  known_axes = {};
  place.reset();
}

void IdlePrinter::State::ask_to_leave(Leave how) {
  if (!running) return;
  leave = how;
  clear_steps(Ending::stopped);
  if (connection != IdleStatus::Connection::open && !leaves_hot()) {
    ++turn;
    link.reset();  // what greets it ends with an error
  }
  if (session) session->cancel("the connection is to be closed");
  wake.notify();
}

// ---- the public functions

IdlePrinter::IdlePrinter(asio::any_io_executor executor, asio::any_io_executor opener,
                         std::shared_ptr<Clock> clock)
    : state_(std::make_shared<State>(std::move(executor), std::move(opener), std::move(clock))) {}

IdlePrinter::~IdlePrinter() {
  state_->observer = nullptr;
  if (state_->link && state_->hot()) state_->link->cool_down();
  state_->ask_to_leave(State::Leave::close);
}

void IdlePrinter::connect(const Profile& profile, const std::string& port, int descriptor) {
  State& s = *state_;
  if (s.leave != State::Leave::no)
    throw IdleRefused(Cause::not_now, "closing", "the connection is being closed; try again in some seconds");
  if (s.running && !s.returning) return;
  if (s.returning) {  // it looks for the printer already
    s.wake.notify();
    return;
  }
  if (!s.may_be_hot || port != s.port) s.same_port.clear();  // a hot printer is looked for by its own adapter
  s.profile = profile;
  s.port = port;
  s.problem.clear();
  s.descriptor = descriptor;
  s.boots = descriptor < 0;
  s.cools_first = s.may_be_hot && descriptor < 0;  // an open port was not lost
  s.begin(state_);
}

void IdlePrinter::State::begin(const std::shared_ptr<State>& self) {
  running = true;
  if (cools_first) look_for_it();
  if (!returning) connection = IdleStatus::Connection::connecting;
  asio::co_spawn(executor, run(self), asio::detached);
  changed();
}

/// Begins to leave the connection; one that was lost while it was hot is opened for that. Returns false if
/// there is nothing to leave.
bool IdlePrinter::State::leave_connection(const std::shared_ptr<State>& self, Leave how) {
  if (!running && !may_be_hot) return false;
  if (how == Leave::close && connection != IdleStatus::Connection::open) cools_first = may_be_hot;
  if (!running) {
    cools_first = true;
    begin(self);
  }
  ask_to_leave(how);
  return true;
}

void IdlePrinter::disconnect() {
  state_->problem.clear();
  state_->leave_connection(state_, State::Leave::close);
}

void IdlePrinter::heat(std::optional<double> nozzle, std::optional<double> bed) {
  State& s = *state_;
  check_heat("a nozzle of {:g} °C is beyond the profile's limits: choose 0 to {:g} °C", nozzle,
             s.profile.hottest_nozzle);
  check_heat("a bed of {:g} °C is beyond the profile's limits: choose 0 to {:g} °C", bed,
             s.profile.hottest_bed);
  s.check_open();
  State::Step step;
  step.lines = gcode::choose_extruder(gcode::dialect_named(s.profile.printer.firmware));
  if (nozzle) step.lines.push_back(fmt::format("M104 S{:.0f}", *nozzle));
  if (bed) step.lines.push_back(fmt::format("M140 S{:.0f}", *bed));
  const auto stays_on = [](const std::optional<double>& asked, double ordered,
                           const std::optional<double>& reported) {
    return asked ? *asked > 0 : ordered > 0 || reported.value_or(0) > 0;
  };
  const gcode::Temperatures& known = s.view.temperatures;
  const bool on = stays_on(nozzle, s.nozzle, known.nozzle_target) || stays_on(bed, s.bed, known.bed_target);
  // A firmware halts when nobody speaks to it while it is to be watchful, cold or not.
  step.lines.push_back(on ? gcode::stay_watchful() : gcode::shut_down_after(0));
  s.accept(std::move(step));
  if (nozzle) s.nozzle = std::round(*nozzle);
  if (bed) s.bed = std::round(*bed);
}

void IdlePrinter::home(const std::array<bool, 3>& axes) {
  State& s = *state_;
  s.check_open();
  s.forget_slack_axes();
  if (axes[2] && !((axes[0] || s.known_axes[0]) && (axes[1] || s.known_axes[1])))
    throw IdleRefused(Cause::not_now, "not_homed",
                      "z is homed above a known place only; home x and y with it");
  State::Step step{State::Step::Kind::home, {}, axes, "the axes home", {}};
  std::string line = "G28";
  const bool all = axes == State::Axes{true, true, true};
  for (std::size_t axis = 0; axis < axes.size() && !all; ++axis) {
    if (axes[axis]) line += fmt::format(" {}", axis_names[axis]);
  }
  step.lines = {line, fmt::format("M84 S{}", motors_hold.count())};  // motors that rest let the head slip
  s.accept(std::move(step));
  s.place.reset();
}

void IdlePrinter::move(const std::array<double, 3>& by) {
  State& s = *state_;
  s.check_open();
  s.forget_slack_axes();
  if (!s.homed() || !s.place)
    throw IdleRefused(Cause::not_now, "not_homed", "nobody knows where the nozzle is; home all axes first");
  std::array<double, 3> to = *s.place;
  std::string line = "G1";
  for (std::size_t axis = 0; axis < to.size(); ++axis) {
    if (by[axis] == 0) continue;
    const double least = std::min(0.0, to[axis]), most = std::max(s.profile.printer.bed[axis], to[axis]);
    to[axis] += by[axis];
    if (!(to[axis] >= least - rounding && to[axis] <= most + rounding))
      throw IdleRefused(Cause::limit, nullptr,
                        fmt::format("{} would be {:.4g} mm, beyond 0 to {:g} mm of the bed", "xyz"[axis],
                                    to[axis], s.profile.printer.bed[axis]));
    to[axis] = std::clamp(to[axis], least, most);
    line += fmt::format(" {}{}", axis_names[axis], gcode::short_number(to[axis], 3));
  }
  if (line == "G1") return;
  const auto& speeds = s.profile.printer.max_speed;
  const double speed =
      by[2] != 0 ? std::min(brisk_height, speeds[2]) : std::min({brisk, speeds[0], speeds[1]});
  State::Step step{State::Step::Kind::move, gcode::modes(), {}, "", {}};
  step.lines.push_back(line + fmt::format(" F{:.0f}", speed * 60));
  s.accept(std::move(step));
  s.place = to;
}

void IdlePrinter::fan(double percent) {
  if (!(percent >= 0 && percent <= 100))
    throw IdleRefused(Cause::limit, nullptr, "a fan turns with 0 to 100 per cent");
  state_->check_open();
  constexpr double full = 255;
  State::Step step;
  step.lines = {percent > 0 ? fmt::format("M106 S{:.0f}", percent * full / 100) : "M107"};
  state_->accept(std::move(step));
}

void IdlePrinter::feed(const FeedingOrder& order) {
  State& s = *state_;
  Feeding made = host::feeding(order, s.profile);
  s.check_open();
  State::Step step{
      State::Step::Kind::feed, {}, {}, feeding_in_words(verb_of(order.kind), order, made.length), {}};
  step.feeding = std::move(made);
  s.accept(std::move(step));
  s.fed.reset();
}

void IdlePrinter::extrude(double length) {
  State& s = *state_;
  if (!(std::abs(length) <= longest_push))
    throw IdleRefused(Cause::limit, nullptr,
                      fmt::format("at most {:g} mm are pushed at a time", longest_push));
  s.check_open();
  if (s.view.temperatures.nozzle.value_or(0) < coldest_push)
    throw IdleRefused(Cause::not_now, "too_cold", "the nozzle is too cold to move filament; heat it first");
  State::Step step;
  step.lines = extrusion(length, s.profile.printer);
  step.doing = "filament is moved";
  s.accept(std::move(step));
}

void IdlePrinter::cancel() {
  State& s = *state_;
  s.check_open();
  s.clear_steps(Ending::stopped);
  s.last_command = s.clock->now();
  s.problem.clear();
  if (s.session) s.session->cancel();
  if (s.link && s.current && s.current->kind != State::Step::Kind::feed) s.link->cool_down();
  s.steps.push_back({State::Step::Kind::cool, s.cold_lines(), {}, "the heaters are switched off", {}});
  s.wake.notify();
  s.changed();
}

void IdlePrinter::stop_at_once() {
  State& s = *state_;
  // Also while the connection is being closed.
  if (s.connection != IdleStatus::Connection::open)
    throw IdleRefused(Cause::not_now, "not_connected", "the printer is not connected; connect it first");
  s.clear_steps(Ending::stopped);
  s.stopped = true;
  s.problem = "stopped at once; reset the printer before using it again";
  if (s.session) s.session->emergency_stop();
  if (s.link) s.link->emergency_stop();
  s.wake.notify();
}

void IdlePrinter::use(const Profile& profile) {
  if (!state_->feeds()) state_->profile = profile;
}

asio::awaitable<int> IdlePrinter::hand_over() {
  const auto state = state_;
  if (!state->leave_connection(state, State::Leave::hand_over)) co_return -1;
  const std::function<bool()> gone = [state] { return !state->running; };
  co_await state->wake.wait(TimePoint::max(), gone);
  co_return std::exchange(state->handed_over, -1);
}

asio::awaitable<void> IdlePrinter::close() {
  const auto state = state_;
  if (state->link && state->current && state->hot()) state->link->cool_down();
  if (!state->leave_connection(state, State::Leave::close)) co_return;
  const std::function<bool()> gone = [state] { return !state->running; };
  const auto limit = state->session ? TimePoint::max() : state->clock->now() + farewell_patience;
  co_await state->wake.wait(limit, gone);
}

IdleStatus IdlePrinter::status() const {
  const State& s = *state_;
  IdleStatus status;
  status.connection = s.connection;
  status.port = s.port;
  status.firmware = s.firmware;
  status.problem = s.problem;
  status.doing = s.doing();
  status.fed = s.fed;
  if (s.connection != IdleStatus::Connection::open) return status;
  status.temperatures = s.view.temperatures;
  status.homed = s.homed();
  status.at = s.place;
  status.action = s.action();
  if (s.hot() && !s.feeds()) {
    const Duration left = s.last_command + patience - s.clock->now();
    status.cools_in = std::max(0.0, std::chrono::duration<double>(left).count());
  }
  return status;
}

bool IdlePrinter::feeding() const {
  return state_->feeds();
}

bool IdlePrinter::may_be_hot() const {
  return state_->may_be_hot;
}

void IdlePrinter::leave_heat_to_print() {
  state_->may_be_hot = state_->cools_first = false;
}

void IdlePrinter::expect_hot(const Profile& profile, const std::string& port) {
  State& s = *state_;
  if (s.running) return;
  s.profile = profile;
  s.port = port;
  s.same_port.clear();
  s.may_be_hot = true;
}

bool IdlePrinter::wanted() const {
  return state_->running;
}

void IdlePrinter::on_line(std::function<void(const std::string&)> listener) {
  state_->listener = std::move(listener);
}

void IdlePrinter::on_change(std::function<void()> observer) {
  state_->observer = std::move(observer);
}

}  // namespace unicursal::host
