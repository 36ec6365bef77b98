// librsvg draws the same drawings: the areas of all colours agree.
#include "tests/core/support/second_opinion.hpp"

#include <catch2/catch.hpp>

#include "tests/core/drawing/drawing_support.hpp"

using namespace unicursal;

namespace {

double difference_of(const std::filesystem::path& file) {
  const core::TempFolder folder;
  const auto scratch = folder.write("x", "").parent_path();
  const unicursal::test::Opinion opinion = unicursal::test::second_opinion(file, scratch, 600);
  INFO(file.string());
  CHECK(opinion.trouble.empty());
  return opinion.difference;
}

double difference_of_text(const std::string& elements) {
  const core::TempFolder folder;
  return difference_of(folder.write("drawing.svg", core::drawing(elements)));
}

}  // namespace

TEST_CASE("librsvg sees the same areas in the project's drawings") {
  CHECK(difference_of(core::test_data("two_zones.svg")) < 0.01);
  CHECK(difference_of(core::test_data("features.svg")) < 0.01);
  CHECK(difference_of(unicursal::test::source_folder() / "host/examples/leaf.svg") < 0.01);
}

TEST_CASE("librsvg sees the same areas in each feature of a drawing") {
  const auto elements = GENERATE(
      "<g fill='none' stroke='#f00' stroke-width='5' stroke-linejoin='round' stroke-linecap='square'>"
      "<path d='M10 10L40 40L12 60'/><path stroke='#00f' stroke-dasharray='9 4 2' d='M50 10C90 10 50 60 90 "
      "60'/></g>",
      "<path d='M20 60L35 15L45 60' fill='none' stroke='#000' stroke-width='6' stroke-miterlimit='9'/>",
      "<g transform='rotate(30 50 40) scale(2 .7)'><circle cx='25' cy='50' r='12' fill='#0a0' stroke='#fa0' "
      "stroke-width='4'/></g>",
      "<style>.a{fill:#f80}g > .b{fill:#08f}</style><g><path class='a' d='M5 5h40v30z'/><path class='b' "
      "d='M50 "
      "5h40v30z'/></g>",
      "<clipPath id='c'><circle cx='50' cy='40' r='30'/></clipPath><g clip-path='url(#c)'><rect width='50' "
      "height='80' fill='#f00'/><rect x='50' width='50' height='40' fill='#00f'/></g>",
      "<mask id='m'><rect width='100' height='80' fill='#fff'/><circle cx='50' cy='40' r='20'/></mask><rect "
      "x='10' "
      "y='10' width='80' height='60' fill='#707' mask='url(#m)'/>",
      "<marker id='m' orient='auto' markerWidth='3' markerHeight='3' refX='1' refY='1.5' viewBox='0 0 3 "
      "3'><path "
      "d='M0 0L3 1.5L0 3z' fill='#f00'/></marker><path d='M20 20L60 30L70 60' fill='none' stroke='#00f' "
      "stroke-width='5' marker-mid='url(#m)' marker-end='url(#m)'/>",
      "<symbol id='s' viewBox='0 0 10 10'><path d='M0 0h10v5z' fill='#080'/></symbol><use href='#s' "
      "width='40' "
      "height='60'/><use href='#s' x='45' y='5' width='50' height='30'/>",
      "<text x='5' y='50' font-family='DejaVu Sans' font-size='30' font-weight='bold' fill='#00f'>AVgé<tspan "
      "fill='#f00' font-size='15'>ij</tspan></text>");
  CAPTURE(elements);
  CHECK(difference_of_text(elements) < 0.02);
}

TEST_CASE("the second opinion notices a wrong colour and a wrong size") {
  const core::TempFolder folder;
  const auto scratch = folder.write("x", "").parent_path();
  const auto raster = [&](const std::string& elements) {
    return *unicursal::test::drawn_by_librsvg(folder.write("d.svg", core::drawing(elements)), 200, 160,
                                              scratch);
  };
  const auto plain = raster("<rect width='50' height='40' fill='#f00'/>");
  CHECK(unicursal::test::difference(plain, raster("<rect width='50' height='40' fill='#f00'/>")) == 0);
  CHECK(unicursal::test::difference(plain, raster("<rect width='50' height='40' fill='#00f'/>")) ==
        Approx(1));
  CHECK(unicursal::test::difference(plain, raster("<rect width='50' height='38' fill='#f00'/>")) ==
        Approx(0.05).margin(0.005));
}
