#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>

#include "core/error.hpp"
#include "core/model/stl_reader.hpp"
#include "core/text/file_bytes.hpp"
#include "model_support.hpp"

using namespace unicursal::core;
using Catch::Matchers::Contains;

namespace {

const Mesh cube = box_mesh({0, 0, 0}, {20, 20, 20});

struct Read {
  Mesh mesh;
  std::vector<std::string> notes;
};

Read read(const std::string& bytes) {
  const TempFolder folder;
  Warnings warnings;
  Read result{read_stl(folder.write("mesh.stl", bytes), warnings), {}};
  result.notes = warnings.sentences();
  return result;
}

std::string refusal(const std::string& bytes) {
  try {
    read(bytes);
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
  const auto header = GENERATE("", "solid cube", "solid\nfacet normal 0 0 1\n");
  const Read result = read(binary_stl(cube, header));
  REQUIRE(result.mesh.size() == 12);
  CHECK(result.mesh[3][2] == cube[3][2]);
  CHECK(result.notes.empty());
}

TEST_CASE("ASCII files in several spellings") {
  CHECK(read(file_bytes(test_data("cube20.stl"))).mesh.size() == 12);
  CHECK(read(ascii("+1.5e-1")).mesh.at(0)[1].y() == Approx(0.15));
  CHECK(read(ascii("1") + ascii("2")).mesh.size() == 2);
  CHECK(read(ascii("1e-400")).mesh.at(0)[1].y() == 0);
  CHECK(read(ascii("1,25")).mesh.at(0)[1].y() == 1.25);
  std::string shouting = ascii("3");
  for (char& c : shouting) c = static_cast<char>(std::toupper(c));
  CHECK(read(shouting).mesh.size() == 1);
  CHECK(read("\xef\xbb\xbf" + ascii("3")).mesh.size() == 1);
  CHECK(read(ascii("3") + "\x1a").mesh.size() == 1);
}

TEST_CASE("lines may end in any way, or not at all") {
  for (const char* const end : {"\r", "\r\n", " "}) {
    std::string text;
    for (const char c : ascii("3")) text += c == '\n' ? end : std::string(1, c);
    CHECK(read(text).mesh.size() == 1);
  }
  std::string old = ascii("one");
  std::replace(old.begin(), old.end(), '\n', '\r');
  CHECK_THAT(refusal(old), Contains("line 5"));
}

TEST_CASE("normals are never used, and may be anything or absent") {
  for (const char* const normal : {"normal nan nan nan", "normal", "", "normal 1.#IND 0 x", "normal 0 0"}) {
    std::string text = ascii("3");
    text.replace(text.find("normal 0 0 1"), 12, normal);
    CAPTURE(normal);
    CHECK(read(text).mesh.at(0)[1].y() == 3);
  }
}

TEST_CASE("words behind endloop and endfacet are remarks, on several lines or on one") {
  std::string text = "solid s\n";
  for (int i = 0; i < 2; ++i)
    text +=
        "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop foo\nendfacet bar "
        "1\n";
  text += "endsolid s\n";
  CHECK(read(text).mesh.size() == 2);
  std::replace(text.begin(), text.end(), '\n', ' ');
  const Read one_line = read(text);
  CHECK(one_line.mesh.size() == 2);
  CHECK(one_line.notes.empty());
  CHECK_THAT(refusal(ascii("0 stray")), Contains("line 5") && Contains("stray"));
}

TEST_CASE("a facet of four corners is two triangles") {
  std::string text = ascii("3");
  text.insert(text.find("endloop"), "vertex -1 -1 0\n");
  const Mesh mesh = read(text).mesh;
  REQUIRE(mesh.size() == 2);
  CHECK(mesh[1] == Triangle{mesh[0][0], mesh[0][2], Vec3(-1, -1, 0)});
}

TEST_CASE("a text without endsolid is read, with a note") {
  const std::string whole = ascii("1");
  const Read result = read(whole.substr(0, whole.find("endsolid")));
  CHECK(result.mesh.size() == 1);
  CHECK_THAT(result.notes.at(0), Contains("without endsolid") && Contains("1 facets"));
}

TEST_CASE("if a binary file's size contradicts its count, whole triangles decide, with a note") {
  std::string bytes = binary_stl(cube);
  const auto announcing = [&](char count) {
    std::string changed = bytes;
    changed[80] = count;
    return changed;
  };
  for (const char count : {'\0', '\5', '\77'}) {
    const Read result = read(announcing(count));
    CHECK(result.mesh.size() == 12);
    CHECK_THAT(result.notes.at(0), Contains("the 12 that the file holds"));
  }
  const Read trailing = read(bytes + "xyz");
  CHECK(trailing.mesh.size() == 12);
  CHECK_THAT(trailing.notes.at(0), Contains("3 bytes behind its last triangle"));
}

TEST_CASE("files cut short are refused") {
  const std::string bytes = binary_stl(cube, "solid");
  CHECK_THAT(refusal(bytes.substr(0, bytes.size() - 1)), Contains("12 triangles") && Contains("684"));
  CHECK_THAT(refusal(binary_stl(cube).substr(0, 50)), Contains("too short"));
  CHECK_THAT(refusal(""), Contains("too short"));
  CHECK_THAT(refusal(binary_stl({})), Contains("no triangles"));
  CHECK_THAT(refusal("solid x\nendsolid x\n"), Contains("no triangles"));
}

TEST_CASE("damaged text is refused with its line") {
  const std::string whole = ascii("1");
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
