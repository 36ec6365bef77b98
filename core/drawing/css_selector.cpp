#include "core/drawing/css_selector.hpp"

#include <algorithm>
#include <charconv>

#include "core/text/wording.hpp"
#include "core/text/xml_document.hpp"

namespace unicursal::core {
namespace {

constexpr std::size_t id_weight = 1U << 20U, class_weight = 1U << 10U;
constexpr std::size_t longest = 64;  ///< compounds of a selector

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f';
}
bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
         (static_cast<unsigned char>(c) & 0x80U) != 0;
}

/// Parses the argument of :nth-child(): "odd", "even", "3", "2n+1", "-n+3".
std::optional<PlaceTest> nth(std::string text) {
  std::erase_if(text, is_space);
  text = lower(text);
  PlaceTest test;
  test.kind = PlaceTest::Kind::nth;
  if (text == "odd") text = "2n+1";
  if (text == "even") text = "2n";
  const auto number = [](std::string_view digits, int& value) {
    if (digits.starts_with('+')) digits.remove_prefix(1);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return error == std::errc{} && end == digits.data() + digits.size();
  };
  const auto n = text.find('n');
  if (n == std::string::npos) return number(text, test.offset) ? std::optional(test) : std::nullopt;
  const std::string step = text.substr(0, n), rest = text.substr(n + 1);
  if (step.empty() || step == "+") {
    test.step = 1;
  } else if (step == "-") {
    test.step = -1;
  } else if (!number(step, test.step)) {
    return std::nullopt;
  }
  if (!rest.empty() && !number(rest, test.offset)) return std::nullopt;
  return test;
}

class SelectorParser {
 public:
  explicit SelectorParser(std::string_view text) : text_(text) {}

  std::optional<Selector> parse() {
    Selector selector;
    Combinator joined = Combinator::none;
    skip_spaces();
    while (at_ < text_.size()) {
      std::optional<Compound> part = compound();
      if (!part || selector.size() >= longest) return std::nullopt;
      part->to_the_left = joined;
      selector.insert(selector.begin(), std::move(*part));
      joined = combinator();
      if (joined != Combinator::descendant && at_ >= text_.size() && joined != Combinator::none)
        return std::nullopt;
    }
    return selector.empty() ? std::nullopt : std::optional(selector);
  }

 private:
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  void skip_spaces() {
    while (is_space(peek())) ++at_;
  }

  std::string name() {
    std::string result;
    while (at_ < text_.size()) {
      if (text_[at_] == '\\' && at_ + 1 < text_.size()) {
        result += text_[at_ + 1];
        at_ += 2;
      } else if (is_name_character(text_[at_])) {
        result += text_[at_++];
      } else {
        break;
      }
    }
    return result;
  }

  Combinator combinator() {
    skip_spaces();
    Combinator result = Combinator::descendant;
    if (peek() == '>') result = Combinator::child;
    if (peek() == '+') result = Combinator::next;
    if (peek() == '~') result = Combinator::later;
    if (result != Combinator::descendant) ++at_;
    skip_spaces();
    return result;
  }

  std::optional<Compound> compound() {
    Compound result;
    const std::size_t start = at_;
    if (peek() == '*') {
      ++at_;
    } else {
      result.type = name();
    }
    while (at_ < text_.size()) {
      const char kind = peek();
      if (kind == '#' || kind == '.') {
        ++at_;
        const std::string found = name();
        if (found.empty()) return std::nullopt;
        (kind == '#' ? result.ids : result.classes).push_back(found);
      } else if (kind == '[') {
        if (!attribute_test(result)) return std::nullopt;
      } else if (kind == ':') {
        if (!pseudo_class(result)) return std::nullopt;
      } else {
        break;
      }
    }
    return at_ > start ? std::optional(std::move(result)) : std::nullopt;
  }

