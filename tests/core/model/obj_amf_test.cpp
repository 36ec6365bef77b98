// OBJ and AMF files.
#include <catch2/catch.hpp>

#include "core/error.hpp"
#include "core/model/obj_reader.hpp"
#include "packages.hpp"

using namespace unicursal::core;
using Catch::Matchers::Contains;

namespace {

std::string refusal(const std::filesystem::path& file, const std::vector<std::string>& selects = {"model"}) {
  try {
    part({file}, selects);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

/// A box's six sides as faces of four corners, counted from the end of the vertices.
const std::string sides =
    "f -8/1/1 -6/1/1 -5/1/1 -7/1/1\nf -4 -3 -1 -2\nf -8//1 -7//1 -3//1 -4//1\nf -6 -2 -1 -5\nf -8 -4 -2 "
    "-6\nf -7 -5 -1 "
    "-3\n";

std::string corners(double x0, double x1, const std::string& colour = "") {
  std::string text;
  for (const double z : {0.0, 3.0}) {
    for (const double y : {0.0, 10.0}) {
      for (const double x : {x0, x1}) text += fmt::format("v {} {} {} {}\n", x, y, z, colour);
    }
  }
  return text;
}

std::vector<double> areas(const std::filesystem::path& file, const std::vector<std::string>& selects) {
  const auto p = part({file}, selects, 0.25);
  std::vector<double> result;
  for (std::size_t zone = 0; zone < selects.size(); ++zone) result.push_back(zone_area(p->layer(4), zone));
  return result;
}

std::string amf_mesh(double x0, double x1, const std::string& volume_head, const std::string& top = "") {
  std::string text = "<mesh><vertices>";
  for (const Triangle& t : box_mesh({x0, 0, 0}, {x1, 10, 3})) {
    for (const Vec3& v : t)
      text += fmt::format("<vertex><coordinates><x>{}</x><y>{}</y><z>{}</z></coordinates></vertex>", v.x(),
                          v.y(), v.z());
  }
  text += "</vertices><volume " + volume_head;
  for (int t = 0; t < 12; ++t) {
    text += fmt::format("<triangle>{}<v1>{}</v1><v2>{}</v2><v3>{}</v3></triangle>",
                        t == 2 || t == 3 ? top : "", 3 * t, 3 * t + 1, 3 * t + 2);
  }
  return text + "</volume></mesh>";
}

const std::string two_volumes =
    "<?xml version='1.0'?><amf unit='millimeter'><object id='10'>" +
    amf_mesh(0, 20, "materialid='1'><metadata type='name'>left</metadata>") + "</object><object id='2'>" +
    amf_mesh(20, 30, "><metadata type='name'>right</metadata><color><r>0</r><g>0</g><b>1</b></color>") +
    "</object><material id='1'><metadata "
    "type='name'>Clay</metadata><color><r>1</r><g>0</g><b>0</b></color></material>"
    "</amf>";

}  // namespace

TEST_CASE("an OBJ file's faces may have any number of corners, counted from either end") {
  const TempFolder folder;
  CHECK(areas(folder.write("model.obj", corners(0, 20) + sides), {"model.obj"})[0] == Approx(200));
  const std::string windows =
      "# comment\r\n" + corners(0, 20) + "f 1 3 4 \\\r\n 2\n" + sides.substr(sides.find('\n'));
  CHECK(areas(folder.write("model.obj", windows), {"model"})[0] == Approx(200));
}

TEST_CASE("objects and materials of an OBJ file are zones") {
  const TempFolder folder;
  folder.write("two.mtl", "newmtl terra cotta\nKd 1 0 0\nnewmtl sky\nKd 0 0 1\nKs 1 1 1\n");
  const auto file =
      folder.write("model.obj", "mtllib C:\\work\\two.mtl\no left\nusemtl terra cotta\n" + corners(0, 20) +
                                    sides + "o right\nusemtl sky\n" + corners(20, 30) + sides);
  for (const auto& selects : {std::vector<std::string>{"left", "right"},
                              {"red", "#0000ff"},
                              {"Terra Cotta", "sky"},
                              {"body 1", "model"}}) {
    CAPTURE(selects);
    const auto found = areas(file, selects);
    CHECK(found[0] == Approx(200).epsilon(1e-3));
    CHECK(found[1] == Approx(100).epsilon(1e-3));
  }
}

TEST_CASE("an OBJ file whose groups are sides of one solid is one body") {
  const TempFolder folder;
  const auto cut = sides.find('\n') + 1;
  const auto file = folder.write(
      "model.obj", corners(0, 20) + "g bottom\n" + sides.substr(0, cut) + "g rest\n" + sides.substr(cut));
  const auto p = part({file}, {"model"}, 0.25);
  CHECK(outline_area(p->layer(3)) == Approx(200));
  CHECK(p->warnings().empty());
}

TEST_CASE("colours of an OBJ file's vertices are zones") {
  const TempFolder folder;
  const auto file =
      folder.write("model.obj", corners(0, 20, "1 0 0") + sides + corners(20, 30, "0 0 1.0") + sides);
  const auto found = areas(file, {"red", "blue"});
  CHECK(found[0] == Approx(200).epsilon(1e-3));
  CHECK(found[1] == Approx(100).epsilon(1e-3));
}

TEST_CASE("painted facets that are so narrow that they have no area leave the others as they are") {
  const TempFolder folder;
  folder.write("model.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
  // The bottom reaches to a corner that nearly coincides with another one.
  const auto file =
      folder.write("model.obj",
                   "mtllib model.mtl\nusemtl red\nv 0 0 0\nv 1e-320 0 0\nv 20 0 0\nv 20 10 0\nv 0 10 0\n"
                   "v 0 0 3\nv 20 0 3\nv 20 10 3\nv 0 10 3\nf 1 5 4 3 2\nf 6 7 8 9\nusemtl blue\n"
                   "f 1 2 6\nf 2 3 7 6\nf 3 4 8 7\nf 4 5 9 8\nf 5 1 6 9\n");
  const auto found = areas(file, {"red", "blue"});
  CHECK(found[0] + found[1] == Approx(200).epsilon(1e-3));
}

TEST_CASE("damaged OBJ files are refused with their line, and absent materials are told") {
  const TempFolder folder;
  CHECK_THAT(refusal(folder.write("model.obj", "v 0 0 0\nv 1 0\n")),
             Contains("line 2") && Contains("three numbers"));
  CHECK_THAT(refusal(folder.write("model.obj", corners(0, 9) + "f 1 2 9\n")),
             Contains("line 9") && Contains("\"9\""));
  CHECK_THAT(refusal(folder.write("model.obj", "v 0 0 nan\n")), Contains("\"nan\""));
  CHECK_THAT(refusal(folder.write("model.obj", "v 0 0 1e9\n")), Contains("100 m"));
  CHECK_THAT(refusal(folder.write("model.obj", "v 0 0 0\n")), Contains("no faces"));
  const auto file = folder.write("model.obj", "mtllib lost.mtl\n" + corners(0, 20) + sides);
  CHECK_THAT(part({file}, {"model"})->warnings().at(0), Contains("lost.mtl"));
}

TEST_CASE("the volumes of an AMF file are zones, plain or zipped") {
  const TempFolder folder;
  const auto file = GENERATE(false, true) ? folder.write("model.amf", two_volumes)
                                          : write_zip(folder, "model.amf", {{"something.amf", two_volumes}});
  for (const auto& selects :
       {std::vector<std::string>{"left", "right"}, {"red", "blue"}, {"clay", "body 2"}}) {
    CAPTURE(selects);
    const auto found = areas(file, selects);
    CHECK(found[0] == Approx(200).epsilon(1e-3));
    CHECK(found[1] == Approx(100).epsilon(1e-3));
  }
}

TEST_CASE("an AMF's unit, constellations and coloured triangles are read") {
  const TempFolder folder;
  const std::string inches = "<amf unit='inch'><object id='1'>" + amf_mesh(0, 1, ">") + "</object></amf>";
  CHECK(
      part({folder.write("model.amf", inches)}, {"model"}, 0.25)->extent().size().isApprox(Vec2(25.4, 254)));
  const std::string twice = "<amf><object id='1'>" + amf_mesh(0, 20, ">") +
                            "</object><constellation id='2'><instance objectid='1'/><instance "
                            "objectid='1'><deltax>50</deltax><rz>90</rz>"
                            "</instance></constellation></amf>";
  const auto p = part({folder.write("model.amf", twice)}, {"model"}, 0.25);
  CHECK(p->extent().min.isApprox(Vec2(0, 0)));
  CHECK(p->extent().max.isApprox(Vec2(50, 20)));
  CHECK(outline_area(p->layer(3)) == Approx(400));
  const std::string painted = "<amf><object id='1'>" +
                              amf_mesh(0, 20, ">", "<color><r>0</r><g>0</g><b>1</b></color>") +
                              "</object></amf>";
  const auto q = part({folder.write("model.amf", painted)}, {"model", "blue"}, 0.1);
  CHECK(zone_area(q->layer(29), 1) == Approx(200).epsilon(0.02));
  CHECK(zone_area(q->layer(10), 1) == 0);
}

TEST_CASE("what programs for slicing add to AMF is read: scale, mirror, radians, and kinds of volumes") {
  const TempFolder folder;
  const auto placed = [&](const std::string& head, const std::string& how, const std::string& volume = ">") {
    const std::string amf = "<amf>" + head + "<object id='1'>" + amf_mesh(0, 20, volume) +
                            "</object><constellation id='2'><instance objectid='1'>" + how +
                            "</instance></constellation></amf>";
    return folder.write("model.amf", amf);
  };
  const auto size = [&](const std::string& head, const std::string& how) {
    return part({placed(head, how)}, {"model"}, 0.25)->extent().size();
  };
  CHECK(size("", "<scale>2</scale>").isApprox(Vec2(40, 20)));
  CHECK(size("", "<scalex>3</scalex>").isApprox(Vec2(60, 10)));
  const std::string by = "<metadata type='cad'>PrusaSlicer 2.7</metadata>";
  CHECK(size(by, "<rz>1.5707963267948966</rz>").isApprox(Vec2(10, 20), 1e-6));
  CHECK(outline_area(part({placed(by, "<mirrorx>-1</mirrorx>")}, {"model"}, 0.25)->layer(3)) == Approx(200));
  const auto kind = [](const std::string& word) {
    return "><metadata type='slic3r.volume_type'>" + word + "</metadata>";
  };
  CHECK_THAT(refusal(placed("", "", kind("SupportBlocker"))), Contains("no mesh"));
  CHECK_THAT(refusal(placed("", "", kind("NegativeVolume"))), Contains("matches nothing"));
  CHECK_THAT(refusal(placed("", "<printable>0</printable>")), Contains("no mesh"));
}

TEST_CASE("damaged AMF files are refused") {
  const TempFolder folder;
  const std::string far_away =
      "<amf unit='meter'><object id='1'><mesh><vertices><vertex><coordinates><x>1e308</x><y>1e308</y>"
      "<z>1e308</z></coordinates></vertex></vertices><volume><triangle><v1>0</v1><v2>0</v2><v3>0</v3>"
      "</triangle></volume></mesh></object></amf>";
  CHECK_THAT(refusal(folder.write("model.amf", far_away)), Contains("100 m away"));
  CHECK_THAT(refusal(folder.write("model.amf", "solid")), Contains("not well-formed"));
  CHECK_THAT(refusal(folder.write("model.amf", "<svg/>")), Contains("not an AMF"));
  CHECK_THAT(refusal(folder.write("model.amf", "<amf/>")), Contains("no mesh"));
  CHECK_THAT(refusal(folder.write("model.amf",
                                  "<amf><constellation id='1'><instance objectid='1'/></constellation>"
                                  "<constellation id='2'><instance objectid='1'/></constellation></amf>")),
             Contains("without end"));
  CHECK_THAT(refusal(write_zip(folder, "model.amf", {{"a.txt", ""}, {"b.txt", ""}})), Contains("no AMF"));
}
