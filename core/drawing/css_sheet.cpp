#include "core/drawing/css_sheet.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "core/text/malformed.hpp"

namespace unicursal::core {
namespace {

constexpr std::size_t most_rules = 100000;
constexpr std::size_t most_work = 200'000'000;  ///< comparisons of elements with parts of selectors
constexpr std::size_t bytes_per_work = 16;      ///< of a list of classes
constexpr int deepest_block = 8;                ///< of @media in @media

/// Follows quotation marks through a text.
class Quotes {
 public:
  /// Whether the next character is a quotation mark or stands between two.
  bool contain(char c) {
    const bool inside = mark_ != '\0';
    if (inside ? c == mark_ : c == '"' || c == '\'') mark_ = inside ? '\0' : c;
    return inside || mark_ != '\0';
  }

 private:
  char mark_ = '\0';  ///< the one that is open
};

/// The offset of the first of `stops` outside of quotes, parentheses and brackets; the text's size if none.
std::size_t find_outside(std::string_view text, std::string_view stops) {
  Quotes quotes;
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quotes.contain(c)) continue;
    if (c == '(' || c == '[') {
      ++depth;
    } else if (c == ')' || c == ']') {
      depth = std::max(0, depth - 1);
    } else if (depth == 0 && stops.find(c) != std::string_view::npos) {
      return i;
    }
  }
  return text.size();
}

/// The offset behind the '}' that closes the '{' at the text's start.
std::size_t end_of_block(std::string_view text) {
  int depth = 0;
  Quotes quotes;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quotes.contain(c)) continue;
    if (c == '{') {
      ++depth;
    } else if (c == '}' && --depth == 0) {
      return i + 1;
    }
  }
  return text.size();
}

std::string_view take(std::string_view& text, std::size_t end, std::size_t skipped) {
  const std::string_view taken = trimmed(text.substr(0, end));
  text.remove_prefix(std::min(end + skipped, text.size()));
  return taken;
}

bool for_us(std::string_view media) {
  const std::string list = lower(media);
  return list.find("all") != std::string::npos || list.find("screen") != std::string::npos ||
         list.find("print") != std::string::npos;
}

}  // namespace

std::string without_comments(std::string_view text) {
  std::string result;
  while (true) {
    const auto start = text.find("/*");
    result += text.substr(0, start);
    if (start == std::string_view::npos) break;
    const auto end = text.find("*/", start + 2);
    if (end == std::string_view::npos) break;
    result += ' ';
    text.remove_prefix(end + 2);
  }
  for (const std::string_view mark : {"<!--", "-->"}) {
    for (auto at = result.find(mark); at != std::string::npos; at = result.find(mark))
      result.replace(at, mark.size(), mark.size(), ' ');
  }
  return result;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n\f");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n\f") - first + 1);
}

std::vector<Declaration> declarations(std::string_view text, const std::string& where, Warnings& notes) {
  std::vector<Declaration> result;
  while (!text.empty()) {
    const std::string_view entry = take(text, find_outside(text, ";"), 1);
    if (entry.empty()) continue;
    const auto colon = entry.find(':');
    Declaration found;
    found.name = trimmed(entry.substr(0, colon));
    if (colon == std::string_view::npos || found.name.empty()) {
      notes.add(where + ": the style entry " + in_quotes(entry) + " is malformed; it is skipped");
      continue;
    }
    found.value = trimmed(entry.substr(colon + 1));
    const auto mark = found.value.rfind('!');
    if (mark != std::string_view::npos && lower(trimmed(found.value.substr(mark + 1))) == "important") {
      found.important = true;
      found.value = trimmed(found.value.substr(0, mark));
    }
    result.push_back(found);
  }
  return result;
}

void StyleSheet::add(std::string_view text, const std::string& where, Warnings& notes) {
  texts_.push_back(without_comments(text));
  add_rules(texts_.back(), where, notes, 0);
}

void StyleSheet::add_rules(std::string_view text, const std::string& where, Warnings& notes, int depth) {
  while (!trimmed(text).empty()) {
    const std::size_t open = find_outside(text, "{;}");
    if (open < text.size() && text[open] != '{') {
      const std::string_view statement = take(text, open, 1);
      if (statement.starts_with("@import"))
        notes.add(where + ": the style sheet that it imports is not read; copy it into the drawing");
      continue;
    }
    const std::string_view head = take(text, open, 0);
    const std::size_t end = end_of_block(text);
    std::string_view block = take(text, end, 0);
    if (block.empty()) break;
    block.remove_prefix(1);
    if (block.ends_with('}')) block.remove_suffix(1);
    if (!head.starts_with('@')) {
      add_rule(head, block, where, notes);
    } else if (head.starts_with("@media") && for_us(head) && depth < deepest_block) {
      add_rules(block, where, notes, depth + 1);
    }
  }
}

void StyleSheet::add_rule(std::string_view selectors, std::string_view block, const std::string& where,
                          Warnings& notes) {
  blocks_.push_back(declarations(block, where, notes));
  while (!selectors.empty()) {
    const std::string_view text = take(selectors, find_outside(selectors, ","), 1);
    std::optional<Selector> selector = parse_selector(text);
    if (!selector) {
      notes.add(where + ": the selector " + in_quotes(text) + " is not understood; its rule is skipped");
      continue;
    }
    if (rules_.size() >= most_rules) throw Malformed("its style sheets have more than 100000 rules");
    const Compound& last = selector->front();
    const std::size_t index = rules_.size();
    if (!last.ids.empty()) {
      by_id_[last.ids.front()].push_back(index);
    } else if (!last.classes.empty()) {
      by_class_[last.classes.front()].push_back(index);
    } else if (!last.type.empty()) {
      by_type_[last.type].push_back(index);
    } else {
      for_all_.push_back(index);
    }
    rules_.push_back({std::move(*selector), 0, blocks_.size() - 1});
    rules_.back().weight = specificity(rules_.back().selector);
  }
}

std::vector<Declaration> StyleSheet::matching(const pugi::xml_node& node, std::string_view type) const {
  std::vector<std::size_t> found;
  const auto look = [&](const std::vector<std::size_t>& candidates) {
    for (const std::size_t index : candidates) {
      if (fits(rules_[index].selector, node, work_, most_work)) found.push_back(index);
    }
    if (work_ > most_work) throw Malformed("its style sheets take too long to apply");
  };
  const auto look_up = [&](const auto& map, std::string_view key) {
    if (const auto entry = map.find(std::string(key)); entry != map.end()) look(entry->second);
  };
  look(for_all_);
  look_up(by_type_, type);
  if (const auto id = node.attribute("id")) look_up(by_id_, id.value());
  if (const auto words = node.attribute("class"); words && !by_class_.empty()) {
    work_ += std::string_view(words.value()).size() / bytes_per_work;
    std::vector<std::string_view> seen;
    for (std::string_view list = trimmed(words.value()); !list.empty(); list = trimmed(list)) {
      const std::string_view word = list.substr(0, list.find_first_of(" \t\r\n\f"));
      list.remove_prefix(word.size());
      if (std::find(seen.begin(), seen.end(), word) != seen.end()) continue;
      look_up(by_class_, word);
      if (seen.size() < 100) seen.push_back(word);
    }
  }
  std::sort(found.begin(), found.end(), [&](std::size_t a, std::size_t b) {
    return std::tie(rules_[a].weight, a) < std::tie(rules_[b].weight, b);
  });
  std::vector<Declaration> result;
  for (const std::size_t index : found) {
    const auto& block = blocks_[rules_[index].block];
    result.insert(result.end(), block.begin(), block.end());
  }
  return result;
}

}  // namespace unicursal::core
