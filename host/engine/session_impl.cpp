#include "host/engine/session_impl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <asio/bind_executor.hpp>
#include <asio/co_spawn.hpp>
#include <asio/post.hpp>
#include <exception>

#include "host/engine/kept_layers.hpp"
#include "host/engine/line_follower.hpp"
#include "host/engine/printer_check.hpp"
#include "host/engine/rejoining.hpp"
#include "host/engine/seconds.hpp"
#include "host/link/serial_log.hpp"
#include "host/spool/chunk_reader.hpp"

namespace unicursal::host {
namespace {

constexpr double look_ahead = 300;  ///< s of printing that are planned before they are needed

/// Lines handed to the link together: few, so that a command takes effect soon.
constexpr std::size_t batch = 16;

constexpr auto late_answer = std::chrono::seconds(1);  ///< after the ok, of a printer that answers later

// A nozzle at the end of a print, °C.
constexpr double harmless = 60;
constexpr double cooler = 3;          ///< than at the end: its heater is off
constexpr double hotter = 15;         ///< than at the end: its heater is on
constexpr int cooling_patience = 60;  ///< s

constexpr auto fell_behind =
    "planning has fallen behind; the print continues by itself when the next layer is planned";

bool moves_away(const std::string& line) {
  const bool move = line.starts_with("G0 ") || line.starts_with("G1 ");
  return move && (line.find(" X") != std::string::npos || line.find(" Y") != std::string::npos);
}

/// The number of lines up to the last one that waits for heat; those after it move.
std::uint64_t heat_lines(const std::vector<std::string>& lead_in) {
  const auto waits = [](const std::string& line) {
    return line.starts_with("M109") || line.starts_with("M190");
  };
  const auto last = std::find_if(lead_in.rbegin(), lead_in.rend(), waits);
  return static_cast<std::uint64_t>(lead_in.rend() - last);
}

LinkOptions on_clock(const StreamSettings& settings) {
  LinkOptions options = settings.link;
  options.clock = settings.clock;
  return options;
}

}  // namespace

Session::State::State(asio::any_io_executor on, int descriptor, Source& of, StreamSettings with)
    : executor(on),
      port(descriptor),
      source(of),
      settings(std::move(with)),
      spool(settings.spool),
      clock(settings.clock),
      wake(on, clock),
      alive(std::make_shared<State*>(this)),
      link(on, descriptor, on_clock(settings)),
      progress(settings.continuation ? Progress::resumed(spool->extent().layers) : Progress()),
      places(link, spool),
      holding({link, wake, source, settings, places, printer, announcer, intent, progress}) {
  link.on_message([this](const std::string& line) { hear(line); });
  places.on_interposed([this](const std::vector<std::string>& lines) {
    if (settings.follower) settings.follower->interposed(lines, leg().line(places.next()));
  });
  source.on_ready([on, weak = std::weak_ptr(alive)] {
    asio::post(on, [weak] {
      if (const auto state = weak.lock()) (*state)->wake.notify();
    });
  });
}

Session::State::~State() {
  source.on_ready({});
  disk.join();  // before what its work refers to goes away
}

// ---- the way through a print

asio::awaitable<void> Session::State::print() {
  result.begun = settings.continuation.has_value();
  co_await begin();
  result.begun = true;
  if (result.lost) co_return;
  std::exception_ptr error;
  try {
    if (settings.continuation) co_await send_spooled();
    if (!settings.continuation || spool->extent().start_lines == 0) co_await start();
    co_await send_steps();
    co_await holding.between_batches();  // a pause that was asked for in the last lines
  } catch (const LinkError&) {
    throw;
  } catch (...) {
    error = std::current_exception();
  }
  if (intent.aborted()) throw LinkError("the print was stopped at once");
  // The printer is hot by now and must be left cold, even after an error.
  if (intent.stopped() || error) {
    announcer.enter(SessionState::cancelling, error ? sentence(error) : intent.reason());
    co_await park();
  } else {
    announcer.enter(SessionState::finishing);
    co_await finish();
  }
  if (error) throw PrintError(sentence(error) + "; the print was ended there");
}

asio::awaitable<void> Session::State::begin() {
  const auto& continuation = settings.continuation;
  if (continuation && !continuation->leg) co_return co_await rejoin();
  if (continuation) spool->journal().begin_leg(*continuation->leg);
  co_await link.connect();
  check_firmware();
  co_await check_abilities();
  if (spool) spool->supersede_others();
}

void Session::State::check_firmware() {
  const gcode::Identity& identity = link.identity();
  if (const auto why = mismatch(identity, source.printer().firmware)) {
    const std::string remedy = settings.continuation
                                   ? "resume on the printer on which the print began, or print the job again"
                                   : correction(identity, settings.profile);
    refuse(fmt::format("{}; {}", *why, remedy));
  }
  if (const auto why = has_other_feeders(identity, source.printer().feeders)) refuse(*why);
  if (const auto strange = strangeness(identity)) announcer.warn(*strange);
  if (settings.display) printer.display.begin(identity, source.printer().firmware);
}

/// Nothing has heated or moved.
void Session::State::refuse(const std::string& why) {
  result.unfit = true;
  throw LinkError("this printer cannot be used: " + why);
}

/// The lines that define the tools. A print that goes on has defined them already.
const std::vector<std::string>& Session::State::first_lines() {
  if (settings.continuation) return settings.continuation->leg->lead_in;
  if (!first) first = source.start();
  return first->lines;
}

/// Some firmwares say ok when a line has come, and answer when they run it. What they answer to the last
/// question comes behind what they say to the others.
asio::awaitable<void> Session::State::ask(std::vector<std::string> questions) {
  questions.emplace_back("M105");
  printer.temperatures = {};
  co_await places.interpose(std::move(questions));
  co_await link.drain();
  const std::function<bool()> answered = [this] {
    return !printer.mixes || printer.temperatures.nozzle || printer.temperatures.bed;
  };
  co_await wake.wait(clock->now() + late_answer, answered);
}

asio::awaitable<void> Session::State::check_abilities() {
  const gcode::Printer& wanted = source.printer();
  std::vector<std::string> questions(1, mixing_question(wanted.firmware));
  co_await ask(std::move(questions));
  // An old RepRapFirmware says only ok if it has no such tool.
  const bool silent = wanted.firmware == "reprapfirmware" && !printer.feeders;
  if (!printer.mixes || silent) refuse(does_not_mix(wanted.firmware));
  if (printer.feeders && *printer.feeders != wanted.feeders)
    refuse(mixes_other_feeders(*printer.feeders, wanted.feeders));
  const auto highest = highest_tool(first_lines());
  if (!highest || wanted.firmware != "marlin") co_return;
  // Only now: on a printer that does not mix, T may load filament or change a tool.
  questions.assign(1, fmt::format("T{}", *highest));
  questions.emplace_back("T0");
  co_await ask(std::move(questions));
  if (!printer.has_tools) refuse(lacks_tools(*highest));
}

asio::awaitable<void> Session::State::rejoin() {
  const JournalState& before = spool->before();
  Rejoined found;
  try {
    found = co_await link.rejoin(number_beyond(before));
  } catch (const PrinterReset& error) {
    result.lost = Lost{error.what(), std::nullopt};
    co_return;
  }
  check_firmware();
  result.lost = lost_since(before, found, spool->chunks(), spool->extent());
  if (result.lost) co_return;
  const std::uint32_t next = std::max<std::uint32_t>(found.next, 1);  // without counting, any number will do
  places.rejoin({next, *place_found(before, found, spool->chunks())});
  link.go_on(next);
}

/// Until this is over the source belongs to another thread.
void Session::State::begin_to_catch_up() {
  caught_up = false;
  const auto work = [this]() -> asio::awaitable<void> {
    settings.continuation->catch_up();
    co_return;
  };
  asio::co_spawn(disk, work, asio::bind_executor(executor, [this](std::exception_ptr error) {
                   caught_up = true;
                   catching_up_failed = error;
                   wake.notify();
                 }));
}

asio::awaitable<void> Session::State::catch_up() {
  const std::function<bool()> done = [this] { return caught_up; };
  co_await wake.wait(TimePoint::max(), done);
}

/// The leg that this session sends.
const Leg& Session::State::leg() const {
  static const Leg whole;
  const auto& continuation = settings.continuation;
  if (!continuation) return whole;
  return continuation->leg ? *continuation->leg : spool->before().leg;
}

/// Sends what is spooled from here on in this leg.
asio::awaitable<void> Session::State::send_spooled() {
  begin_to_catch_up();
  const Leg& leg = this->leg();
  const std::uint64_t hot = leg.lead_in.empty() ? spool->extent().start_lines : heat_lines(leg.lead_in);
  LegReader reader(spool->chunks(), leg, places.begin());
  const KeptLayers layers(spool->chunks());
  printer.expected = state_at(spool->chunks(), leg, places.begin());
  if (printer.expected.nozzle > 0) printer.job_nozzle = printer.expected.nozzle;
  if (printer.expected.bed > 0) printer.job_bed = printer.expected.bed;
  bool& heating = printer.may_wait_for_heat;
  heating = places.begin() < hot;
  printer.must_not_move = heating && !leg.lead_in.empty();
  const auto note_progress = [&] {
    const std::uint64_t line = leg.line(places.next());
    progress.replay(layers.before(line), layers.fraction(line));
  };
  note_progress();
  announcer.enter(heating ? SessionState::heating : SessionState::printing);
  while (!intent.ends()) {
    // The lines that lead back to the part are not interrupted.
    if (!heating && places.next() >= leg.lead_in.size()) co_await holding.between_batches();
    if (intent.ends()) break;
    std::vector<std::string> lines =
        reader.next(heating ? std::min<std::uint64_t>(batch, hot - places.next()) : batch);
    if (lines.empty()) break;
    note_progress();
    printer.mixture = reader.mixture();
    if (!heating && places.next() >= leg.lead_in.size()) co_await show_progress();
    co_await send_batch(std::move(lines));
    if (heating && places.next() >= hot) co_await get_hot();
    printer.must_not_move = printer.must_not_move && intent.ends();
  }
  heating = false;
  progress.end_replay();
  if (intent.aborted()) co_return;
  co_await catch_up();
  if (catching_up_failed && !intent.ends()) std::rethrow_exception(catching_up_failed);
}

asio::awaitable<void> Session::State::start() {
  if (intent.ends()) co_return;
  gcode::Chunk chunk = first ? std::move(*first) : source.start();
  if (!co_await spool_chunk({}, chunk)) co_return;
  printer.may_wait_for_heat = true;
  announcer.enter(SessionState::heating);
  if (source.printer().start_gcode.find("M85") != std::string::npos)
    announcer.warn(
        "the profile's start lines set M85; it is set again after them, since nothing else cools the printer "
        "when this computer fails");
  co_await send(chunk);
  co_await get_hot();
}

/// Returns when the printer is hot.
asio::awaitable<void> Session::State::get_hot() {
  if (!intent.ends()) co_await link.drain();
  printer.may_wait_for_heat = false;
  if (!intent.ends() && !intent.paused_by_session()) announcer.enter(SessionState::printing);
}

asio::awaitable<void> Session::State::send_steps() {
  while (!intent.ends()) {
    std::optional<PrintStep> step = co_await next_step();
    if (!step || intent.ends() || !co_await spool_chunk(std::move(step->record), step->chunk)) break;
    progress.begin_chunk(step->chunk, source.flow());
    co_await send(step->chunk);
    if (intent.ends()) break;
    progress.end_chunk();
  }
}

/// Printer time goes on while this computer plans, unless it is virtual: then it stands still meanwhile, and
/// the time that is charged for planning passes afterwards.
asio::awaitable<std::optional<PrintStep>> Session::State::next_step() {
  const TimePoint asked = clock->now();
  report_position();
  co_await wait_until_planned();
  std::optional<PrintStep> step = source.next();
  if (step) co_await wait_until(TimePoint(duration(step->ready_at)));
  result.waited += seconds(clock->now() - asked);
  co_return step;
}

asio::awaitable<void> Session::State::wait_until_planned() {
  Need planned;
  planned.why = fell_behind;
  planned.come = [this] { return source.ready(); };
  planned.at_work = true;
  co_await holding.wait_for(planned);
}

asio::awaitable<void> Session::State::wait_until(TimePoint ready) {
  Need planned;
  planned.why = fell_behind;
  planned.come = [this, ready] { return clock->now() >= ready; };
  planned.at = ready;
  co_await holding.wait_for(planned);
}

/// What the printer still has in its queue is left out: it is little, and the error is on the safe side.
void Session::State::report_position() {
  report_printed(source, *clock, progress.chunk_seconds_left() * 100 / printer.speed_percent);
}

asio::awaitable<void> Session::State::finish() {
  if (settings.continuation && spool->extent().finished) {
    result.parked = true;
    co_await link.drain();
    co_return co_await hand_back();
  }
  gcode::Chunk chunk;
  try {
    chunk = source.finish();
  } catch (...) {
    link.cool_down();
    throw;
  }
  SpooledChunk record;
  record.kind = SpooledChunk::Kind::finish;
  if (const std::string problem = co_await try_to_spool(record, chunk); !problem.empty()) {
    // The part is done: it must not lie below a hot nozzle until there is room.
    announcer.notice("Error: the end of the print is sent without being kept: " + problem);
    co_return co_await send_end(std::move(chunk));
  }
  if (settings.follower) settings.follower->chunk_kept(record, chunk);
  result.parked = std::any_of(chunk.lines.begin(), chunk.lines.end(), moves_away);
  co_await send(chunk);
  co_await link.drain();
  places.record_progress();
  co_await hand_back();
}

/// Nobody looks at a printer whose print is done, so a heater that is stuck on must show before. It takes
/// some seconds.
asio::awaitable<void> Session::State::see_it_cool() {
  const std::optional<double>& nozzle = printer.temperatures.nozzle;
  if (settings.link.temperatures.count() == 0 || !nozzle || *nozzle < harmless || printer.expected.nozzle > 0)
    co_return;
  const double hot = *nozzle;
  const auto clear = [&] { return *nozzle <= hot - cooler || *nozzle >= hot + hotter; };
  for (int second = 0; second < cooling_patience && !clear(); ++second) {
    std::vector<std::string> wait(1, "G4 S1");
    wait.emplace_back("M105");
    co_await places.interpose(std::move(wait));
    co_await link.drain();
  }
  if (!clear())
    announcer.warn(
        fmt::format("the nozzle is still at {:.0f} °C, although its heater is off: look after it", *nozzle));
  if (*nozzle < hot + hotter) co_return;
  throw LinkError(fmt::format(
      "the nozzle is at {:.0f} °C and becomes hotter, although its heater was switched off: switch the "
      "printer off by its own switch",
      *nozzle));
}

/// The printer is as it was: the next program that opens the port may not expect temperatures that it has not
/// asked for.
asio::awaitable<void> Session::State::hand_back() {
  co_await holding.guard_again();
  co_await link.drain();
  co_await show_end();
  co_await see_it_cool();
  if (settings.link.temperatures.count() > 0 && link.identity().can("AUTOREPORT_TEMP")) {
    std::vector<std::string> lines(1, "M155 S0");
    co_await places.interpose(std::move(lines));
  }
  co_await link.drain();
}

/// Ends the print before its last layer: these lines do not belong to the print.
asio::awaitable<void> Session::State::park() {
  co_await catch_up();
  gcode::Chunk chunk;
  try {
    if (printer.must_not_move)
      chunk.lines = {"M104 S0", "M140 S0", "M107"};
    else
      chunk = source.finish();
  } catch (...) {
    link.cool_down();
    throw;
  }
  gcode::keep_commands(chunk);
  co_await send_end(std::move(chunk));
}

asio::awaitable<void> Session::State::send_end(gcode::Chunk chunk) {
  places.leave_print(chunk.lines);
  result.parked = std::any_of(chunk.lines.begin(), chunk.lines.end(), moves_away);
  co_await send(chunk);
  co_await link.drain();
  co_await hand_back();
}

asio::awaitable<void> Session::State::send(const gcode::Chunk& chunk) {
  // While the printer heats commands have to wait, and at the end they come too late.
  const bool whole = printer.may_wait_for_heat || announcer.is_ending();
  auto mixture = chunk.mixtures.begin();
  for (std::size_t i = 0; i < chunk.lines.size(); i += batch) {
    if (!whole) co_await holding.between_batches();
    if (intent.ends() && !announcer.is_ending()) co_return;
    if (!whole) progress.sent(static_cast<double>(i) / static_cast<double>(chunk.lines.size()));
    const std::size_t end = std::min(i + batch, chunk.lines.size());
    if (!whole) co_await show_progress();
    for (; mixture != chunk.mixtures.end() && mixture->line < end; ++mixture) printer.mixture = mixture->name;
    co_await send_batch({chunk.lines.begin() + static_cast<std::ptrdiff_t>(i),
                         chunk.lines.begin() + static_cast<std::ptrdiff_t>(end)});
  }
}

asio::awaitable<void> Session::State::send_batch(std::vector<std::string> lines) {
  for (const std::string& line : lines) printer.run(line);
  co_await places.send(std::move(lines));
  if (!places.has_left_print() && !printer.may_wait_for_heat) report_position();
  announcer.event(SessionEvent::Kind::progress);
}

StreamResult Session::State::conclude(const std::exception_ptr& error) {
  announcer.end_quotes();
  result.statistics = link.statistics();
  result.firmware = link.firmware();
  result.pauses = holding.pauses();
  if (intent.stopped()) result.ending = Ending::stopped;
  if (intent.ends()) result.stop = intent.aborted() ? StopAsked::at_once : StopAsked::park;
  if (error) result.reason = sentence(error);
  if (intent.aborted()) result.reason = announcer.reason();
  const bool at_once = intent.aborted() || link.cut_wait_short();
  if (!gave_up_heating.empty())
    result.reason = gave_up_heating + (at_once ? "; it was " + announcer.reason() : "");
  if (!result.reason.empty()) result.ending = Ending::failed;
  switch (result.ending) {
    case Ending::completed:
      announcer.enter(SessionState::done);
      break;
    case Ending::stopped:
      announcer.enter(SessionState::stopped, intent.reason());
      break;
    case Ending::failed:
      announcer.enter(SessionState::failed, result.reason);
  }
  if (spool && !result.begun) {
    spool->discard();
  } else if (!result.lost) {
    constexpr std::array outcomes{LegOutcome::completed, LegOutcome::stopped, LegOutcome::failed};
    places.record_end({outcomes.at(static_cast<std::size_t>(result.ending)), result.reason});
  }
  return result;
}

// ---- options of a session

PlanningClock planning_clock(std::shared_ptr<Clock> clock) {
  return {[clock = std::move(clock)] { return seconds(clock->now().time_since_epoch()); }, 1};
}

LookaheadOptions paced(LookaheadOptions options, const std::shared_ptr<Clock>& clock) {
  options.horizon = look_ahead;
  options.pace = planning_clock(clock);
  return options;
}

LinkOptions link_options(const Profile& profile, const std::optional<std::filesystem::path>& log) {
  LinkOptions options;
  options.receive_buffer = profile.receive_buffer - 1;  // in a ring, one place always stays free
  options.temperatures = std::chrono::seconds(1);
  if (log) options.log = std::make_shared<SerialLog>(*log);
  return options;
}

}  // namespace unicursal::host
