// From planned layers to chunks: places each layer on the bed and encodes it. The same for a file, a
// simulator and a printer.
//
//   ChunkMaker maker(prepared);
//   use(maker.start());
//   while (auto layer = lookahead.wait()) use(maker.layer(std::move(*layer)).chunk);
//   use(maker.rest());
//   use(maker.finish());
#pragma once

#include <string>
#include <vector>

#include "firmware_gcode/toolpath/encoder.hpp"
#include "host/engine/bare_watch.hpp"
#include "host/engine/prepared_job.hpp"

namespace unicursal::host {

/// Hears of everything that a chunk maker makes. Called on its caller's thread.
class ChunkListener {
 public:
  virtual ~ChunkListener() = default;
  /// `placed` is the planned layer on the bed. `chunk` holds what has become certain, often of earlier
  /// layers.
  virtual void layer_made(PlannedLayer planned, const gcode::PlacedLayer& placed,
                          const gcode::Chunk& chunk) = 0;
  /// What was withheld, or the end of the print.
  virtual void end_made(const gcode::Chunk& chunk) = 0;
  /// Sentences for a person about the listener's own work.
  virtual std::vector<std::string> warnings() const = 0;
};

/// Throws core::DataError if too much of the layers so far stays without plastic and the job does not allow
/// it.
void check_bare(const BareWatch& bare, const Job& job);

class ChunkMaker {
 public:
  struct Made {
    gcode::PlacedLayer layer;
    gcode::Chunk chunk;  ///< what has become certain, often of earlier layers
  };

  /// Encodes the start. `prepared` must outlive this object. Throws core::DataError.
  explicit ChunkMaker(const PreparedJob& prepared);
  /// From now on. One at a time; null: none. It must outlive the calls below.
  void listen(ChunkListener* listener) { listener_ = listener; }

  const gcode::Chunk& start() const { return start_; }
  /// Throws core::DataError if the first layer stays mostly without plastic and the job does not allow it.
  Made layer(PlannedLayer planned);
  /// The chunk of a layer that was planned by an earlier run, of which only the bead paths are left. The
  /// listener does not hear of it.
  gcode::Chunk replay(const gcode::PlacedLayer& layer);
  /// What was withheld, after the last layer.
  gcode::Chunk rest();
  gcode::Chunk finish();

  /// mm³/s that is held; if the speed is held instead, what it comes to at the job's bead width.
  double flow() const;
  const PreparedJob& prepared() const { return prepared_; }
  const gcode::Encoder& encoder() const { return encoder_; }
  /// What the layers so far leave without plastic.
  const BareWatch& bare() const { return bare_; }
  /// About the job, the part and the print, one sentence each.
  std::vector<std::string> warnings() const;
  /// Those of warnings() that became known while layers were made.
  std::vector<std::string> late_warnings() const;

 private:
  void note_warnings(const gcode::Chunk& chunk);
  gcode::Chunk ended(gcode::Chunk chunk);

  const PreparedJob& prepared_;
  gcode::Encoder encoder_;
  gcode::Chunk start_;
  BareWatch bare_;
  std::vector<std::string> warnings_;  ///< of the encoder
  ChunkListener* listener_ = nullptr;
};

}  // namespace unicursal::host
