#include "core/model/threemf_reader.hpp"

#include <catch2/catch.hpp>

#include "core/error.hpp"
#include "core/model/inspect_model.hpp"
#include "core/model/noted_error.hpp"
#include "packages.hpp"

using namespace unicursal::core;
using Catch::Matchers::Contains;

namespace {

const Mesh box = box_mesh({0, 0, 0}, {20, 10, 3});

std::string object(int id, const std::string& content, const std::string& more = "") {
  return fmt::format("<object id='{}' type='model' {}>{}</object>", id, more, content);
}

std::string refusal(const std::filesystem::path& file, const std::vector<std::string>& selects = {"model"}) {
  try {
    part({file}, selects);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

/// Of the zones in the layer whose middle is nearest to z.
std::vector<double> areas_at(const Part& part, double z) {
  const double height = part.layer(1).top - part.layer(0).top;
  const Layer layer = part.layer(std::min(part.layer_count() - 1, std::size_t(z / height)));
  std::vector<double> areas;
  for (std::size_t zone = 0; zone < part.zones().size(); ++zone) areas.push_back(zone_area(layer, zone));
  return areas;
}

const std::string colours =
    "<m:colorgroup id='9'><m:color color='#FF0000FF'/><m:color color='#0000FF'/></m:colorgroup>";

}  // namespace

TEST_CASE("a 3MF's unit is obeyed") {
  const TempFolder folder;
  const auto size = [&](const std::string& unit) {
    const std::string xml = model_xml(object(1, mesh_xml(box)), "<item objectid='1'/>", unit);
    return part({write_3mf(folder, xml)}, {"model.3mf"}, 0.25)->extent().size();
  };
  CHECK(size("") == Vec2(20, 10));
  CHECK(size("unit='inch'").isApprox(Vec2(508, 254)));
  CHECK(size("unit='centimeter'").isApprox(Vec2(200, 100)));
  CHECK(size("unit='meter'").isApprox(Vec2(20000, 10000)));
  const std::string xml = model_xml(object(1, mesh_xml(box)), "<item objectid='1'/>", "unit='parsec'");
  CHECK_THAT(refusal(write_3mf(folder, xml)), Contains("parsec"));
}

TEST_CASE("items and components are placed by their transforms, mirrored ones too") {
  const TempFolder folder;
  // A pair of boxes 10 mm apart, one of them mirrored, and the pair once more, turned by a quarter.
  const std::string pair =
      "<components><component objectid='1'/>"
      "<component objectid='1' transform='-1 0 0 0 1 0 0 0 1 50 0 0'/></components>";
  const auto file =
      write_3mf(folder, model_xml(object(1, mesh_xml(box)) + object(2, pair),
                                  "<item objectid='2'/>"
                                  "<item objectid='2' transform='0 1 0 -1 0 0 0 0 1 0 20 0'/>"));
  const auto p = part({file}, {"model.3mf"}, 0.25);
  CHECK(p->warnings().empty());
  CHECK(p->extent().min.isApprox(Vec2(-10, 0)));
  CHECK(p->extent().max.isApprox(Vec2(50, 70)));
  const Layer layer = p->layer(2);
  CHECK(layer.islands.size() == 4);
  CHECK(outline_area(layer) == Approx(4 * 200));
}

TEST_CASE("what is not to be printed is left out") {
  const TempFolder folder;
  const auto file =
      write_3mf(folder, model_xml(object(1, mesh_xml(box)) + "<object id='2' type='support'>" +
                                      mesh_xml(box_mesh({40, 0, 0}, {50, 10, 3})) + "</object>",
                                  "<item objectid='1'/><item objectid='2'/>"
                                  "<item objectid='1' printable='0' transform='1 0 0 0 1 0 0 0 1 0 90 0'/>"));
  const auto p = part({file}, {"model.3mf"}, 0.25);
  CHECK(p->extent().size() == Vec2(20, 10));
  CHECK_THAT(p->warnings().at(0), Contains("supports"));
}

TEST_CASE("base materials and colours of objects are zones, by colour and by name") {
  const TempFolder folder;
  const auto file = write_3mf(
      folder,
      model_xml("<basematerials id='5'><base name='PLA sky' displaycolor='#4080C0FF'/></basematerials>" +
                    colours + object(1, mesh_xml(box), "pid='5' pindex='0' name='left'") +
                    object(2, mesh_xml(box_mesh({20, 0, 0}, {30, 10, 3})), "pid='9' pindex='1' name='right'"),
                "<item objectid='1'/><item objectid='2'/>"));
  const auto selects =
      GENERATE(as<std::vector<std::string>>{}, std::vector<std::string>{"left", "right"},
               std::vector<std::string>{"#4080c0", "blue"}, std::vector<std::string>{"PLA sky", "body 2"},
               std::vector<std::string>{"model.3mf", "Right"},
               std::vector<std::string>{"model:left", "model.3mf:#00f"});
  CAPTURE(selects);
  const auto areas = areas_at(*part({file}, selects, 0.25), 1);
  CHECK(areas[0] == Approx(200).epsilon(1e-3));
  CHECK(areas[1] == Approx(100).epsilon(1e-3));
  CHECK_THAT(refusal(file, {"left"}),
             Contains("no zone selects the body \"right\"") && Contains("\"#0000ff\""));
  CHECK_THAT(refusal(file, {"left", "body 1", "right"}), Contains("already selected"));
  CHECK_THAT(refusal(file, {"model", "green"}), Contains("matches nothing"));
}

TEST_CASE("a coloured facet colours the space below it down to the paint's depth") {
  const TempFolder folder;
  const Mesh tall = box_mesh({0, 0, 0}, {20, 10, 8});
  const auto file = write_3mf(
      folder, model_xml(colours + object(1, mesh_xml(tall, {{2, "pid='9' p1='1'"}, {3, "p1='1' pid='9'"}}),
                                         "pid='9' pindex='0'"),
                        "<item objectid='1'/>"));
  PartSource source;
  source.files = {file};
  source.layer_height = 0.1;
  source.zones = zones({"red", "blue"});
  const auto p = read_part(source);
  // The two colours meet at half of the angle between their sides, so the red sides stay red.
  for (const double below : {0.05, 0.55, 1.15}) {
    CAPTURE(below);
    const auto areas = areas_at(*p, 8 - below);
    CHECK(areas[1] == Approx((20 - 2 * below) * (10 - 2 * below)).epsilon(2e-3));
    CHECK(areas[0] + areas[1] == Approx(200));
  }
  CHECK(areas_at(*p, 8 - 1.25)[1] == 0);
  const auto whole = part({file}, {"model"}, 0.1);
  CHECK(areas_at(*whole, 7.9)[0] == Approx(200));
  CHECK_THAT(whole->warnings().at(0), Contains("no zone selects the paint #0000ff"));
}

TEST_CASE("facets with a material that is not read are those of their body") {
  const TempFolder folder;
  const auto file =
      write_3mf(folder, model_xml(colours + "<m:texture2dgroup id='7' texid='1'/>" +
                                      object(1, mesh_xml(box, {{0, "pid='9' p1='0' p2='0' p3='0'"},
                                                               {1, "pid='9' p1='0'"},
                                                               {2, "pid='7' p1='0' p2='1' p3='2'"}})),
                                  "<item objectid='1'/>"));
  const auto p = part({file}, {"model.3mf", "red"}, 0.25);
  CHECK(p->warnings().size() == 1);
  CHECK_THAT(p->warnings().at(0), Contains("textures are not read"));
  CHECK(areas_at(*p, 2.9)[1] == 0);
}

TEST_CASE("paint of both sides meets in the middle of a thin wall") {
  const TempFolder folder;
  const Mesh wall = box_mesh({0, 0, 0}, {40, 1, 10});
  const auto file = write_3mf(
      folder,
      model_xml(object(1, mesh_xml(wall, {{4, "paint_color='4'"},
                                          {5, "paint_color='4'"},
                                          {6, "paint_color='8'"},
                                          {7, "paint_color='8'"}})),
                "<item objectid='1'/>"),
      {{"Metadata/project_settings.config", R"({"filament_colour": ["#ffffff", "#111111", "#222222"]})"},
       {"Metadata/model_settings.config",
        "<config><object id='1'><metadata key='extruder' value='3'/></object></config>"}});
  const auto areas = areas_at(*part({file}, {"#222222", "#ffffff", "#111111"}, 0.2), 5);
  CHECK(areas[1] == Approx(20).epsilon(0.05));
  CHECK(areas[2] == Approx(20).epsilon(0.05));
}

TEST_CASE("blends of filaments are numbered behind them, without those that are deleted or not in use") {
  const TempFolder folder;
  const auto painted = [&](int filament) {
    const auto file = write_3mf(
        folder, model_xml(object(1, mesh_xml(box)), "<item objectid='1'/>"),
        {{"Metadata/project_settings.config",
          R"({"filament_colour": ["#0000FF", "#FF0000", "#FFFFFF"], "mixed_filament_definitions":
             "1,2,0,0,50,0,g,w,m2,d1,o1,u1;1,2,1,1,20,0,g,w,m2,d0,o0,u2;1,3,1,1,50,0,g,d1,u3;)"
          R"(1,2,1,1,0,0,g,w,m2,d0,o0,u4,1333;1,7,1,1,50;x,y,1,1,z"})"},
         {"Metadata/model_settings.config",
          fmt::format("<config><object id='1'><metadata key='extruder' value='{}'/></object></config>",
                      filament)}});
    return inspect_model({file}).zones.at(0);
  };
  CHECK(painted(3).select == "#ffffff");
  CHECK(painted(4).select == "#3300cc");  // four parts of blue, one of red
  CHECK(painted(5).select == "#bfbfff");  // one layer of blue, three of white
  CHECK(painted(6).select == "filament 6");
  CHECK(painted(7).colour.empty());
}

TEST_CASE("PrusaSlicer's volumes have filaments and roles of their own") {
  const TempFolder folder;
  const Mesh all = joined(joined(box, box_mesh({20, 0, 0}, {30, 10, 3})),
                          joined(box_mesh({5, 2, -1}, {8, 8, 4}), box_mesh({-5, -5, 2}, {50, 50, 9})));
  const auto volume = [](int first, const char* name, const char* type, int extruder) {
    return fmt::format(
        "<volume firstid='{}' lastid='{}'><metadata type='volume' key='name' value='{}'/><metadata "
        "type='volume' key='volume_type' value='{}'/><metadata type='volume' key='extruder' value='{}'/>"
        "</volume>",
        first, first + 11, name, type, extruder);
  };
  const std::string config = "<config><object id='1'><metadata type='object' key='name' value='tile'/>" +
                             volume(0, "left", "ModelPart", 1) + volume(12, "right", "ModelPart", 2) +
                             volume(24, "slot", "NegativeVolume", 0) +
                             volume(36, "cap", "ParameterModifier", 3) + "</object></config>";
  const auto file =
      write_3mf(folder, model_xml(object(1, mesh_xml(all)), "<item objectid='1'/>"),
                {{"Metadata/Slic3r_PE_model.config", config},
                 {"Metadata/Slic3r_PE.config",
                  "; extruder_colour = #FF0000;;#00FF00\n; filament_colour = #111111;#0000FF;#333333\n"}});
  const auto p = part({file}, {"red", "blue", "filament 3"}, 0.25);
  const auto low = areas_at(*p, 1), high = areas_at(*p, 2.5);
  CHECK(low[0] == Approx(200 - 18).epsilon(1e-3));
  CHECK(low[1] == Approx(100).epsilon(1e-3));
  CHECK(low[2] == 0);
  CHECK(high[0] + high[1] == 0);
  CHECK(high[2] == Approx(300 - 18).epsilon(1e-3));
  CHECK(p->extent().size() == Vec2(30, 10));
}

TEST_CASE("PrusaSlicer's paint is read") {
  const TempFolder folder;
  // The top: one triangle whole, of the other the three corners but not the middle.
  const auto file =
      write_3mf(folder, model_xml(object(1, mesh_xml(box, {{2, "slic3rpe:mmu_segmentation='8'"},
                                                           {3, "slic3rpe:mmu_segmentation='88803'"}})),
                                  "<item objectid='1'/>"));
  PartSource source;
  source.files = {file};
  source.layer_height = 0.1;
  source.zones = zones({"model.3mf", "filament 2"});
  CHECK(areas_at(*read_part(source), 2.95)[1] == Approx(100 + 75).epsilon(0.03));
}

TEST_CASE("Bambu Studio's parts lie in other files of the package and have filaments of their own") {
  const TempFolder folder;
  const std::string parts =
      model_xml(object(1, mesh_xml(box)) + object(2, mesh_xml(box_mesh({20, 0, 0}, {30, 10, 3}))) +
                    object(3, mesh_xml(box_mesh({0, 0, -1}, {5, 10, 9}))),
                "");
  const std::string root = model_xml(
      object(
          8,
          "<components><component p:path='/3D/Objects/o.model' objectid='1'/><component "
          "p:path='/3D/Objects/o.model' objectid='2'/><component p:path='/3D/Objects/o.model' objectid='3'/>"
          "</components>"),
      "<item objectid='8'/><item objectid='8' transform='1 0 0 0 1 0 0 0 1 300 0 0'/>");
  const std::string settings =
      "<config><object id='8'><metadata key='name' value='tile'/><metadata key='extruder' value='2'/>"
      "<part id='1' subtype='normal_part'><metadata key='name' value='left'/><metadata key='extruder' "
      "value='1'/></part>"
      "<part id='2' subtype='normal_part'><metadata key='name' value='right'/></part>"
      "<part id='3' subtype='negative_part'/></object>"
      "<plate><metadata key='plater_id' value='1'/><model_instance><metadata key='object_id' "
      "value='8'/><metadata "
      "key='instance_id' value='0'/></model_instance></plate><plate><metadata key='plater_id' value='2'/>"
      "<model_instance><metadata key='object_id' value='8'/><metadata key='instance_id' "
      "value='1'/></model_instance>"
      "</plate></config>";
  const auto file =
      write_3mf(folder, root,
                {{"3D/Objects/o.model", parts},
                 {"Metadata/model_settings.config", settings},
                 {"Metadata/project_settings.config", R"({"filament_colour": ["#FF8000", "#0000FFFF"]})"}});
  for (const auto& selects :
       {std::vector<std::string>{"#ff8000", "blue"}, {"left", "right"}, {"filament 1", "tile"}}) {
    CAPTURE(selects);
    const auto p = part({file}, selects, 0.25);
    CHECK(p->extent().size() == Vec2(30, 10));
    const auto areas = areas_at(*p, 1);
    CHECK(areas[0] == Approx(150).epsilon(1e-3));
    CHECK(areas[1] == Approx(100).epsilon(1e-3));
    CHECK_THAT(p->warnings().at(0), Contains("2 plates; plate 1"));
  }
}

TEST_CASE("a 3MF without a mesh is refused with what it holds instead and what to do") {
  const TempFolder folder;
  const auto of = [&](const std::string& resources, const Files& more = {}) {
    return refusal(write_3mf(folder, model_xml(resources, "<item objectid='1'/>"), more));
  };
  const std::string corners = "<vertices><vertex x='0' y='0' z='0'/><vertex x='9' y='0' z='0'/></vertices>";
  CHECK_THAT(
      of(object(1, "<mesh>" + corners +
                       "<b:beamlattice xmlns:b='b' radius='1'><b:beams><b:beam v1='0' v2='1'/></b:beams>"
                       "</b:beamlattice></mesh>")),
      Contains("it holds a lattice of beams, and no mesh") && Contains("turn it into a mesh"));
  CHECK_THAT(
      of("<s:slicestack xmlns:s='s' id='2'/>" + object(1, "<mesh/>", "s:slicestackid='2' xmlns:s='s'")),
      Contains("it holds slices, and no mesh"));
  CHECK_THAT(of(object(1, "<v:levelset xmlns:v='v' functionid='3'/>")),
             Contains("a shape given by a function"));
  CHECK_THAT(of(object(1, "<d:displacementmesh xmlns:d='d'/>")), Contains("displaced by a texture"));
  CHECK_THAT(of(object(1, "<bo:booleanshape xmlns:bo='bo' objectid='4'/>")), Contains("united or cut"));
  // What Bambu Studio and OrcaSlicer export as the file of a sliced plate: its objects are left out.
  CHECK_THAT(refusal(write_3mf(folder, model_xml("", ""), {{"Metadata/plate_1.gcode", "G28"}})),
             Contains("G-code that a slicer made") && Contains("save the project itself"));
  const std::string elsewhere =
      object(1, "<components><component p:path='/3D/a.model' objectid='1'/></components>");
  CHECK_THAT(of(elsewhere, {{"3D/a.model", std::string("%3McF\0\0\x17", 8)}}), Contains("is encrypted"));
}

TEST_CASE("shapes and materials of a 3MF that are not read are named in a note") {
  const TempFolder folder;
  const auto notes = [&](const std::string& resources) {
    return part({write_3mf(folder, model_xml(resources, "<item objectid='1'/>"))}, {"model.3mf"})->warnings();
  };
  const auto rough = notes(object(1, mesh_xml(box), "s:meshresolution='lowres' xmlns:s='s'"));
  REQUIRE(rough.size() == 1);
  CHECK_THAT(rough.front(), Contains("the coarse mesh beside them is printed"));
  CHECK(notes(object(1, mesh_xml(box), "s:meshresolution='fullres' xmlns:s='s'")).empty());
  const auto draft = notes("<color id='3' value='#ff0000'/><material id='4' colorid='3'/>" +
                           object(1, mesh_xml(box), "materialid='4'"));
  REQUIRE(draft.size() == 1);
  CHECK_THAT(draft.front(), Contains("draft of 2013"));
}

TEST_CASE("a body that encloses no volume is left out with a note if others remain") {
  const TempFolder folder;
  const std::string flat =
      "<mesh><vertices><vertex x='50' y='0' z='0'/><vertex x='60' y='0' z='0'/><vertex x='50' y='9' z='0'/>"
      "</vertices><triangles><triangle v1='0' v2='1' v3='2'/></triangles></mesh>";
  const std::string objects = object(1, flat, "name='label'") + object(2, mesh_xml(box), "name='plate'");
  const auto p = part({write_3mf(folder, model_xml(objects, "<item objectid='1'/><item objectid='2'/>"))},
                      {"plate"}, 0.25);
  CHECK(p->extent().size() == Vec2(20, 10));
  REQUIRE(p->warnings().size() == 1);
  CHECK_THAT(p->warnings().front(), Contains("body 1 (\"label\")") && Contains("encloses no volume"));
  CHECK_THAT(refusal(write_3mf(folder, model_xml(objects, "<item objectid='1'/><item objectid='1'/>"))),
             Contains("body 1") && Contains("encloses no volume"));
}

TEST_CASE("a refusal of a mesh comes with the notes on what was not read") {
  const TempFolder folder;
  const auto file = write_3mf(folder, model_xml("<m:texture2dgroup id='7' texid='1'/>", ""));
  const auto noted = [](const auto& read) -> std::vector<std::string> {
    try {
      read();
    } catch (const NotedError& refusal) {
      return refusal.notes();
    }
    return {};
  };
  const auto of_part = noted([&] { part({file}, {"model"}); });
  REQUIRE(of_part.size() == 1);
  CHECK_THAT(of_part.front(), Contains("textures are not read"));
  CHECK(noted([&] { inspect_model({file}); }) == of_part);
}

TEST_CASE("facets in their body's colour under another name add nothing to the body's volume") {
  const TempFolder folder;
  const auto file =
      write_3mf(folder, model_xml("<basematerials id='5'><base name='one' displaycolor='#4080C0'/>"
                                  "<base name='other' displaycolor='#4080C0'/></basematerials>" +
                                      object(1, mesh_xml(box, {{0, "pid='5' p1='1'"}}), "pid='5' pindex='0'"),
                                  "<item objectid='1'/>"));
  const ModelContents contents = inspect_model({file});
  REQUIRE(contents.zones.size() == 1);
  CHECK(contents.zones.front().select == "#4080c0");
  CHECK(contents.zones.front().amount == Approx(600));
}

TEST_CASE("damaged and hostile packages are refused") {
  const TempFolder folder;
  std::string incomplete = mesh_xml(box);
  const auto corner = incomplete.find(" v3=");
  REQUIRE(corner != std::string::npos);
  incomplete.replace(corner, 4, " w3=");
  CHECK_THAT(refusal(write_3mf(folder, model_xml(object(1, incomplete), "<item objectid='1'/>"))),
             Contains("three corners"));
  CHECK_THAT(refusal(folder.write("model.3mf", "PK\x03\x04 and no more")), Contains("not a sound ZIP"));
  CHECK_THAT(refusal(folder.write("model.3mf", "")), Contains("3dmodel.model"));
  CHECK_THAT(refusal(write_zip(folder, "model.3mf", {{"readme.txt", "hello"}})), Contains("3dmodel.model"));
  CHECK_THAT(refusal(write_3mf(folder, "<model><resources>")), Contains("not well-formed"));
  CHECK_THAT(refusal(write_3mf(folder, model_xml("", ""))), Contains("no mesh"));
  CHECK_THAT(refusal(write_3mf(folder, model_xml("", "<item objectid='4'/>"))), Contains("object 4"));
  const std::string bad_corner =
      "<mesh><vertices><vertex x='0' y='0' z='0'/></vertices><triangles><triangle v1='0' "
      "v2='0' v3='7'/></triangles></mesh>";
  CHECK_THAT(refusal(write_3mf(folder, model_xml(object(1, bad_corner), "<item objectid='1'/>"))),
             Contains("vertex 7"));
  const std::string painted = mesh_xml(box, {{0, "paint_color='3'"}});
  CHECK_THAT(refusal(write_3mf(folder, model_xml(object(1, painted), "<item objectid='1'/>"))),
             Contains("paint"));
}

TEST_CASE("objects that contain themselves or double without end are refused") {
  const TempFolder folder;
  const std::string own = "<components><component objectid='1'/></components>";
  CHECK_THAT(refusal(write_3mf(folder, model_xml(object(1, own), "<item objectid='1'/>"))),
             Contains("without end"));
  std::string resources = object(1, mesh_xml(box));
  for (int id = 2; id < 30; ++id) {
    resources += object(
        id, fmt::format("<components><component objectid='{0}'/><component objectid='{0}'/></components>",
                        id - 1));
  }
  CHECK_THAT(refusal(write_3mf(folder, model_xml(resources, "<item objectid='29'/>"))),
             Contains("without end"));
}

TEST_CASE("an archive that unpacks to too much is refused before it fills the memory") {
  const TempFolder folder;
  const auto file = write_3mf(folder, std::string(std::size_t{520} << 20, ' '));
  CHECK(std::filesystem::file_size(file) < 1 << 20);
  CHECK_THAT(refusal(file), Contains("unpacks to more than 512 MiB"));
}
