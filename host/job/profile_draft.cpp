#include "host/job/profile_draft.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace unicursal::host {
namespace {

/// Where the line after this one begins.
std::size_t next_line(const std::string& text, std::size_t at) {
  const std::size_t end = text.find('\n', at);
  return end == std::string::npos ? text.size() : end + 1;
}

bool begins(const std::string& text, std::size_t at, std::string_view with) {
  return text.compare(at, with.size(), with) == 0;
}

}  // namespace

void ProfileDraft::set(std::string_view table, std::string_view key, std::string_view value) {
  const std::string head = fmt::format("[{}]", table), name = fmt::format("{} = ", key);
  std::size_t at = 0;
  while (at < text_.size() && !begins(text_, at, head)) at = next_line(text_, at);
  if (at == text_.size()) {
    text_ += fmt::format("\n{}\n{}{}\n", head, name, value);
    return;
  }
  std::size_t last = next_line(text_, at);  // behind the table's last line that is not empty
  for (at = last; at < text_.size() && text_[at] != '['; at = next_line(text_, at)) {
    if (text_[at] == '\n') continue;
    last = next_line(text_, at);
    if (!begins(text_, at, name)) continue;
    const std::size_t end = std::min(text_.find('\n', at), text_.size());
    const std::size_t comment = text_.find("  #", at);
    const std::string kept = comment < end ? text_.substr(comment, end - comment) : "";
    text_.replace(at, end - at, fmt::format("{}{}{}", name, value, kept));
    return;
  }
  text_.insert(last, fmt::format("{}{}\n", name, value));
}

std::string toml_text(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (code < 0x20 || code == 0x7f) {
      result += fmt::format("\\u{:04X}", code);
    } else {
      result += c;
    }
  }
  return result + '"';
}

}  // namespace unicursal::host
