// The books of a print while its chunks are made: figures, volumes, warnings, and from these the report. What
// is particular to how the chunks are made is in the classes that derive from it (open_books.hpp). mm³, s.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/engine/production.hpp"
#include "host/report/deposit_check.hpp"
#include "host/report/layer_log.hpp"
#include "host/report/motion_findings.hpp"
#include "host/report/run_outputs.hpp"
#include "host/report/totals.hpp"

namespace unicursal::host {

/// A layer's entry in the report, while the layer is still being written or waited for.
struct LayerEntry {
  nlohmann::json json;
  double volume = 0, seconds = 0;
  bool written = false;  ///< all its lines are in chunks
  std::optional<gcode::LayerMixing> mixing;
};

class Books {
 public:
  virtual ~Books() = default;
  Books(const Books&) = delete;
  Books& operator=(const Books&) = delete;

  /// From now on `check` learns what every layer is to be. It must outlive the last layer.
  void judge_with(DepositCheck& check) { check_ = &check; }
  /// What the printer is to mix, for such a check.
  virtual std::vector<IntendedMaterial> intended_materials() const = 0;

  const RunTotals& totals() const { return totals_; }
  const Job& job() const { return job_; }
  /// The volumes that the feeders were commanded, by mixture.
  std::vector<MaterialVolume> fed() const;
  /// Layers, material and times for a terminal, a line each.
  virtual std::string summary(const std::optional<Planning>& planning) const = 0;
  /// Gaps, heights and mixtures of what was laid.
  virtual std::string summary(const DepositFindings& laid) const;
  /// Speed, flow, travels and starvations.
  virtual std::string summary(const MotionFindings& motion) const;

  /// Where pictures of curves lie; absent if none are drawn.
  virtual std::optional<PicturePlace> place_of_curves() const { return std::nullopt; }
  /// Waits for the last picture and, if a report was asked for, writes it with the keys of `extra` added.
  void write_report(const nlohmann::json& extra);

 protected:
  /// Opens the report. Throws core::DataError.
  Books(const Job& job, std::string command, const RunOutputs& outputs);

  /// mm³/s that is held.
  virtual double flow() const = 0;
  /// Before the report is written.
  virtual void end_pictures() {}
  /// The keys of a report that only such a print has.
  virtual nlohmann::json more() const = 0;

  void count(const gcode::Chunk& chunk);
  /// The layer's entry in the report begins with these keys. Only with has_log().
  void describe(std::size_t layer, nlohmann::json entry);
  bool has_log() const { return log_ != nullptr; }
  bool repeatable() const { return repeatable_; }
  DepositCheck* check() const { return check_; }
  /// Logs complete layers in order; with `all`, after a stop, also incomplete ones.
  void log_finished_layers(bool all);

  RunTotals totals_;

 private:
  void count_layers(const gcode::Chunk& chunk);

  const Job& job_;
  std::string command_;
  bool repeatable_;
  std::unique_ptr<LayerLog> log_;
  std::map<std::size_t, LayerEntry> entries_;  ///< by layer, until they are complete and go to the log
  DepositCheck* check_ = nullptr;
};

/// Removes planning times, which differ from run to run.
void forget_times(nlohmann::json& figures);

}  // namespace unicursal::host
