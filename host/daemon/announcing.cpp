// What the user's command hears of a daemon's prints (event_command.hpp).
#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "core/picture/hex_colour.hpp"
#include "core/text/printable.hpp"
#include "host/daemon/daemon.hpp"

namespace unicursal::host {
namespace {

using nlohmann::json;

constexpr std::size_t longest_event_text = 400;  ///< bytes of a text in an event

std::string for_event(const std::string& text) {
  return core::printable(text, longest_event_text);
}

/// "leaf.toml has been printed"
std::string event_sentence(const std::string& event, const std::string& job, const std::string& state,
                           const std::string& reason) {
  const std::string why = reason.empty() ? "" : ": " + reason;
  if (event == "print_started") return fmt::format("{} is being printed", job);
  if (event == "print_ended" && state == "done") return fmt::format("{} has been printed", job);
  if (event == "print_ended")
    return fmt::format("the print of {} has {}{}", job, state == "failed" ? "failed" : "been stopped", why);
  if (event == "paused") return fmt::format("the print of {} is paused{}", job, why);
  if (event == "question") return fmt::format("the printer asks about {}{}", job, why);
  return fmt::format("{} needs attention{}", job.empty() ? "the printer" : job, why);
}

json filaments_of_profile(const Profile& profile) {
  json filaments = json::array();
  for (const Filament& filament : profile.filaments.of_feeders)
    filaments.push_back({{"name", filament.name},
                         {"material", filament.material},
                         {"colour", picture::hex_of(filament.colour)}});
  return filaments;
}

}  // namespace

/// Of the current print if there is one.
void Daemon::announce(const std::string& event, const std::string& state, const std::string& reason) {
  if (!event_command_) return;
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  json object = {{"event", event}, {"time", std::chrono::duration_cast<std::chrono::seconds>(now).count()}};
  const QueuedJob* job = current_ ? queue_.find(current_->id) : nullptr;
  if (job) {
    object["job"] = job->name;
    object["id"] = job->id;
  }
  const Profile* profile = profile_ ? &*profile_ : nullptr;
  if (current_ && current_->print) {
    profile = &current_->print->job().profile;
    object["filaments"] = filaments_of_profile(*profile);
  }
  if (profile) object["printer"] = profile->printer.name;
  if (!state.empty()) object["state"] = state;
  if (!reason.empty()) object["reason"] = reason;
  if (in_session()) {
    const SessionStatus status = current_->print->session()->status();
    object["percent"] = status.percent;
    if (status.left) object["left_seconds"] = *status.left;
    if (status.prompt) object["answers"] = status.prompt->answers;
  }
  const std::string text = event_sentence(event, job ? for_event(job->name) : "", state, for_event(reason));
  object["text"] = text;
  event_command_->run({event, text, object.dump(-1, ' ', false, json::error_handler_t::replace)});
}

/// After an event of the session that is neither progress nor heat.
void Daemon::announce_session(const SessionEvent& event) {
  if (!event_command_ || !in_session()) return;
  const SessionStatus status = current_->print->session()->status();
  const bool state_changed = event.kind == SessionEvent::Kind::state;
  if (state_changed && !current_->announced && status.state != SessionState::connecting &&
      !has_ended(status.state)) {
    current_->announced = true;
    announce("print_started", name(status.state), {});
  }
  const bool paused = status.state == SessionState::paused;
  if (paused && !std::exchange(current_->paused, true)) announce("paused", "paused", status.reason);
  // A printer that pauses by itself lets a pause begin once more.
  if (!paused && status.state != SessionState::pausing) current_->paused = false;
  const std::string asked = status.prompt ? status.prompt->text : "";
  if (!asked.empty() && asked != current_->asked) announce("question", name(status.state), asked);
  current_->asked = asked;
  constexpr std::string_view error_mark = "Error: ";
  if (event.kind == SessionEvent::Kind::notice && event.text.starts_with(error_mark))
    announce("problem", name(status.state), event.text.substr(error_mark.size()));
}

}  // namespace unicursal::host
