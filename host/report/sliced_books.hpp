// The books of a print of a slicer's G-code.
#pragma once

#include <string>

#include "host/engine/sliced_production.hpp"
#include "host/report/books.hpp"

namespace unicursal::host {

class SlicedBooks final : public Books, public RemixListener {
 public:
  /// Opens the outputs and listens to `production`, which must not have begun and must outlive this object.
  /// Throws core::DataError.
  SlicedBooks(SlicedProduction& production, std::string command, const RunOutputs& outputs);
  ~SlicedBooks() override;

  std::vector<IntendedMaterial> intended_materials() const override;
  std::string summary(const std::optional<Planning>& planning) const override;
  std::string summary(const DepositFindings& laid) const override;
  std::string summary(const MotionFindings& motion) const override;

  void chunk_made(const RemixedChunk& made) override;
  void end_made(const gcode::Chunk& chunk) override;

 private:
  double flow() const override { return production_.flow(); }
  nlohmann::json more() const override;

  SlicedProduction& production_;
  gcode::SeenMixing seen_;
  double left_out_ = 0;  ///< mm³ of the wipe tower
};

/// What the printer should lay of a layer: each bead as a rectangle, labelled by its material; those that the
/// finished part does not show have labels behind the `materials` ones (intended_materials()).
TargetLayer target_of(const gcode::WantedLayer& wanted, std::size_t materials);

}  // namespace unicursal::host
