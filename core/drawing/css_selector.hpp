// Selectors of style sheets: their grammar, and whether one fits an element. Source: Selectors Level 3. They
// may name types, classes, ids, attributes, the place among siblings, :root, :empty and :not(), joined by
// spaces,
// '>', '+' and '~'. What depends on a reader's deeds (:hover) never fits. Namespaces and ::before are not
// understood.
#pragma once

#include <cstddef>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace unicursal::core {

/// How a part of a selector is joined to the part on its left.
enum class Combinator { none, descendant, child, next, later };

struct AttributeTest {
  std::string name, value;
  char how = '\0';  ///< '\0': present; '=': equal; '~', '|', '^', '$', '*': as CSS writes them before '='
};

struct PlaceTest {
  enum class Kind { root, empty, nth, never } kind = Kind::never;
  bool from_end = false, of_type = false;
  int step = 0, offset = 0;  ///< nth: the places step·n + offset fit, n = 0, 1, …
};

/// The part of a selector that is about one element.
struct Compound {
  std::string type;  ///< empty: any
  std::vector<std::string> ids, classes;
  std::vector<AttributeTest> attributes;
  std::vector<PlaceTest> places;
  std::vector<Compound> unless;  ///< of :not()
  Combinator to_the_left = Combinator::none;
};

/// The last compound of the text comes first.
using Selector = std::vector<Compound>;

/// Parses one selector, without commas; nullopt if it is not understood.
std::optional<Selector> parse_selector(std::string_view text);

/// Ids count 2²⁰, classes, attributes and places 2¹⁰, types 1.
std::size_t specificity(const Selector& selector);

/// Adds the number of comparisons to `work`, and gives up with false above `most_work`.
bool fits(const Selector& selector, const pugi::xml_node& node, std::size_t& work, std::size_t most_work);

}  // namespace unicursal::core
