// The books of a print while its chunks are made: figures, volumes, warnings, and from these the report and
// the pictures. mm³, s.
//
//   ChunkMaker maker(prepared);
//   Books books(maker, "plan", {.report = "out.json"});   // throws before anything is sent
//   …                                                     // the maker makes its chunks
//   books.write_report(extra);
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/engine/chunk_maker.hpp"
#include "host/report/deposit_check.hpp"
#include "host/report/layer_log.hpp"
#include "host/report/picture_writer.hpp"
#include "host/report/run_outputs.hpp"
#include "host/report/totals.hpp"

namespace unicursal::host {

/// A layer's entry in the report, while the layer is still being written or waited for.
struct LayerEntry;

class Books final : public ChunkListener {
 public:
  /// Opens the outputs and listens to `maker`, which must not have made a layer yet and must outlive this
  /// object. Throws core::DataError.
  Books(ChunkMaker& maker, std::string command, const RunOutputs& outputs);
  ~Books() override;
  Books(const Books&) = delete;
  Books& operator=(const Books&) = delete;

  /// From now on `check` learns what every layer is to be. It must outlive the last layer.
  void judge_with(DepositCheck& check) { check_ = &check; }

  const RunTotals& totals() const { return totals_; }
  const ChunkMaker& maker() const { return maker_; }
  /// The volumes that the feeders were commanded, by mixture.
  std::vector<MaterialVolume> fed() const;

  /// Waits for the last picture and, if a report was asked for, writes it with the keys of `extra` added.
  void write_report(const nlohmann::json& extra);

  void layer_made(PlannedLayer planned, const gcode::PlacedLayer& placed, const gcode::Chunk& chunk) override;
  void end_made(const gcode::Chunk& chunk) override;
  std::vector<std::string> warnings() const override;

 private:
  void count(const gcode::Chunk& chunk);
  void count_layers(const gcode::Chunk& chunk);
  void log_finished_layers(bool all);

  ChunkMaker& maker_;
  std::string command_;
  bool repeatable_;
  RunTotals totals_;
  std::unique_ptr<LayerLog> log_;
  std::map<std::size_t, LayerEntry> entries_;  ///< by layer, until they are complete and go to the log
  std::unique_ptr<PictureWriter> pictures_;
  DepositCheck* check_ = nullptr;
};

}  // namespace unicursal::host
