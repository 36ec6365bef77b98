#include "core/drawing/css_sheet.hpp"

#include <catch2/catch.hpp>

#include "core/text/malformed.hpp"

using namespace unicursal::core;
using Catch::Matchers::Contains;

namespace {

const char* const tree =
    "<svg><g id='one' class='big red'><rect/><circle class='red' data-kind='a-b'/><rect name='last'/></g>"
    "<rect id='alone'/></svg>";

/// The names of elements that a selector fits, by their place in the document.
std::string fitting(const std::string& selector) {
  pugi::xml_document document;
  document.load_string(tree);
  const auto parsed = parse_selector(selector);
  if (!parsed) return "not understood";
  std::string result;
  struct Walker : pugi::xml_tree_walker {
    const Selector* selector = nullptr;
    std::string* result = nullptr;
    bool for_each(pugi::xml_node& node) override {
      std::size_t work = 0;
      *result += fits(*selector, node, work, 1000) ? '1' : '0';
      return true;
    }
  } walker;
  walker.selector = &*parsed;
  walker.result = &result;
  document.traverse(walker);
  return result;  // svg g rect circle rect rect
}

std::string value_of(const std::string& sheet, const std::string& name) {
  pugi::xml_document document;
  document.load_string("<g class='a b' id='i'/>");
  StyleSheet styles;
  Warnings notes;
  styles.add(sheet, "line 1: <style>", notes);
  std::string value;
  for (const Declaration& d : styles.matching(document.first_child(), "g")) {
    if (d.name == name) value = std::string(d.value) + (d.important ? "!" : "");
  }
  return value;
}

}  // namespace

TEST_CASE("selectors fit by type, class, id and attribute") {
  CHECK(fitting("rect") == "001011");
  CHECK(fitting("*") == "111111");
  CHECK(fitting(".red") == "010100");
  CHECK(fitting("g.big.red") == "010000");
  CHECK(fitting("#alone") == "000001");
  CHECK(fitting("circle#one") == "000000");
  CHECK(fitting("[class]") == "010100");
  CHECK(fitting("[class~=big]") == "010000");
  CHECK(fitting("[data-kind|='a']") == "000100");
  CHECK(fitting("[data-kind^=a][data-kind$=b][data-kind*='-']") == "000100");
  CHECK(fitting("[name=\"las\"]") == "000000");
}

TEST_CASE("selectors fit by the elements around") {
  CHECK(fitting("svg rect") == "001011");
  CHECK(fitting("svg > rect") == "000001");
  CHECK(fitting("g>rect") == "001010");
  CHECK(fitting("svg .big rect") == "001010");
  CHECK(fitting("rect + circle") == "000100");
  CHECK(fitting("rect ~ rect") == "000010");
  CHECK(fitting("g + rect") == "000001");
}

TEST_CASE("selectors fit by the place among siblings") {
  CHECK(fitting(":root") == "100000");
  CHECK(fitting("rect:first-child") == "001000");
  CHECK(fitting("rect:last-child") == "000011");
  CHECK(fitting(":nth-child(2)") == "000101");
  CHECK(fitting("g > :nth-child(odd)") == "001010");
  CHECK(fitting("g > :nth-child(-n+2)") == "001100");
  CHECK(fitting("rect:nth-of-type(2)") == "000010");
  CHECK(fitting("circle:only-of-type") == "000100");
  CHECK(fitting("rect:not([name])") == "001001");
  CHECK(fitting("rect:hover") == "000000");
}

TEST_CASE("selectors that are not understood are reported") {
  const auto text = GENERATE("", ">", "g >", "rect::before", "a|b", "[", "[a", "[a=", ".", "#",
                             ":nth-child(x)", ":nonsense", "rect)");
  CAPTURE(text);
  CHECK(fitting(text) == "not understood");
}

TEST_CASE("the more specific rule wins, then the later one") {
  CHECK(value_of("g{fill:red} g{fill:blue}", "fill") == "blue");
  CHECK(value_of(".a{fill:red} g{fill:blue}", "fill") == "red");
  CHECK(value_of("#i{fill:red} g.a.b{fill:blue}", "fill") == "red");
  CHECK(value_of(".c, .b , g {fill : red}", "fill") == "red");
  CHECK(value_of("g{fill:red !important}", "fill") == "red!");
}

TEST_CASE("what surrounds the rules of a sheet is understood") {
  CHECK(value_of("<!-- g{fill:red} /* .a{fill:blue} */ -->", "fill") == "red");
  CHECK(value_of("@import url(x.css); @font-face{src:url(a;b)} g{fill:red}", "fill") == "red");
  CHECK(value_of("@media screen{g{fill:red}} @media speech{g{fill:blue}}", "fill") == "red");
  CHECK(value_of("g{fill:url(\"a;}b\")}", "fill") == "url(\"a;}b\")");
  CHECK(value_of("g{fill:red", "fill") == "red");
  CHECK(value_of("g{;;fill:red;}}", "fill") == "red");
}

TEST_CASE("a rule with a strange selector is skipped with a note, its neighbours count") {
  Warnings notes;
  StyleSheet styles;
  styles.add("g::before{fill:red} rect{fill:blue}", "line 4: <style>", notes);
  REQUIRE(notes.sentences().size() == 1);
  CHECK_THAT(notes.sentences().front(), Contains("line 4") && Contains("g::before"));
  pugi::xml_document document;
  document.load_string("<rect/>");
  CHECK(styles.matching(document.first_child(), "rect").size() == 1);
}

TEST_CASE("style sheets that would compare without end are given up", "[optimised]") {
  std::string sheet, tree_text = "<svg>";
  sheet = "z ~ * ~ * ~ y{fill:red}";
  for (int i = 0; i < 3000; ++i) tree_text += "<y/>";
  pugi::xml_document document;
  document.load_string((tree_text + "</svg>").c_str());
  StyleSheet styles;
  Warnings notes;
  styles.add(sheet, "", notes);
  CHECK_THROWS_AS(
      [&] {
        for (const auto& node : document.first_child().children()) styles.matching(node, "y");
      }(),
      Malformed);
}
