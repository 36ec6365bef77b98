#include "core/drawing/css_colour.hpp"

#include <catch2/catch.hpp>

using unicursal::core::css_colour;
using unicursal::core::read_css_colour;

TEST_CASE("all spellings of a colour give the same result") {
  const auto text = GENERATE("#ff8000", "#FF8000", "#ff8000ff", "rgb(255,128,0)", "RGB( 100% , 50.2% , 0% )",
                             "rgba(255, 128, 0, 0.5)", "rgb(255 128 0 / 50%)", "  #Ff8000\n");
  CAPTURE(text);
  CHECK(css_colour(text) == "#ff8000");
}

TEST_CASE("short hexadecimal colours double each digit") {
  CHECK(css_colour("#1aF") == "#11aaff");
  CHECK(css_colour("#1aF8") == "#11aaff");
}

TEST_CASE("colour names, the last of the list included") {
  CHECK(css_colour("AliceBlue") == "#f0f8ff");
  CHECK(css_colour("grey") == css_colour("gray"));
  CHECK(css_colour("rebeccapurple") == "#663399");
  CHECK(css_colour("lime") == "#00ff00");
  CHECK(css_colour("green") == "#008000");
  CHECK(css_colour("yellowgreen") == "#9acd32");
}

TEST_CASE("a fully transparent colour is not a fill") {
  const auto text = GENERATE("transparent", "#12345600", "rgba(1,2,3,0)");
  CHECK(css_colour(text) == "none");
}

TEST_CASE("text that is not a colour gives nullopt") {
  const auto text = GENERATE("", "#", "#12", "#12345", "#gggggg", "bleu", "rgb(1,2)", "rgb(1,2,3",
                             "rgb(1,2,3)x", "hsl(1,2)", "rgb(nan,2,3)", "rgb()", "hsl(1km,2%,3%)");
  CAPTURE(text);
  CHECK_FALSE(css_colour(text).has_value());
}

TEST_CASE("hues are turned into red, green and blue") {
  CHECK(css_colour("hsl(0, 100%, 50%)") == "#ff0000");
  CHECK(css_colour("hsl(120deg 100% 25%)") == "#008000");
  CHECK(css_colour("hsl(-120, 100%, 50%)") == "#0000ff");
  CHECK(css_colour("hsla(0.5turn, 100%, 50%, 0.3)") == "#00ffff");
  CHECK(css_colour("hsl(77, 0%, 50%)") == "#808080");
  CHECK(css_colour("hwb(0 20% 40%)") == "#993333");
}

TEST_CASE("opacity comes with the colour") {
  CHECK(read_css_colour("#ff000080")->alpha == Approx(128 / 255.0));
  CHECK(read_css_colour("rgb(1 2 3 / 25%)")->alpha == Approx(0.25));
  CHECK(read_css_colour("transparent")->alpha == 0);
  CHECK(read_css_colour("red")->alpha == 1);
}
