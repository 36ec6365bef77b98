// Judges the layers of a dry run while it runs: planned layers come from one side, rasters of what was laid
// from the other, as a stream. Memory holds the layers that have been planned and not yet laid, and one
// raster.
//
//   DepositCheck check(materials, pictures, filaments);
//   check.watch(descriptor);        // reads in a thread of its own
//   check.expect(target);           // before the layer's first line is sent
//   check.finish();                 // when the simulator has ended
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "host/report/deposit_judge.hpp"

namespace unicursal::host {

class DepositCheck {
 public:
  /// `materials`: as the printer is to mix them. `pictures`: an existing folder for gaps-NNNN.png and
  /// mixtures-NNNN.png; older ones in it are removed.
  DepositCheck(std::vector<IntendedMaterial> materials, std::optional<std::filesystem::path> pictures,
               const picture::Filaments& filaments);
  /// Waits for the end of the stream.
  ~DepositCheck();
  DepositCheck(const DepositCheck&) = delete;
  DepositCheck& operator=(const DepositCheck&) = delete;

  /// Takes the descriptor over. Once.
  void watch(int descriptor);
  void expect(TargetLayer target);
  /// Waits for the end of the stream, which comes when the simulator ends.
  void finish();

  // After finish():
  const DepositFindings& total() const { return total_; }
  /// The layers that were laid, also unfinished ones, with their findings.
  nlohmann::json to_json() const;
  /// At most three.
  std::vector<WorstPlace> worst() const;
  /// Each layer that was laid, with its findings.
  const std::map<std::size_t, DepositFindings>& layers() const { return layers_; }
  struct Drawn {
    double top = 0, height = 0;  ///< of the layer; top above the bed
    PicturePlace place;          ///< of both pictures
  };
  /// The layers whose pictures were drawn.
  const std::map<std::size_t, Drawn>& drawn() const { return drawn_; }
  /// Why judging ended early, if it did.
  const std::optional<std::string>& problem() const { return problem_; }

 private:
  void read_all(int descriptor);
  void take(const sim::RasterFrame& frame, sim::RasterReader& reader);
  std::optional<TargetLayer> target_at(double z);
  void write_pictures(const TargetLayer& target, const JudgedLayer& layer);

  std::vector<IntendedMaterial> materials_;
  std::optional<std::filesystem::path> pictures_;
  picture::Filaments filaments_;
  std::mutex mutex_;  ///< guards expected_
  std::vector<TargetLayer> expected_;
  std::map<std::size_t, DepositFindings> layers_;
  std::map<std::size_t, Drawn> drawn_;
  std::vector<WorstPlace> worst_;  ///< of each layer
  DepositFindings total_;
  std::optional<std::string> problem_;
  std::thread thread_;
};

}  // namespace unicursal::host
