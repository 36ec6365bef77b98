// A slicer's G-code whose tools are mixtures: it is remixed ahead of the nozzle.
#pragma once

#include <cstddef>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "firmware_gcode/remix/remix.hpp"
#include "host/engine/prepared_sliced.hpp"
#include "host/engine/production.hpp"
#include "host/engine/remix_ahead.hpp"

namespace unicursal::host {

/// Hears of everything that a sliced production makes, on the thread of the source's caller. The layers that
/// end in a chunk come before the chunk's first line is sent.
class RemixListener {
 public:
  virtual ~RemixListener() = default;
  virtual void chunk_made(const RemixedChunk& made) = 0;
  virtual void end_made(const gcode::Chunk& chunk) = 0;
};

class SlicedProduction final : public Production {
 public:
  /// Writes the start. Throws core::DataError.
  explicit SlicedProduction(PreparedSliced prepared);
  ~SlicedProduction() override;

  const Job& job() const override { return prepared_.job; }
  std::size_t layers() const override { return prepared_.survey.layers; }
  std::optional<LayerRange> range() const override { return std::nullopt; }
  core::Box extent() const override { return prepared_.survey.extent; }
  /// On average, since every bead has its own.
  double flow() const override;
  void check() const override {}
  void check_made() const override {}
  void begin(const std::shared_ptr<Clock>& clock, const SpoolExtent& kept) override;
  KeptSource& open(const SpoolExtent& kept) override;
  void catch_up(const Spool& spool) override;
  /// Lines that were remixed ahead are not layers yet.
  void on_planned(std::function<void(const gcode::PlacedLayer&)>) override {}
  AskedMaterials asked() const override;
  std::vector<std::string> late_warnings() const override { return late_warnings_; }
  std::optional<Planning> planning() const override { return std::nullopt; }

  const PreparedSliced& prepared() const { return prepared_; }
  const gcode::Chunk& start() const { return start_; }
  gcode::Mixture intended(std::size_t material) const { return remix_.intended(material); }
  /// Before begin(). One at a time; null: none. It must outlive the source's calls.
  void listen(RemixListener* listener);

 private:
  class Steps;

  const PreparedSliced prepared_;
  std::ifstream file_;
  gcode::Remix remix_;
  gcode::Chunk start_;
  std::vector<std::string> late_warnings_;
  RemixListener* listener_ = nullptr;
  RemixAhead ahead_;
  bool begun_ = false;         ///< `ahead_` works, or has nothing to do
  std::stop_source unwanted_;  ///< nobody wants it to catch up any more
  std::unique_ptr<Steps> source_;
};

}  // namespace unicursal::host
