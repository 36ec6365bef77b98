// The books of a print whose curves are planned: their figures, and pictures of them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "host/engine/chunk_maker.hpp"
#include "host/report/books.hpp"
#include "host/report/picture_writer.hpp"

namespace unicursal::host {

class PlannedBooks final : public Books, public ChunkListener {
 public:
  /// Opens the outputs and listens to `maker`, which must not have made a layer yet and must outlive this
  /// object. Throws core::DataError.
  PlannedBooks(ChunkMaker& maker, std::string command, const RunOutputs& outputs);
  ~PlannedBooks() override;

  std::vector<IntendedMaterial> intended_materials() const override;
  using Books::summary;
  std::string summary(const std::optional<Planning>& planning) const override;

  std::optional<PicturePlace> place_of_curves() const override;

  void layer_made(PlannedLayer planned, const gcode::PlacedLayer& placed, const gcode::Chunk& chunk) override;
  void end_made(const gcode::Chunk& chunk) override;
  std::vector<std::string> warnings() const override;

 private:
  double flow() const override;
  void end_pictures() override;
  nlohmann::json more() const override;

  ChunkMaker& maker_;
  std::unique_ptr<PictureWriter> pictures_;
};

}  // namespace unicursal::host
