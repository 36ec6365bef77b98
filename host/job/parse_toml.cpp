#include "host/job/parse_toml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "host/job/job_error.hpp"

namespace unicursal::host {
namespace {

/// Follows the text as far as it is valid: that is as far as the parser gets.
class DepthScan {
 public:
  explicit DepthScan(std::string_view text) : text_(text) {}

  /// The line (from 1) where the text first gets too deep; 0: nowhere.
  std::size_t too_deep_line() {
    while (at_ < text_.size()) {
      step();
      if (dots_.size() - 1 + all_dots_ > deepest_settings) return line_;
    }
    return 0;
  }

 private:
  void step() {
    switch (const char c = text_[at_]) {
      case '"':
      case '\'':
        return skip_text(c);
      case '#':
        at_ = std::min(text_.find_first_of("\n\r\v\f", at_), text_.size());
        return;
      case '.':
        ++dots_.back();
        ++all_dots_;
        break;
      case '[':
      case '{':
        dots_.push_back(0);
        break;
      case ']':
      case '}':
        leave_level();
        break;
      case ',':
        forget_dots();
        break;
      case '\n':
        if (dots_.size() == 1) forget_dots();
        ++line_;
        break;
      default:
        break;
    }
    ++at_;
  }

  /// Texts of one line (an unclosed one ends with it) and texts in three quotes, behind whose end two more
  /// quotes may belong to the text (TOML 1.0, "String").
  void skip_text(char quote) {
    const std::string three(3, quote);
    const bool many_lines = text_.substr(at_, 3) == three;
    at_ += many_lines ? 3 : 1;
    while (at_ < text_.size()) {
      if (text_[at_] == '\n' && !many_lines) return;
      if (text_[at_] == quote && (!many_lines || text_.substr(at_, 3) == three)) break;
      if (text_[at_] == '\\' && quote == '"' && at_ + 1 < text_.size() && text_[at_ + 1] != '\n') ++at_;
      if (text_[at_] == '\n') ++line_;
      ++at_;
    }
    at_ += many_lines ? 3 : 1;
    for (int more = 0; many_lines && more < 2 && at_ < text_.size() && text_[at_] == quote; ++more) ++at_;
  }

  void leave_level() {
    if (dots_.size() == 1) return;  // not TOML; the parser reports it
    forget_dots();
    dots_.pop_back();
  }

  void forget_dots() {
    all_dots_ -= dots_.back();
    dots_.back() = 0;
  }

  std::string_view text_;
  std::size_t at_ = 0, line_ = 1;
  std::vector<std::size_t> dots_ = {0};  ///< since the last comma or line, for each open bracket or brace
  std::size_t all_dots_ = 0;             ///< their sum
};

}  // namespace

toml::table parse_toml(const std::string& text, const std::filesystem::path& file) {
  if (const std::size_t line = DepthScan(text).too_deep_line(); line != 0)
    throw JobError(file.string(), fmt::format("line {}", line),
                   fmt::format("has more than {} levels of dots, brackets and braces", deepest_settings),
                   "write keys and lists as unicursal-job(5) describes them");
  try {
    return toml::parse(text, file.string());
  } catch (const toml::parse_error& error) {
    throw JobError(file.string(), fmt::format("line {}", error.source().begin.line),
                   "is not valid TOML: " + std::string(error.description()), "mend that line");
  }
}

}  // namespace unicursal::host