  bool attribute_test(Compound& result) {
    ++at_;
    skip_spaces();
    AttributeTest test;
    test.name = name();
    skip_spaces();
    if (test.name.empty()) return false;
    if (peek() != ']') {
      test.how = peek();
      ++at_;
      if (test.how != '=') {
        if (std::string_view("~|^$*").find(test.how) == std::string_view::npos || peek() != '=') return false;
        ++at_;
      }
      skip_spaces();
      if (peek() == '"' || peek() == '\'') {
        const auto end = text_.find(peek(), at_ + 1);
        if (end == std::string_view::npos) return false;
        test.value = text_.substr(at_ + 1, end - at_ - 1);
        at_ = end + 1;
      } else {
        test.value = name();
      }
      skip_spaces();
    }
    if (peek() != ']') return false;
    ++at_;
    result.attributes.push_back(std::move(test));
    return true;
  }

  bool pseudo_class(Compound& result) {
    ++at_;
    const std::string what = lower(name());
    std::string argument;
    if (peek() == '(') {
      const auto end = text_.find(')', at_);
      if (end == std::string_view::npos) return false;
      argument = text_.substr(at_ + 1, end - at_ - 1);
      at_ = end + 1;
    }
    if (what == "not") {
      const auto inner = SelectorParser(argument).parse();
      if (!inner || inner->size() != 1 || !inner->front().unless.empty()) return false;
      result.unless.push_back(inner->front());
      return true;
    }
    PlaceTest test;
    if (what == "root") {
      test.kind = PlaceTest::Kind::root;
    } else if (what == "empty") {
      test.kind = PlaceTest::Kind::empty;
    } else if (what.starts_with("nth-") || what.starts_with("first-") || what.starts_with("last-") ||
               what.starts_with("only-")) {
      return sibling_test(what, argument, result);
    } else if (what != "hover" && what != "active" && what != "focus" && what != "visited" &&
               what != "target") {
      return false;
    }
    result.places.push_back(test);
    return true;
  }

  static bool sibling_test(const std::string& what, const std::string& argument, Compound& result) {
    PlaceTest test;
    test.kind = PlaceTest::Kind::nth;
    test.offset = 1;
    if (what.starts_with("nth-")) {
      const auto given = nth(argument);
      if (!given) return false;
      test = *given;
    }
    test.of_type = what.ends_with("of-type");
    if (!test.of_type && !what.ends_with("child")) return false;
    test.from_end = what.starts_with("last-") || what.starts_with("nth-last-");
    result.places.push_back(test);
    if (what.starts_with("only-")) {
      test.from_end = true;
      result.places.push_back(test);
    }
    return true;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

pugi::xml_node element_before(pugi::xml_node node) {
  do {
    node = node.previous_sibling();
  } while (node && node.type() != pugi::node_element);
  return node;
}

pugi::xml_node element_after(pugi::xml_node node) {
  do {
    node = node.next_sibling();
  } while (node && node.type() != pugi::node_element);
  return node;
}

pugi::xml_node parent_element(const pugi::xml_node& node) {
  const pugi::xml_node parent = node.parent();
  return parent.type() == pugi::node_element ? parent : pugi::xml_node{};
}

bool has_word(std::string_view list, std::string_view word) {
  for (std::size_t at = list.find(word); at != std::string_view::npos && !word.empty();
       at = list.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || is_space(list[at - 1])) && (end == list.size() || is_space(list[end]))) return true;
  }
  return false;
}

bool passes(const AttributeTest& test, const pugi::xml_node& node) {
  const auto found = node.attribute(test.name.c_str());
  if (!found) return false;
  const std::string_view value = found.value(), want = test.value;
  switch (test.how) {
    case '\0':
      return true;
    case '=':
      return value == want;
    case '~':
      return has_word(value, want);
    case '|':
      return value == want || (value.starts_with(want) && value.substr(want.size()).starts_with('-'));
    case '^':
      return !want.empty() && value.starts_with(want);
    case '$':
      return !want.empty() && value.ends_with(want);
    default:
      return !want.empty() && value.find(want) != std::string_view::npos;
  }
}

