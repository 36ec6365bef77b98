#include <catch2/catch.hpp>
#include <limits>

#include "core/error.hpp"
#include "core/model/stl_reader.hpp"
#include "model_support.hpp"

using namespace unicursal::core;
using Catch::Matchers::Contains;

namespace {

const Mesh cube = box_mesh({0, 0, 0}, {20, 20, 20});

std::string refusal(const std::string& bytes) {
  const TempFolder folder;
  try {
    read_stl(folder.write("mesh.stl", bytes));
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

std::string ascii(const std::string& coordinate) {
  return "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 " + coordinate +
         " 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid s\n";
}

}  // namespace

TEST_CASE("a binary file is binary whatever its header says") {
  const TempFolder folder;
  const auto header = GENERATE("", "solid cube", "solid\nfacet normal 0 0 1\n");
  const auto triangles = read_stl(folder.write("mesh.stl", binary_stl(cube, header)));
  REQUIRE(triangles.size() == 12);
  CHECK(triangles[3][2] == cube[3][2]);
}

TEST_CASE("ASCII files in several spellings") {
  const TempFolder folder;
  CHECK(read_stl(test_data("cube20.stl")).size() == 12);
  CHECK(read_stl(folder.write("a.stl", ascii("+1.5e-1"))).at(0)[1].y() == Approx(0.15));
  CHECK(read_stl(folder.write("b.stl", ascii("1") + ascii("2"))).size() == 2);
  CHECK(read_stl(folder.write("c.stl", ascii("1e-400"))).at(0)[1].y() == 0);
  std::string shouting = ascii("3");
  for (char& c : shouting) c = static_cast<char>(std::toupper(c));
  CHECK(read_stl(folder.write("d.stl", shouting)).size() == 1);
}

TEST_CASE("files cut short or grown are refused") {
  const std::string bytes = binary_stl(cube, "solid");
  CHECK_THAT(refusal(bytes.substr(0, bytes.size() - 1)), Contains("12 triangles") && Contains("684"));
  CHECK_THAT(refusal(bytes + "x"), Contains("685"));
  CHECK_THAT(refusal(binary_stl(cube).substr(0, 50)), Contains("too short"));
  CHECK_THAT(refusal(""), Contains("too short"));
  CHECK_THAT(refusal(binary_stl({})), Contains("no triangles"));
  CHECK_THAT(refusal("solid x\nendsolid x\n"), Contains("no triangles"));
}

TEST_CASE("damaged text is refused with its line") {
  const std::string whole = ascii("1");
  CHECK_THAT(refusal(whole.substr(0, whole.find("endsolid"))), Contains("before endsolid"));
  CHECK_THAT(refusal(whole.substr(0, whole.find("endloop"))), Contains("ends where endloop"));
  CHECK_THAT(refusal(ascii("one")), Contains("line 5") && Contains("\"one\""));
  CHECK_THAT(refusal(ascii("1 2")), Contains("line 5") && Contains("vertex"));
  CHECK_THAT(refusal("solid x\nfasset\n"), Contains("line 2"));
}

TEST_CASE("coordinates that are not numbers are refused with triangle and vertex") {
  const auto text = GENERATE("nan", "-nan(ind)", "inf", "-inf", "1e999", "1.#QNAN");
  CAPTURE(text);
  CHECK_THAT(refusal(ascii(text)), Contains("triangle 1, vertex 2") && Contains("not a finite number"));
  Mesh mesh = cube;
  mesh[6][2].z() = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(refusal(binary_stl(mesh)), Contains("triangle 7, vertex 3"));
  mesh[6][2].z() = 1e30;
  CHECK_THAT(refusal(binary_stl(mesh)), Contains("triangle 7, vertex 3") && Contains("100 m"));
}
