#include "host/link/host_prompt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/text/printable.hpp"
#include "core/text/wording.hpp"

namespace unicursal::host {
namespace {

/// Lets Marlin go on without its filament sensor.
constexpr std::string_view unguarded = "disablerunout";

/// Returns what follows `word`; absent if the action is another one.
std::optional<std::string> behind(std::string_view action, std::string_view word) {
  if (!action.starts_with(word)) return std::nullopt;
  action.remove_prefix(word.size());
  if (!action.empty() && action.front() != ' ') return std::nullopt;
  action.remove_prefix(std::min(action.find_first_not_of(' '), action.size()));
  return std::string(action);
}

}  // namespace

bool HostPrompt::take(std::string_view action) {
  if (auto text = behind(action, "prompt_begin")) {
    *this = HostPrompt();
    text_ = core::printable(*text);
    return false;
  }
  for (const std::string_view word : {"prompt_button", "prompt_choice"}) {
    if (auto button = behind(action, word); button && buttons_.size() < most_buttons)
      buttons_.push_back(core::printable(*button));
  }
  if (behind(action, "prompt_show")) {
    const bool only_shows = buttons_.size() == 1 && core::lower(buttons_.front()) == "dismiss";
    return new_ = shown_ = !buttons_.empty() && !only_shows;
  }
  if (!behind(action, "prompt_end")) return false;
  const bool gone = shown_;
  *this = HostPrompt();
  return gone;
}

std::optional<std::size_t> HostPrompt::going_on() const {
  for (const std::string_view word : {std::string_view("continue"), std::string_view("resume"), unguarded}) {
    const auto fits = [&](const std::string& button) {
      return core::lower(button).find(word) != std::string::npos;
    };
    const auto found = std::find_if(buttons_.begin(), buttons_.end(), fits);
    if (found != buttons_.end()) return static_cast<std::size_t>(found - buttons_.begin());
  }
  return buttons_.size() == 1 ? std::optional<std::size_t>(0) : std::nullopt;
}

bool HostPrompt::going_on_is_unguarded() const {
  const auto button = going_on();
  return button && core::lower(buttons_[*button]).find(unguarded) != std::string::npos;
}

std::string HostPrompt::sentence() const {
  std::string answers;
  for (std::size_t i = 0; i < buttons_.size(); ++i)
    answers += fmt::format("{}{} ({})",
                           i == 0                     ? ""
                           : i + 1 == buttons_.size() ? " or "
                                                      : ", ",
                           i, buttons_[i]);
  return fmt::format("the printer asks \"{}\": answer {}", text_, answers);
}

}  // namespace unicursal::host