/// Long attributes take long to compare.
constexpr std::size_t bytes_per_work = 16;

std::size_t attribute_bytes(const pugi::xml_node& node) {
  std::size_t sum = 0;
  for (const auto& attribute : node.attributes()) sum += std::string_view(attribute.value()).size();
  return sum;
}

class Fitting {
 public:
  Fitting(const Selector& selector, std::size_t& work, std::size_t most)
      : selector_(selector), work_(work), most_(most) {}

  /// Whether the parts of the selector from `part` on fit, the first of them `node`.
  bool from(std::size_t part, const pugi::xml_node& node) {
    if (!passes_all(selector_[part], node)) return false;
    if (part + 1 == selector_.size()) return true;
    switch (selector_[part].to_the_left) {
      case Combinator::child: {
        const auto parent = parent_element(node);
        return parent && from(part + 1, parent);
      }
      case Combinator::next: {
        const auto before = element_before(node);
        return before && from(part + 1, before);
      }
      case Combinator::later:
        for (auto before = element_before(node); before && work_ <= most_; before = element_before(before)) {
          if (from(part + 1, before)) return true;
        }
        return false;
      default:
        for (auto above = parent_element(node); above && work_ <= most_; above = parent_element(above)) {
          if (from(part + 1, above)) return true;
        }
        return false;
    }
  }

 private:
  bool passes_all(const Compound& compound, const pugi::xml_node& node) {
    if (!compound.classes.empty() || !compound.attributes.empty())
      work_ += attribute_bytes(node) / bytes_per_work;
    if (++work_ > most_) return false;
    const auto has_id = [&](const std::string& id) { return id == node.attribute("id").value(); };
    const auto has_class = [&](const std::string& c) { return has_word(node.attribute("class").value(), c); };
    return (compound.type.empty() || compound.type == local_name(node)) &&
           std::all_of(compound.ids.begin(), compound.ids.end(), has_id) &&
           std::all_of(compound.classes.begin(), compound.classes.end(), has_class) &&
           std::all_of(compound.attributes.begin(), compound.attributes.end(),
                       [&](const AttributeTest& test) { return passes(test, node); }) &&
           std::all_of(compound.places.begin(), compound.places.end(),
                       [&](const PlaceTest& test) { return in_place(test, node); }) &&
           std::none_of(compound.unless.begin(), compound.unless.end(),
                        [&](const Compound& other) { return passes_all(other, node); });
  }

  bool in_place(const PlaceTest& test, const pugi::xml_node& node) {
    if (test.kind == PlaceTest::Kind::never) return false;
    if (test.kind == PlaceTest::Kind::root) return !parent_element(node);
    if (test.kind == PlaceTest::Kind::empty) return !node.first_child();
    int place = 1;
    const auto go = test.from_end ? element_after : element_before;
    for (auto other = go(node); other && work_ <= most_; other = go(other)) {
      ++work_;
      if (!test.of_type || local_name(other) == local_name(node)) ++place;
    }
    const int past = place - test.offset;
    return test.step == 0 ? past == 0 : past % test.step == 0 && past / test.step >= 0;
  }

  const Selector& selector_;
  std::size_t& work_;
  std::size_t most_;
};

}  // namespace

std::optional<Selector> parse_selector(std::string_view text) {
  return SelectorParser(text).parse();
}

std::size_t specificity(const Selector& selector) {
  std::size_t sum = 0;
  const auto count = [&](const Compound& part) {
    sum += part.ids.size() * id_weight +
           (part.classes.size() + part.attributes.size() + part.places.size()) * class_weight +
           (part.type.empty() ? 0 : 1);
  };
  for (const Compound& part : selector) {
    count(part);
    for (const Compound& other : part.unless) count(other);
  }
  return sum;
}

bool fits(const Selector& selector, const pugi::xml_node& node, std::size_t& work, std::size_t most_work) {
  return Fitting(selector, work, most_work).from(0, node);
}

}  // namespace unicursal::core
