#include "host/report/planned_books.hpp"

#include <algorithm>

#include "core/model/hanging.hpp"
#include "core/model/read_part.hpp"
#include "host/report/summary.hpp"
#include "host/report/target.hpp"

namespace unicursal::host {
namespace {

nlohmann::json layer_entry(const PlannedLayer& planned, const gcode::PlacedLayer& layer) {
  nlohmann::json entry = to_json(measure(planned));
  entry["layer"] = planned.layer.index;
  entry["top_mm"] = layer.top;
  entry["height_mm"] = layer.height;
  if (planned.effort < 1) entry["effort"] = planned.effort;
  return entry;
}

nlohmann::json to_json(const std::vector<core::HangingPlace>& places) {
  nlohmann::json list = nlohmann::json::array();
  for (const core::HangingPlace& place : places) {
    nlohmann::json entry = {
        {"kind", word(place.kind)}, {"layer", place.layer}, {"layers", place.layers}, {"z_mm", place.z}};
    if (place.kind != core::HangingPlace::Kind::empty_layers)
      entry.update({{"x_mm", place.place.x()}, {"y_mm", place.place.y()}, {"area_mm2", place.area}});
    list.push_back(std::move(entry));
  }
  return list;
}

/// Slices the layers of the print once more, which takes little beside their planning.
std::vector<core::HangingPlace> places_in_the_air(const PreparedJob& prepared) {
  if (!is_plate(prepared.job) && core::is_drawing_file(prepared.job.source.files.front()))
    return {};  // all layers are alike
  core::HangingCheck check(prepared.job.bead_width);
  for (std::size_t i = 0; i < prepared.count; ++i) check.add(prepared.part->layer(prepared.first + i));
  return check.places();
}

}  // namespace

PlannedBooks::PlannedBooks(ChunkMaker& maker, std::string command, const RunOutputs& outputs)
    : Books(maker.prepared().job, std::move(command), outputs), maker_(maker) {
  const PreparedJob& prepared = maker.prepared();
  if (outputs.pictures) pictures_ = std::make_unique<PictureWriter>(*outputs.pictures, curve_style(prepared));
  const std::vector<gcode::Material>& materials = prepared.job.print.materials;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    totals_.materials.push_back({materials[i].name, materials[i].mixture, maker.encoder().intended(i)});
  }
  count(maker.start());
  maker.listen(this);
}

PlannedBooks::~PlannedBooks() {
  maker_.listen(nullptr);
}

std::vector<IntendedMaterial> PlannedBooks::intended_materials() const {
  return host::intended_materials(maker_.prepared(), maker_.encoder());
}

std::string PlannedBooks::summary(const std::optional<Planning>& planning) const {
  return host::summary(totals_, planning ? planning->effort : PlanningEffort{});
}

std::optional<PicturePlace> PlannedBooks::place_of_curves() const {
  if (!pictures_) return std::nullopt;
  PicturePlace place = pictures_->place();
  place.corner += maker_.prepared().offset;
  return place;
}

void PlannedBooks::layer_made(PlannedLayer planned, const gcode::PlacedLayer& placed,
                              const gcode::Chunk& chunk) {
  ++totals_.layers;
  add_layer(totals_.materials, placed, maker_.prepared().frame.zone_materials);
  totals_.figures += measure(planned);
  if (planned.effort < 1) ++totals_.hurried_layers;
  totals_.least_effort = std::min(totals_.least_effort, planned.effort);
  if (check() != nullptr) check()->expect(target_of(maker_.prepared(), planned, placed));
  if (has_log()) {
    nlohmann::json entry = layer_entry(planned, placed);
    if (repeatable()) forget_times(entry);
    describe(placed.index, std::move(entry));
  }
  if (pictures_) pictures_->draw(std::move(planned));
  count(chunk);
  log_finished_layers(false);
}

void PlannedBooks::end_made(const gcode::Chunk& chunk) {
  count(chunk);
  log_finished_layers(true);
}

std::vector<std::string> PlannedBooks::warnings() const {
  if (pictures_ && pictures_->problem()) return {*pictures_->problem()};
  return {};
}

double PlannedBooks::flow() const {
  return maker_.flow();  // an automatic one is known when the first layer comes out of the encoder
}

void PlannedBooks::end_pictures() {
  if (pictures_) pictures_->finish();
}

nlohmann::json PlannedBooks::more() const {
  nlohmann::json figures = to_json(totals_.figures);
  if (repeatable()) forget_times(figures);
  return {
      {"warnings", maker_.warnings()},
      {"bare", maker_.bare().to_json()},
      {"in_the_air", to_json(places_in_the_air(maker_.prepared()))},
      {"bead_width_mm", maker_.prepared().job.bead_width},
      {"layer_height_mm", maker_.prepared().job.source.layer_height},
      {"totals", figures},
      {"estimated_laying_seconds", maker_.encoder().laying_seconds()},
      {"effort", {{"hurried_layers", totals_.hurried_layers}, {"least", totals_.least_effort}}},
  };
}

}  // namespace unicursal::host
