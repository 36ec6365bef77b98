// Changes values in the text of a shipped profile (host/job/frames.hpp), and keeps its comments. Such a text
// has each table and each key on a line of its own.
//
//   ProfileDraft draft(std::string(frame_named("diamond-0.6")->text));
//   draft.set("printer", "port", toml_text("/dev/ttyUSB0"));
#pragma once

#include <string>
#include <string_view>

namespace unicursal::host {

class ProfileDraft {
 public:
  explicit ProfileDraft(std::string text) : text_(std::move(text)) {}

  /// `value`: as TOML writes it. A key that is missing is added to its table, and a missing table to the end.
  void set(std::string_view table, std::string_view key, std::string_view value);
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// A basic string of TOML.
std::string toml_text(std::string_view text);

}  // namespace unicursal::host
