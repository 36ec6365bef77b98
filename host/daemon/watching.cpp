// What the daemon shows of a print that goes on: the line as it grows, the nozzle, and how far the print is.
// Together they are at most four events a second, so that they cost neither the printer nor a phone much.
#include <algorithm>
#include <utility>

#include "host/daemon/daemon.hpp"
#include "host/daemon/elsewhere.hpp"
#include "host/daemon/live_json.hpp"
#include "host/daemon/refused.hpp"
#include "host/engine/session_json.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

constexpr auto event_interval = 250ms;    ///< between two of these events
constexpr auto status_interval = 1000ms;  ///< between two of those with a status, which are long
constexpr auto layer_interval = 1000ms;   ///< between two about layers

LiveSubject subject_of(Print& print) {
  LiveSubject subject;
  subject.printer = print.job().profile.printer;
  subject.filaments = print.job().profile.filaments;
  subject.asked = print.production().asked();
  subject.layers = print.production().layers();
  const Spool& spool = print.spool();
  subject.folder = spool.folder();
  const auto& continuation = print.settings().continuation;
  if (!continuation) return subject;
  LiveSubject::Kept kept{spool.chunks(), spool.extent().chunks, spool.before().leg, 0};
  kept.executed = kept.leg.line(spool.before().acknowledged);
  if (continuation->leg) {
    kept.leg = *continuation->leg;
    kept.executed = kept.leg.begins_at;
  }
  subject.kept = std::move(kept);
  return subject;
}

}  // namespace

/// A print that goes on after its cable was pulled has its line already.
void Daemon::follow_line() {
  Print& print = *current_->print;
  const auto& continuation = print.settings().continuation;
  if (!current_->live || (continuation && continuation->leg)) {
    current_->live = std::make_shared<LiveLine>(subject_of(print));
    print.production().on_planned(
        [line = current_->live](const gcode::PlacedLayer& layer) { line->layer_planned(layer); });
    changed_layers_.clear();
    next_layer_number_ = 0;
    shown_position_ = {};
  }
  print.follow(current_->live.get());
}

LiveLine& Daemon::live() {
  if (!current_) throw Refused(Refused::Why::conflict, "nothing_printed", "nothing is being printed");
  if (!current_->live)
    throw Refused(Refused::Why::conflict, "preparing", "the print is still being prepared");
  return *current_->live;
}

/// Layers may have to be read from the disk.
asio::awaitable<std::optional<PathPiece>> Daemon::path_of(std::uint64_t layer, std::uint64_t from) {
  live();
  const auto read = [line = current_->live, layer, from] { return line->path(layer, from); };
  co_return co_await elsewhere(disk_, read);
}

std::optional<LiveNozzle> Daemon::nozzle() {
  const Session* session = current_ && current_->print ? current_->print->session() : nullptr;
  if (!session || !current_->live) return std::nullopt;
  return current_->live->nozzle(session->line_place(), std::chrono::steady_clock::now(),
                                session->status().speed_percent);
}

json Daemon::position() {
  live();
  const auto now = nozzle();
  return now ? to_json(*now) : json::object();
}

void Daemon::note_progress() {
  const Session* session = current_ && current_->print ? current_->print->session() : nullptr;
  if (session && current_->live) current_->live->executed(session->line_place().acknowledged);
  progress_due_ = true;
  show_soon();
}

void Daemon::show_soon() {
  if (progress_waits_ || followers_.empty()) return;
  progress_waits_ = true;
  progress_.expires_after(event_interval);
  progress_.async_wait([this](const asio::error_code& cut) {
    progress_waits_ = false;
    if (!cut) show();
  });
}

/// The one that grows and those that are planned by turns; then the others, of a print that continues.
/// Precondition: there is one.
std::map<std::size_t, KnownLayer>::iterator Daemon::next_changed_layer() {
  const auto from = [this](auto begin) {
    return std::find_if(begin, changed_layers_.end(), [](const auto& one) { return !one.second.complete; });
  };
  auto next = from(changed_layers_.lower_bound(next_layer_number_));
  if (next == changed_layers_.end()) next = from(changed_layers_.begin());
  if (next == changed_layers_.end()) next = changed_layers_.begin();
  next_layer_number_ = next->first + 1;
  return next;
}

/// One event, whichever is due longest.
void Daemon::show() {
  const Session* session = current_ && current_->print ? current_->print->session() : nullptr;
  if (!session || followers_.empty()) return;
  const auto now = std::chrono::steady_clock::now();
  bool still_moves = true;  // unless the same place was to be shown again
  if (current_->live) {
    for (const KnownLayer& layer : current_->live->take_changed()) changed_layers_[layer.layer] = layer;
  }
  if (progress_due_ && now - shown_progress_ >= status_interval) {
    shown_progress_ = now;
    progress_due_ = false;
    broadcast(to_json(SessionEvent{SessionEvent::Kind::progress, {}}, session->status()));
  } else if (!changed_layers_.empty() && now - shown_layer_ >= layer_interval) {
    shown_layer_ = now;
    const auto next = next_changed_layer();
    json event = to_json(next->second);
    event["event"] = "layer";
    broadcast_motion(event);
    changed_layers_.erase(next);
  } else if (const auto nozzle = this->nozzle()) {
    json event = to_json(*nozzle);
    event["event"] = "position";
    // The printer still moves through what it has taken when the print is paused.
    still_moves = event != shown_position_;
    if (still_moves) broadcast_motion(event);
    shown_position_ = std::move(event);
  } else {
    still_moves = false;
  }
  const bool printing = session->status().state == SessionState::printing;
  if (printing || still_moves || progress_due_ || !changed_layers_.empty()) show_soon();
}

}  // namespace unicursal::host
