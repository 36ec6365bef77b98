#include "host/engine/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <asio/bind_executor.hpp>
#include <asio/co_spawn.hpp>
#include <asio/post.hpp>
#include <exception>

#include "host/engine/printer_check.hpp"
#include "host/engine/rejoining.hpp"
#include "host/engine/session_impl.hpp"
#include "host/link/serial_log.hpp"
#include "host/spool/chunk_reader.hpp"

namespace unicursal::host {
namespace {

constexpr double look_ahead = 300;  ///< s of printing that are planned before they are needed

/// Lines handed to the link at once: few, so that a command takes effect soon.
constexpr std::size_t batch = 16;

constexpr auto late_answer = std::chrono::seconds(1);  ///< of a printer that says ok first

constexpr auto fell_behind = "planning has fallen behind; it goes on by itself when the next layer is there";

bool moves_away(const std::string& line) {
  const bool move = line.starts_with("G0 ") || line.starts_with("G1 ");
  return move && (line.find(" X") != std::string::npos || line.find(" Y") != std::string::npos);
}

/// Lines of a lead-in up to the last one that waits for heat: what follows moves.
std::uint64_t heat_lines(const std::vector<std::string>& lead_in) {
  const auto waits = [](const std::string& line) {
    return line.starts_with("M109") || line.starts_with("M190");
  };
  const auto last = std::find_if(lead_in.rbegin(), lead_in.rend(), waits);
  return static_cast<std::uint64_t>(lead_in.rend() - last);
}

/// The layer, counted from 0, that is printed when so much of the chunk's time has passed.
std::optional<std::size_t> layer_at(const gcode::Chunk& chunk, double fraction) {
  if (chunk.layers.empty()) return std::nullopt;
  double left = fraction * chunk.seconds;
  for (const gcode::LayerShare& share : chunk.layers) {
    left -= share.seconds;
    if (left < 0) return share.layer;
  }
  return chunk.layers.back().layer;
}

/// Of which nothing is left for later chunks.
std::size_t whole_layers(const gcode::Chunk& chunk) {
  if (chunk.layers.empty()) return chunk.seconds > 0 ? 1 : 0;
  return static_cast<std::size_t>(std::count_if(chunk.layers.begin(), chunk.layers.end(),
                                                [](const gcode::LayerShare& share) { return share.last; }));
}

LinkOptions on_clock(const StreamSettings& settings) {
  LinkOptions options = settings.link;
  options.clock = settings.clock;
  return options;
}

double seconds(Duration duration) {
  return std::chrono::duration<double>(duration).count();
}

Duration duration(double seconds) {
  return std::chrono::duration_cast<Duration>(std::chrono::duration<double>(seconds));
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
      self(std::make_shared<State*>(this)),
      link(on, descriptor, on_clock(settings)) {
  link.on_message([this](const std::string& line) { hear(line); });
  source.on_ready([on, weak = std::weak_ptr(self)] {
    asio::post(on, [weak] {
      if (const auto alive = weak.lock()) (*alive)->wake.notify();
    });
  });
  if (settings.continuation) layers_before = spool->extent().layers;
  if (spool) keep_journal();
}

Session::State::~State() {
  source.on_ready({});
  disk.join();  // before what its work refers to goes away
}

// ---- the way through a print

asio::awaitable<void> Session::State::print() {
  print_begun = settings.continuation.has_value();
  co_await begin();
  print_begun = true;
  if (lost) co_return;
  std::exception_ptr error;
  try {
    if (settings.continuation) co_await send_spooled();
    if (!settings.continuation || spool->extent().start_lines == 0) co_await start();
    co_await send_pieces();
    if (aborted) throw LinkError("the print was stopped at once");
    if (!stopped) co_await between();  // a pause that was asked for in the last lines
  } catch (const LinkError&) {
    throw;
  } catch (...) {
    error = std::current_exception();
  }
  // Whatever went wrong, the printer is hot by now and has to be left cold.
  if (stopped || error) {
    stopped = !error;
    enter(SessionState::cancelling, error ? sentence(error) : stop_reason);
    co_await park();
  } else {
    enter(SessionState::finishing);
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
  co_await check_mixing();
  if (spool) spool->supersede_others();
}

void Session::State::check_firmware() {
  const gcode::Identity& printer = link.identity();
  if (const auto why = mismatch(printer, source.printer().firmware)) {
    unfit = true;
    const std::string remedy = settings.continuation
                                   ? "go on where the print was begun, or print the job anew"
                                   : correction(printer, settings.profile);
    throw LinkError(fmt::format("this printer cannot be used: {}; {}", *why, remedy));
  }
  if (const auto strange = strangeness(printer)) warn(*strange);
}

/// Some firmwares say ok when a line has come, and answer when it is run; what they answer to the second
/// question comes behind what they say to the first.
asio::awaitable<void> Session::State::check_mixing() {
  std::vector<std::string> questions{mixing_question, "M105"};
  temperatures = {};
  co_await interpose(std::move(questions));
  co_await link.drain();
  const std::function<bool()> answered = [this] { return !mixes || temperatures.nozzle || temperatures.bed; };
  co_await wake.wait(clock->now() + late_answer, answered);
  if (mixes) co_return;
  unfit = true;
  throw LinkError(fmt::format("this printer cannot be used: {}", does_not_mix));
}

asio::awaitable<void> Session::State::rejoin() {
  const JournalState& before = spool->before();
  Rejoined found;
  try {
    found = co_await link.rejoin(number_beyond(before));
  } catch (const PrinterReset& error) {
    lost = Lost{error.what(), std::nullopt};
    co_return;
  }
  check_firmware();
  lost = lost_since(before, found, spool->chunks(), spool->extent());
  if (lost) co_return;
  spool->journal().begin_session();
  first = place = *before.place_of(found.next);
  anew = false;
  spool->journal().anchor({found.next, first}, true);
  numbered = {found.next, 0};
  link.go_on(found.next);
}

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

/// Until then the source's run belongs to another thread.
asio::awaitable<void> Session::State::catch_up() {
  const std::function<bool()> done = [this] { return caught_up; };
  co_await wake.wait(TimePoint::max(), done);
}

/// What is spooled from here on in this leg.
asio::awaitable<void> Session::State::send_spooled() {
  begin_to_catch_up();
  const Leg& leg = settings.continuation->leg ? *settings.continuation->leg : spool->before().leg;
  const std::uint64_t hot = leg.lead_in.empty() ? spool->extent().start_lines : heat_lines(leg.lead_in);
  LegReader reader(spool->chunks(), leg, first);
  modal = state_at(spool->chunks(), leg, first);
  heating = first < hot;
  homeless = heating && !leg.lead_in.empty();
  replaying = true;
  enter(heating ? SessionState::heating : SessionState::printing);
  while (!stopped) {
    // What leads back to the part is gone through as a whole.
    if (!heating && place >= leg.lead_in.size()) co_await between();
    if (stopped) break;
    std::vector<std::string> lines =
        reader.next(heating ? std::min<std::uint64_t>(batch, hot - place) : batch);
    if (lines.empty()) break;
    layers_begun = reader.layers_begun();
    layer_fraction = reader.fraction();
    co_await hand(std::move(lines));
    if (heating && place >= hot) co_await get_hot();
    homeless = homeless && stopped;
  }
  heating = replaying = false;
  layer_fraction = 0;
  co_await catch_up();
  if (catching_up_failed) std::rethrow_exception(catching_up_failed);
}

asio::awaitable<void> Session::State::start() {
  if (stopped) co_return;
  gcode::Chunk chunk = source.start();
  if (!co_await keep({}, chunk)) co_return;
  heating = true;
  enter(SessionState::heating);
  if (source.printer().start_gcode.find("M85") != std::string::npos)
    warn(
        "the profile's start lines set M85; it is set again after them, since nothing else cools the printer "
        "when this computer fails");
  co_await send(chunk);
  co_await get_hot();
}

/// A command has to know whether that is so.
asio::awaitable<void> Session::State::get_hot() {
  if (!stopped) co_await link.drain();
  heating = false;
  if (!stopped && !pause_wanted) enter(SessionState::printing);
}

asio::awaitable<void> Session::State::send_pieces() {
  while (!stopped) {
    std::optional<PrintStep> piece = co_await next_piece();
    if (!piece || stopped || !co_await keep(std::move(piece->record), piece->chunk)) break;
    const gcode::Chunk& chunk = piece->chunk;
    chunk_seconds = chunk.seconds;
    whole = whole_layers(chunk);
    time_layers(chunk);
    layers_begun = layer_at(chunk, 0).value_or(layers_begun);
    co_await send(chunk);
    if (stopped) break;
    seconds_sent += std::exchange(chunk_seconds, no_time);
    layers_sent += std::exchange(whole, 0U);
    layer_fraction = 0;
  }
}

/// The first layer is no measure for the others: it has its own speed, and a skirt. What primes is no part of
/// a layer.
void Session::State::time_layers(const gcode::Chunk& chunk) {
  if (source.flow() > 0) unfinished_seconds -= chunk.prime_volume / source.flow();
  for (const gcode::LayerShare& share : chunk.layers) {
    unfinished_seconds += share.seconds;
    if (!share.last) continue;
    if (share.layer > 0) later_seconds += unfinished_seconds;
    unfinished_seconds = 0;
  }
}

/// Printer time goes on while this computer plans, unless it is virtual: then it stands still meanwhile, and
/// what is charged for planning passes afterwards.
asio::awaitable<std::optional<PrintStep>> Session::State::next_piece() {
  const TimePoint asked = clock->now();
  tell_position();
  co_await until_ready();
  std::optional<PrintStep> piece = source.next();
  if (piece) co_await until(TimePoint(duration(piece->ready_at)));
  waited += seconds(clock->now() - asked);
  co_return piece;
}

asio::awaitable<void> Session::State::until_ready() {
  Need planned;
  planned.why = fell_behind;
  planned.come = [this] { return source.ready(); };
  planned.at_work = true;
  co_await wait_for(planned);
}

asio::awaitable<void> Session::State::until(TimePoint ready) {
  Need planned;
  planned.why = fell_behind;
  planned.come = [this, ready] { return clock->now() >= ready; };
  planned.at = ready;
  co_await wait_for(planned);
}

/// What the printer still has in its queue is left out: it is little, and on the safe side.
void Session::State::tell_position() {
  const double left = chunk_seconds * (1 - layer_fraction) * 100 / speed_percent;
  source.printed(seconds(clock->now().time_since_epoch()), left);
}

asio::awaitable<void> Session::State::finish() {
  if (settings.continuation && spool->extent().finished) {
    parked = true;
    co_return co_await link.drain();
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
  if (const std::string problem = co_await try_to_keep(record, chunk); !problem.empty()) {
    // The part is done: it is not to lie below a hot nozzle until there is room.
    tell(SessionEvent::Kind::notice, "Error: the end of the print is sent without being kept: " + problem);
    co_return co_await send_last(std::move(chunk));
  }
  parked = std::any_of(chunk.lines.begin(), chunk.lines.end(), moves_away);
  co_await send(chunk);
  co_await link.drain();
  note_progress();
}

/// Before its end: these lines are none of the print's own.
asio::awaitable<void> Session::State::park() {
  co_await catch_up();
  gcode::Chunk chunk;
  try {
    if (homeless)
      chunk.lines = {"M104 S0", "M140 S0", "M107"};
    else
      chunk = source.finish();
  } catch (...) {
    link.cool_down();
    throw;
  }
  gcode::keep_commands(chunk.lines);
  co_await send_last(std::move(chunk));
}

asio::awaitable<void> Session::State::send_last(gcode::Chunk chunk) {
  note_progress();
  if (spool) spool->journal().park(chunk.lines);
  parking = true;
  parked = std::any_of(chunk.lines.begin(), chunk.lines.end(), moves_away);
  co_await send(chunk);
  co_await link.drain();
}

asio::awaitable<void> Session::State::send(const gcode::Chunk& chunk) {
  const bool own = heating || ending();  // commands wait until it is hot, or come too late
  for (std::size_t i = 0; i < chunk.lines.size(); i += batch) {
    if (!own) co_await between();
    if (stopped && !ending()) co_return;
    if (!own) {
      layer_fraction = static_cast<double>(i) / static_cast<double>(chunk.lines.size());
      layers_begun = layer_at(chunk, layer_fraction).value_or(layers_begun);
    }
    const std::size_t end = std::min(i + batch, chunk.lines.size());
    co_await hand({chunk.lines.begin() + static_cast<std::ptrdiff_t>(i),
                   chunk.lines.begin() + static_cast<std::ptrdiff_t>(end)});
  }
}

asio::awaitable<void> Session::State::hand(std::vector<std::string> lines) {
  for (const std::string& line : lines) modal.run(line);
  co_await link.send(std::move(lines));
  if (!parking) {
    place = first + link.statistics().lines - extra;  // without those that a stop has made it forget
    note_progress();
    if (!heating) tell_position();
  }
  tell(SessionEvent::Kind::progress);
}

StreamResult Session::State::result(const std::exception_ptr& error) {
  StreamResult result{
      Ending::completed, {}, parked, link.statistics(), link.firmware(), waited, lost, pauses, unfit,
      print_begun};
  if (stopped) result.ending = Ending::stopped;
  if (error) result.reason = sentence(error);
  if (aborted) result.reason = reason;
  if (!result.reason.empty()) result.ending = Ending::failed;
  switch (result.ending) {
    case Ending::completed:
      enter(SessionState::done);
      break;
    case Ending::stopped:
      enter(SessionState::stopped, stop_reason);
      break;
    case Ending::failed:
      enter(SessionState::failed, result.reason);
  }
  if (spool && !print_begun)
    spool->discard();
  else if (spool && !lost)
    end_journal(result);
  return result;
}

// ---- from outside

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
  options.temperatures = std::chrono::seconds(2);
  if (log) options.log = std::make_shared<SerialLog>(*log);
  return options;
}

Session::Session(asio::any_io_executor executor, int port, Source& source, StreamSettings settings)
    : state_(std::make_unique<State>(std::move(executor), port, source, std::move(settings))) {}

Session::~Session() = default;

asio::awaitable<StreamResult> Session::run() {
  std::exception_ptr error;
  try {
    co_await state_->print();
  } catch (...) {
    error = std::current_exception();
  }
  if (state_->aborted) co_await state_->confirm_stop();
  co_return state_->result(error);
}

StreamResult Session::failed(std::exception_ptr error) {
  state_->link.cool_down();
  return state_->result(error);
}

SessionStatus Session::status() const {
  return state_->status();
}

void Session::on_event(std::function<void(const SessionEvent&)> observer) {
  state_->observer = std::move(observer);
}

}  // namespace unicursal::host
