// A job whose layers are planned ahead of the nozzle.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/engine/chunk_maker.hpp"
#include "host/engine/prepared_job.hpp"
#include "host/engine/production.hpp"
#include "host/lookahead/lookahead.hpp"

namespace unicursal::host {

class PlannedProduction final : public Production {
 public:
  /// Encodes the start. Throws core::DataError.
  explicit PlannedProduction(PreparedJob prepared);

  const Job& job() const override { return prepared_.job; }
  std::size_t layers() const override { return prepared_.count; }
  std::optional<LayerRange> range() const override { return prepared_.layers; }
  core::Box extent() const override { return prepared_.frame.extent; }
  double flow() const override { return maker_.flow(); }
  void check() const override { check_beginning(prepared_); }
  void check_made() const override { check_bare(maker_.bare(), prepared_.job); }
  void begin(const std::shared_ptr<Clock>& clock, const SpoolExtent& kept) override;
  /// As begin(), for planning with another clock or pace.
  void plan(const LookaheadOptions& options) { lookahead_.emplace(*prepared_.part, options); }
  KeptSource& open(const SpoolExtent& kept) override;
  void catch_up(const Spool& spool) override;
  void on_planned(std::function<void(const gcode::PlacedLayer&)> viewer) override;
  AskedMaterials asked() const override;
  std::vector<std::string> late_warnings() const override { return maker_.late_warnings(); }
  std::optional<Planning> planning() const override;

  const PreparedJob& prepared() const { return prepared_; }
  ChunkMaker& maker() { return maker_; }

 private:
  const PreparedJob prepared_;
  ChunkMaker maker_;
  std::optional<Lookahead> lookahead_;  ///< from begin() on
  std::optional<PlannedSource> source_;
};

}  // namespace unicursal::host
