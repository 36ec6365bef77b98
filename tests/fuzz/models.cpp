#include "tests/fuzz/models.hpp"

#include <zip.h>

#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/model/read_part.hpp"
#include "core/text/file_bytes.hpp"
#include "tests/fuzz/damage.hpp"

namespace unicursal::test {
namespace {

namespace fs = std::filesystem;

/// The corners of a box of 20 x 10 x 3 mm, and its sides with some attributes.
const std::string mesh =
    "<mesh><vertices><vertex x='0' y='0' z='0'/><vertex x='20' y='0' z='0'/><vertex x='0' y='10' z='0'/>"
    "<vertex x='20' y='10' z='0'/><vertex x='0' y='0' z='3'/><vertex x='20' y='0' z='3'/><vertex x='0' "
    "y='10' z='3'/>"
    "<vertex x='20' y='10' z='3'/></vertices><triangles><triangle v1='0' v2='2' v3='3'/><triangle v1='0' "
    "v2='3' v3='1'/>"
    "<triangle v1='4' v2='5' v3='7' pid='9' p1='1'/><triangle v1='4' v2='7' v3='6' paint_color='44483'/>"
    "<triangle v1='0' v2='1' v3='5'/><triangle v1='0' v2='5' v3='4'/><triangle v1='2' v2='6' v3='7'/>"
    "<triangle v1='2' v2='7' v3='3' slic3rpe:mmu_segmentation='0C'/><triangle v1='0' v2='4' v3='6'/>"
    "<triangle v1='0' v2='6' v3='2'/><triangle v1='1' v2='3' v3='7'/><triangle v1='1' v2='7' "
    "v3='5'/></triangles></mesh>";

const std::string model =
    "<model unit='millimeter'><resources><basematerials id='5'><base name='sky' "
    "displaycolor='#4080C0FF'/></basematerials>"
    "<colorgroup id='9'><color color='#FF0000FF'/><color color='#0000FF'/></colorgroup><object id='1' "
    "pid='5' pindex='0'>" +
    mesh +
    "</object><object id='2'><components><component objectid='1'/><component objectid='1' transform='-1 0 0 "
    "0 1 0 0 0 1 50 0 "
    "0'/></components></object></resources><build><item objectid='2'/><item objectid='1'/></build></model>";

const std::string settings =
    "<config><object id='2'><metadata key='extruder' value='2'/><part id='1' subtype='normal_part'><metadata "
    "key='name' "
    "value='left'/></part></object><object id='1'><volume firstid='0' lastid='11'><metadata "
    "key='volume_type' "
    "value='ParameterModifier'/></volume></object><plate><model_instance><metadata key='object_id' "
    "value='2'/>"
    "</model_instance></plate></config>";

void write(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

void write_package(const fs::path& file, const std::vector<std::pair<std::string, std::string>>& parts) {
  fs::remove(file);
  zip_t* archive = zip_open(file.c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
  if (!archive) throw std::runtime_error("no archive");
  for (const auto& [name, content] : parts)
    zip_file_add(archive, name.c_str(), zip_source_buffer(archive, content.data(), content.size(), 0), 0);
  if (zip_close(archive) != 0) throw std::runtime_error(zip_strerror(archive));
}

void read(const fs::path& file, const std::vector<std::string>& selects) {
  core::PartSource source;
  source.files = {file};
  source.layer_height = 0.2;
  for (const std::string& select : selects) source.zones.push_back({select, {}, source.zones.size()});
  const auto part = core::read_part(source);
  if (part->layer_count() == 0) return;
  part->layer(0);
  part->layer(part->layer_count() - 1);
}

}  // namespace

void package(const fs::path& folder, core::Random& random) {
  std::vector<std::pair<std::string, std::string>> parts{{"3D/3dmodel.model", model}};
  if (random.below(2) == 0) parts.emplace_back("Metadata/model_settings.config", settings);
  if (random.below(3) == 0)
    parts.emplace_back("Metadata/project_settings.config", R"({"filament_colour": ["#ff8000", "#0000ff"]})");
  const bool inside = random.below(4) != 0;
  if (inside) {
    auto& [name, content] = parts[random.below(parts.size())];
    content = damaged(content, random);
  }
  const fs::path file = folder / "model.3mf";
  write_package(file, parts);
  if (!inside) write(file, damaged(core::file_bytes(file), random));
  read(file, {"model.3mf"});
}

void wavefront(const fs::path& folder, core::Random& random) {
  const std::string materials = "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n";
  const std::string sound =
      "mtllib model.mtl\no left\nusemtl red\nv 0 0 0\nv 20 0 0 1 0 0\nv 0 10 0\nv 20 10 0\nv 0 0 3\nv 20 0 "
      "3\nv 0 10 3\nv 20 10 "
      "3\nf 1 3 4 2\nf -4/1/1 -3/1/1 -1/1/1 -2/1/1\nusemtl blue\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 "
      "6\n";
  const bool material = random.below(3) == 0;
  write(folder / "model.mtl", material ? damaged(materials, random) : materials);
  write(folder / "model.obj", material ? sound : damaged(sound, random));
  read(folder / "model.obj", {"model"});
}

void amf(const fs::path& folder, core::Random& random) {
  std::string vertices, triangles;
  for (int i = 0; i < 8; ++i) {
    vertices += "<vertex><coordinates><x>" + std::to_string(i % 2 * 20) + "</x><y>" +
                std::to_string(i / 2 % 2 * 10) + "</y><z>" + std::to_string(i / 4 * 3) +
                "</z></coordinates></vertex>";
  }
  for (const char* t : {"023", "031", "457", "476", "015", "054", "267", "273", "046", "062", "137", "175"}) {
    triangles +=
        std::string("<triangle><v1>") + t[0] + "</v1><v2>" + t[1] + "</v2><v3>" + t[2] + "</v3></triangle>";
  }
  const std::string sound =
      "<amf unit='millimeter'><material id='1'><color><r>1</r><g>0</g><b>0.5</b></color></material><object "
      "id='1'><mesh>"
      "<vertices>" +
      vertices + "</vertices><volume materialid='1'>" + triangles +
      "</volume></mesh></object><constellation id='2'><instance "
      "objectid='1'><deltax>5</deltax><rz>90</rz></instance>"
      "</constellation></amf>";
  write(folder / "model.amf", damaged(sound, random));
  read(folder / "model.amf", {"model"});
}

}  // namespace unicursal::test
