// What slicers add to a 3MF file: which filament prints a part, parts that are cut out or only change the
// filament, the colours of the filaments, and which objects stand on which plate. Sources: the classes
// _3MF_Importer of PrusaSlicer 2.8 (Metadata/Slic3r_PE_model.config, Slic3r_PE.config) and _BBS_3MF_Importer
// of OrcaSlicer 2.2 (Metadata/model_settings.config, project_settings.config).
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/model/mesh_model.hpp"
#include "core/model/zip_archive.hpp"

namespace unicursal::core {

struct ProjectPart {
  std::string name;
  std::size_t filament = 0;  ///< from 1 on; 0: that of the object
  BodyRole role = BodyRole::solid;
  bool printed = true;  ///< false: it only marks where supports go
};

/// A range of an object's triangles, both ends included (PrusaSlicer).
struct ProjectVolume {
  std::size_t first = 0, last = 0;
  ProjectPart part;
};

struct ProjectObject {
  std::string name;
  std::size_t filament = 0;            ///< from 1 on; 0: none is named
  std::vector<ProjectVolume> volumes;  ///< PrusaSlicer
  std::map<std::size_t, ProjectPart>
      parts;  ///< by the id of the component's object (Bambu Studio, OrcaSlicer)
};

struct SlicerProject {
  std::map<std::size_t, ProjectObject> objects;  ///< by the object's id
  std::vector<std::string> colours;              ///< of filament 1 and so on, "#rrggbb" or empty
  /// Objects of each plate, if the project has several; an object is named by its id and the number of its
  /// instance.
  std::vector<std::set<std::pair<std::size_t, std::size_t>>> plates;

  Tint tint(std::size_t filament) const;
};

/// Returns nullopt if no slicer wrote the archive. `file` is for messages. Throws ModelError.
std::optional<SlicerProject> slicer_project(ZipArchive& archive, const std::string& file);

}  // namespace unicursal::core
