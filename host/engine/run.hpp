// One print from its planned layers to its chunks, with the books kept: figures, volumes, report, pictures.
// The same for a file, a simulator and a printer. mm³, s.
//
//   Run run(prepared, "plan", {.report = "out.json"});   // throws before anything is sent
//   use(run.start());
//   while (auto layer = lookahead.wait()) use(run.layer(std::move(*layer)));   // what has become certain
//   use(run.rest());
//   use(run.finish());
//   run.write_report(extra);
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "firmware_gcode/toolpath/encoder.hpp"
#include "host/engine/prepared_job.hpp"
#include "host/report/deposit_check.hpp"
#include "host/report/layer_log.hpp"
#include "host/report/picture_writer.hpp"
#include "host/report/totals.hpp"

namespace unicursal::host {

struct RunOutputs {
  std::optional<std::filesystem::path> report;    ///< JSON
  std::optional<std::filesystem::path> pictures;  ///< folder
  bool repeatable = false;  ///< leave out of the report what was measured of this computer
};

/// Of the report, while its layer is still being written or waited for.
struct LayerEntry;

class Run {
 public:
  /// Encodes the start and opens the outputs. `prepared` must outlive this object. Throws core::DataError.
  Run(const PreparedJob& prepared, std::string command, const RunOutputs& outputs);
  ~Run();

  const gcode::Chunk& start() const { return start_; }
  /// From now on tells `check` what every layer is to be. It must outlive the last layer.
  void tell(DepositCheck& check) { check_ = &check; }
  gcode::Chunk layer(PlannedLayer planned);
  /// What was withheld, after the last layer.
  gcode::Chunk rest();
  /// The same for a layer that was planned in an earlier run, of which only the bead paths are left: neither
  /// figures nor pictures.
  gcode::Chunk replay(const gcode::PlacedLayer& layer);
  gcode::Chunk finish();

  /// mm³/s that is held; where the speed is constant, what that comes to at the job's bead width.
  double flow() const;
  const PreparedJob& prepared() const { return prepared_; }
  const RunTotals& totals() const { return totals_; }
  const gcode::Encoder& encoder() const { return encoder_; }
  /// What the feeders were told, by mixture.
  std::vector<MaterialVolume> fed() const;
  /// What was odd: of the job, the part and the run, one sentence each.
  std::vector<std::string> warnings() const;

  /// Waits for the last picture and writes the report, with the keys of `extra` added, if one was asked for.
  void write_report(const nlohmann::json& extra);

 private:
  gcode::Chunk encoded(const gcode::PlacedLayer& layer);
  void count(const gcode::Chunk& chunk);
  void count_layers(const gcode::Chunk& chunk);
  void log_finished_layers(bool all);

  const PreparedJob& prepared_;
  std::string command_;
  bool repeatable_;
  gcode::Encoder encoder_;
  gcode::Chunk start_;
  RunTotals totals_;
  std::vector<std::string> encoding_warnings_;
  std::unique_ptr<LayerLog> log_;
  std::map<std::size_t, LayerEntry> entries_;  ///< of the log, by layer, until they are whole
  std::unique_ptr<PictureWriter> pictures_;
  DepositCheck* check_ = nullptr;
};

/// The greatest memory that this process has held, MiB; 0 where the system does not tell.
double peak_memory();

/// The layer's zones on the bed, labelled by material.
TargetLayer target_of(const PreparedJob& prepared, const PlannedLayer& planned);

/// What the firmware will really mix.
std::vector<IntendedMaterial> intended_materials(const PreparedJob& prepared, const gcode::Encoder& encoder);

/// How the curves of this job are drawn.
CurveStyle curve_style(const PreparedJob& prepared);

}  // namespace unicursal::host
