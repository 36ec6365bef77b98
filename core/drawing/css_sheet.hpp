// The rules of a drawing's style sheets, and which of them apply to an element. Source: CSS 2.1, chapters 4
// and 6; selectors as in css_selector.hpp. The rules in @media count if the medium is all, screen or print;
// other
// @-rules are skipped. A selector that is not understood loses its declarations, with a note.
#pragma once

#include <cstddef>
#include <list>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/drawing/css_selector.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {

/// "name: value" of a rule or of a style attribute.
struct Declaration {
  std::string_view name, value;  ///< without spaces around them
  bool important = false;
};

/// Reads the declarations "name: value; …". Malformed ones are skipped with a note that begins with `where`.
std::vector<Declaration> declarations(std::string_view text, const std::string& where, Warnings& notes);

/// Text with its comments replaced by spaces.
std::string without_comments(std::string_view text);

/// Text without the spaces around it.
std::string_view trimmed(std::string_view text);

class StyleSheet {
 public:
  /// Adds the rules of one sheet; later ones win over earlier ones. `where` begins the notes.
  void add(std::string_view text, const std::string& where, Warnings& notes);

  bool empty() const { return rules_.empty(); }
  /// The declarations for an element of the type `type`, in the order in which they are to be applied.
  /// Throws Malformed if all elements together have cost too many comparisons.
  std::vector<Declaration> matching(const pugi::xml_node& node, std::string_view type) const;

 private:
  struct Rule {
    Selector selector;
    std::size_t weight = 0, block = 0;  ///< its specificity; its declarations in blocks_
  };

  void add_rules(std::string_view text, const std::string& where, Warnings& notes, int depth);
  void add_rule(std::string_view selectors, std::string_view block, const std::string& where,
                Warnings& notes);

  std::list<std::string> texts_;  ///< the declarations refer to these
  std::vector<std::vector<Declaration>> blocks_;
  std::vector<Rule> rules_;
  /// Rules by what their last compound asks for first.
  std::unordered_map<std::string, std::vector<std::size_t>> by_id_, by_class_, by_type_;
  std::vector<std::size_t> for_all_;
  mutable std::size_t work_ = 0;
};

}  // namespace unicursal::core
