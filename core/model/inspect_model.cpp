#include "core/model/inspect_model.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <utility>

#include "core/error.hpp"
#include "core/model/drawing_part.hpp"
#include "core/model/mesh_bodies.hpp"
#include "core/model/noted_error.hpp"
#include "core/model/read_part.hpp"
#include "core/model/zoning.hpp"

namespace unicursal::core {
namespace {

/// Zones that are offered, each select once.
class Offers {
 public:
  void add(const ZoneOffer& offer) {
    const auto [known, added] = index_.try_emplace(offer.select, zones_.size());
    if (added) {
      zones_.push_back(offer);
    } else {
      zones_[known->second].amount += offer.amount;
      zones_[known->second].paint = zones_[known->second].paint && offer.paint;
    }
  }
  std::vector<ZoneOffer> take() { return std::move(zones_); }

 private:
  std::vector<ZoneOffer> zones_;
  std::map<std::string, std::size_t> index_;
};

std::string tint_select(const Tint& tint) {
  return tint.colour.empty() && !tint.names.empty() ? tint.names.front() : tint.colour;
}

/// One zone for each colour or material if the files name any, else for each body, or for the whole file.
std::vector<ZoneOffer> zones_of(const std::vector<MendedBody>& bodies) {
  std::map<std::string, std::size_t> uses;  // of a body's own name
  std::size_t solids = 0;
  bool tinted = false;
  for (const MendedBody& body : bodies) {
    if (body.role == BodyRole::negative) continue;
    if (body.role == BodyRole::solid) ++solids;
    if (!body.name.names.empty()) ++uses[body.name.names.front()];
    tinted = tinted || !tint_select(body.name.tint).empty();
  }
  Offers offers;
  for (const MendedBody& body : bodies) {
    const std::string tint = tint_select(body.name.tint);
    if (body.role == BodyRole::negative || (body.role == BodyRole::modifier && tint.empty())) continue;
    std::string select = tint;
    if (select.empty()) {
      const bool unique = !body.name.names.empty() && uses[body.name.names.front()] == 1;
      select = unique ? body.name.names.front() : body.name.number;
      if (solids == 1 && !tinted) select = body.name.file.filename().string();
    }
    offers.add({select, body.name.tint.colour, volume(body.mesh), false, std::nullopt});
    for (std::size_t i = 0; i < body.shells.size(); ++i) {
      const std::string paint = tint_select(body.paints[i]);
      // The same colour under another name is counted with the body. Shells in hollows can turn over.
      if (!body.shells[i].facets.empty() && paint != select)
        offers.add({paint, body.paints[i].colour, std::max(0.0, volume(body.shells[i])), true, std::nullopt});
    }
  }
  return offers.take();
}

ModelContents contents_of_meshes(const std::vector<std::filesystem::path>& files, double paint_depth,
                                 Warnings& warnings) {
  std::vector<MendedBody> bodies;
  BodyOptions options;
  options.paint_depth = paint_depth;
  options.shells_are_bodies = files.size() == 1;
  for (const auto& file : files) add_bodies(bodies, file, options, warnings);
  ModelContents contents;
  Eigen::AlignedBox3d box;
  for (const MendedBody& body : bodies) {
    contents.facets += body.mesh.facets.size();
    if (body.role != BodyRole::solid) continue;
    ++contents.bodies;
    for (const auto& facet : body.mesh.facets) {
      for (const auto v : facet) box.extend(body.mesh.vertices[v]);
    }
  }
  contents.size = box.sizes();
  contents.zones = zones_of(bodies);
  contents.notes = warnings.sentences();
  return contents;
}

ModelContents contents_of_drawing(const std::filesystem::path& file, Warnings& warnings) {
  const Drawing drawing = read_drawing(file, warnings);
  ModelContents contents;
  contents.drawing = true;
  std::vector<Painted> painted;
  std::vector<std::string> fills;
  for (const Shape& shape : drawing.shapes) {
    auto known = std::find(fills.begin(), fills.end(), shape.fill);
    if (known == fills.end()) known = fills.insert(fills.end(), shape.fill);
    painted.push_back({shape.region, std::size_t(known - fills.begin()), shape.fill});
  }
  std::vector<Polygon> outlines;
  std::vector<double> areas(fills.size(), 0);
  for (const Island& island : zoned(painted).islands) {
    outlines.push_back(island.outline);
    contents.holes += island.outline.holes.size();
    for (const ZoneRegion& region : island.zones) areas[region.zone] += area(region.polygons);
  }
  if (outlines.empty()) {
    throw ModelError(file.string(), "", "the drawing's shapes are too small to print",
                     "check its width and height");
  }
  contents.bodies = outlines.size();
  contents.size.head<2>() = bounds(outlines).size();
  for (std::size_t i = 0; i < fills.size(); ++i) {
    if (!(areas[i] > 0)) continue;
    ZoneOffer offer{fills[i], fills[i].starts_with('#') ? fills[i] : "", areas[i], false, std::nullopt};
    const auto gradient = std::find_if(drawing.gradients.begin(), drawing.gradients.end(),
                                       [&](const DrawnGradient& g) { return g.fill == fills[i]; });
    if (gradient != drawing.gradients.end()) offer.gradient = *gradient;
    contents.zones.push_back(std::move(offer));
  }
  contents.notes = warnings.sentences();
  return contents;
}

}  // namespace

ModelContents inspect_model(const std::vector<std::filesystem::path>& files, double paint_depth) {
  const bool drawing = files.size() == 1 && is_drawing_file(files.front());
  for (const auto& file : files) {
    if (!drawing && (is_drawing_file(file) || !is_model_file(file))) {
      throw ModelError(file.string(), "", "this is not one of the files that make a part",
                       "name one .svg file, or some .stl, .3mf, .obj and .amf files");
    }
  }
  Warnings warnings;
  try {
    return drawing ? contents_of_drawing(files.front(), warnings)
                   : contents_of_meshes(files, paint_depth, warnings);
  } catch (const ModelError& refusal) {
    throw NotedError(refusal, warnings.sentences());
  }
}

}  // namespace unicursal::core
