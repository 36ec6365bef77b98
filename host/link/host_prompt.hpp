// A question that a firmware asks a person through its host, with buttons to choose from (Marlin 2.1,
// HOST_PROMPT_SUPPORT, class HostUI):
//
//   //action:prompt_end
//   //action:prompt_begin Paused
//   //action:prompt_button PurgeMore        (answered by M876 S0)
//   //action:prompt_button Continue         (answered by M876 S1)
//   //action:prompt_show
//
// A prompt that can only be dismissed ("Resuming") is not a question. Texts are made safe to show.
// "prompt_choice" instead of "prompt_button" is OctoPrint's older word. No I/O.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace unicursal::host {

class HostPrompt {
 public:
  /// Takes what follows "//action:" into account. Returns whether a question has appeared or gone.
  bool take(std::string_view action);
  /// It was answered, so it is not answered again.
  void answered() { shown_ = false; }

  /// Whether a question has appeared since the last call.
  bool is_new() { return std::exchange(new_, false); }

  /// Whether an answer is awaited.
  bool shown() const { return shown_; }
  const std::string& text() const { return text_; }
  const std::vector<std::string>& buttons() const { return buttons_; }
  /// The button that lets the print go on; absent if none is known to.
  std::optional<std::size_t> going_on() const;
  /// Whether that button also switches the printer's filament sensor off (Marlin's "DisableRunout").
  bool going_on_is_unguarded() const;
  /// The question with its answers, a sentence.
  std::string sentence() const;

  /// M876 has one digit.
  static constexpr std::size_t most_buttons = 10;

 private:
  std::string text_;
  std::vector<std::string> buttons_;
  bool shown_ = false, new_ = false;
};

}  // namespace unicursal::host
