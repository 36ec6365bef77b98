#include "core/text/wording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace unicursal::core {
namespace {

constexpr std::size_t longest_quote = 40;  ///< bytes of foreign text that one message repeats
constexpr std::size_t most_warnings = 20;

}  // namespace

std::string in_quotes(std::string_view text) {
  std::string result = "\"";
  for (const char c : text.substr(0, longest_quote)) {
    const auto code = static_cast<unsigned char>(c);
    result += code < 0x20 || code == 0x7f ? '?' : c;
  }
  // A cut may fall inside a character of several bytes: drop what is left of it.
  if (text.size() > longest_quote) {
    while ((static_cast<unsigned char>(text[longest_quote]) & 0xc0) == 0x80 && result.size() > 1 &&
           (static_cast<unsigned char>(result.back()) & 0xc0) == 0x80) {
      result.pop_back();
    }
    if (static_cast<unsigned char>(result.back()) >= 0xc0) result.pop_back();
    result += "...";
  }
  return result + '"';
}

std::string listed(const std::vector<std::string>& items, std::size_t limit) {
  if (items.empty()) return "nothing";
  const std::size_t shown = std::min(items.size(), limit);
  std::string result =
      fmt::format("{}", fmt::join(items.begin(), items.begin() + std::ptrdiff_t(shown), ", "));
  if (shown < items.size()) result += fmt::format(" and {} more", items.size() - shown);
  return result;
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

void Warnings::add(std::string sentence) {
  if (std::find(sentences_.begin(), sentences_.end(), sentence) != sentences_.end()) return;
  if (sentences_.size() < most_warnings) {
    sentences_.push_back(std::move(sentence));
  } else {
    ++left_out_;
  }
}

std::vector<std::string> Warnings::sentences() const {
  std::vector<std::string> result = sentences_;
  if (left_out_ > 0) result.push_back(fmt::format("{} more warnings are not shown", left_out_));
  return result;
}

}  // namespace unicursal::core
