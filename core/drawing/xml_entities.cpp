#include "core/drawing/xml_entities.hpp"

#include <algorithm>
#include <map>
#include <string_view>

#include "core/error.hpp"

namespace unicursal::core {
namespace {

constexpr int deepest = 16;                        ///< entities within entities
constexpr std::size_t most_growth = 16 << 20;      ///< bytes that entities may add
constexpr std::size_t most_replacements = 100000;  ///< an empty entity adds none, but takes time

using Entities = std::map<std::string, std::string, std::less<>>;

bool is_xml_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// The offset behind the declaration that starts at `from`: behind its '>', which may not be in quotes.
std::size_t end_of_declaration(std::string_view text, std::size_t from) {
  char quote = '\0';
  for (std::size_t i = from; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      return i + 1;
    }
  }
  return text.size();
}

std::string_view next_word(std::string_view text, std::size_t& at) {
  while (at < text.size() && is_xml_space(text[at])) ++at;
  const std::size_t from = at;
  while (at < text.size() && !is_xml_space(text[at]) && text[at] != '>') ++at;
  return text.substr(from, at - from);
}

/// Reads `name "value">`; declarations that name a file are skipped.
void read_entity(std::string_view text, Entities& entities) {
  std::size_t at = 0;
  const std::string_view name = next_word(text, at);
  while (at < text.size() && is_xml_space(text[at])) ++at;
  if (name.empty() || name == "%" || at >= text.size() || (text[at] != '"' && text[at] != '\'')) return;
  const std::size_t end = text.find(text[at], at + 1);
  if (end == std::string_view::npos) return;
  std::string value(text.substr(at + 1, end - at - 1));
  // Newlines would shift the numbers of lines in messages.
  std::replace_if(
      value.begin(), value.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  entities.emplace(name, std::move(value));  // the first declaration counts
}

struct Doctype {
  Entities entities;
  std::size_t end = 0;  ///< offset of what follows it
};

Doctype read_doctype(std::string_view text) {
  Doctype result;
  const std::size_t start = text.find("<!DOCTYPE");
  if (start == std::string_view::npos) return result;
  const std::size_t open = text.find_first_of("[>", start);
  if (open == std::string_view::npos || text[open] == '>') return result;
  std::size_t at = open + 1;
  while (at < text.size() && text[at] != ']') {
    if (text.substr(at).starts_with("<!--")) {
      const std::size_t end = text.find("-->", at);
      at = end == std::string_view::npos ? text.size() : end + 3;
    } else if (text[at] == '<') {
      const std::size_t end = end_of_declaration(text, at);
      constexpr std::string_view entity = "<!ENTITY";
      if (text.substr(at).starts_with(entity))
        read_entity(text.substr(at + entity.size(), end - at - entity.size()), result.entities);
      at = end;
    } else {
      ++at;
    }
  }
  result.end = at;
  return result;
}

class Expansion {
 public:
  Expansion(const Entities& entities, const std::string& file) : entities_(entities), file_(file) {}

  void add(std::string_view text, std::string& result, int depth) {
    while (true) {
      const std::size_t start = text.find('&');
      result += text.substr(0, start);
      if (start == std::string_view::npos) return;
      text.remove_prefix(start);
      const std::size_t end = text.substr(0, 200).find(';');
      const auto found =
          end == std::string_view::npos ? entities_.end() : entities_.find(text.substr(1, end - 1));
      if (found == entities_.end()) {
        result += '&';
        text.remove_prefix(1);
        continue;
      }
      grown_ += found->second.size();
      if (depth >= deepest || grown_ > most_growth || ++replaced_ > most_replacements) {
        throw ModelError(file_, "", "its entities multiply without end",
                         "save the drawing again as plain SVG");
      }
      add(found->second, result, depth + 1);
      text.remove_prefix(end + 1);
    }
  }

 private:
  const Entities& entities_;
  const std::string& file_;
  std::size_t grown_ = 0, replaced_ = 0;
};

}  // namespace

std::string with_entities(const std::string& bytes, const std::string& file) {
  const Doctype doctype = read_doctype(bytes);
  if (doctype.entities.empty()) return bytes;
  std::string result = bytes.substr(0, doctype.end);
  Expansion(doctype.entities, file).add(std::string_view(bytes).substr(doctype.end), result, 0);
  return result;
}

}  // namespace unicursal::core
