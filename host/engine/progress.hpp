// How far a print has come: the layer, the seconds left and the percentage, from the chunks that are sent.
// Pure arithmetic: no printer, no clock, no files. s of printing as the time model estimates them; layers are
// counted from 0 unless stated otherwise.
//
//   Progress progress;
//   progress.begin_chunk(chunk, flow);      // its first line is about to be sent
//   progress.sent(0.5);                     // half of its lines are sent
//   progress.end_chunk();
//   show(progress.percent(ahead, false));
//
// A resumed print first repeats lines that an earlier session has kept (replay()), then sends new chunks. An
// object belongs to one thread.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "firmware_gcode/print/chunk.hpp"
#include "host/lookahead/planned_layer.hpp"

namespace unicursal::host {

/// What is known about the layers that are not sent yet.
struct Ahead {
  std::size_t layers = 0;  ///< of the whole print
  Waiting waiting;         ///< layers that are planned and not yet in a chunk
  /// s that the layers from `begin` up to, but without, `end` are expected to take; nullopt while unknown.
  std::function<std::optional<double>(std::size_t begin, std::size_t end)> foretold;
};

class Progress {
 public:
  /// A print from its first line on.
  Progress() = default;
  /// A print that goes on, of which the spool holds the first `layers_kept` layers.
  static Progress resumed(std::size_t layers_kept);

  /// A kept line was repeated: `layers_begun` layers precede its own, of which `fraction` (0…1) is sent.
  void replay(std::size_t layers_begun, double fraction);
  /// All kept lines were repeated; new chunks follow.
  void end_replay();

  /// `flow`, mm³/s: the rate at which the chunk's prime volume is laid; 0 if unknown.
  void begin_chunk(const gcode::Chunk& chunk, double flow);
  /// `fraction`, 0…1: the share of the chunk's lines that are sent. Precondition: a chunk has begun.
  void sent(double fraction);
  void end_chunk();

  /// Whether the nozzle may stand where plastic was laid.
  bool has_laid() const { return layers_kept_ > 0 || seconds_sent_ > 0; }
  /// Whether a layer has begun.
  bool has_begun() const;
  /// The layer that is being sent, counted from 1 and at most `layers`; 0 before the first.
  std::size_t layer(std::size_t layers) const;
  /// The share of the lines at hand (chunk or kept chunk) that is sent, 0…1.
  double fraction() const { return fraction_; }
  /// s of the chunk's lines that are not sent yet.
  double chunk_seconds_left() const { return chunk_seconds_ * (1 - fraction_); }
  /// s until the print ends. Layers that are not sent yet are expected to take their foretold time, stretched
  /// by the ratio that the layers sent so far took; without a forecast, as long as the known layers on
  /// average.
  double seconds_left(const Ahead& ahead) const;
  /// Per cent of the printing time. Never falls from call to call, although a layer may take longer than
  /// foretold. `done`: the print is complete.
  double percent(const Ahead& ahead, bool done) const;

 private:
  void measure_layers(const gcode::Chunk& chunk, double flow);
  void note_ends(const gcode::Chunk& chunk);
  std::size_t layers_ended_in_chunk() const;

  bool resumed_ = false;
  /// Layers that have ended when this chunk has been sent. The chunk after kept ones ends a layer of theirs.
  std::size_t layers_done_ = 0;
  std::size_t measured_from_ = 1;  ///< the first layer that is measured whole
  std::size_t layers_kept_ = 0;    ///< in the spool when this session began
  bool replaying_ = false;         ///< the lines that are sent come from the spool
  std::size_t layers_begun_ = 0;   ///< layers before the one that is being sent
  double fraction_ = 0;            ///< of the lines at hand that is sent
  double seconds_sent_ = 0;        ///< of the chunks before this one
  std::size_t layers_sent_ = 0;    ///< layers that ended in the chunks before this one
  double chunk_seconds_ = 0;       ///< of the chunk that is being sent
  std::vector<gcode::LayerShare> chunk_layers_;
  double unfinished_seconds_ = 0;  ///< sent or being sent, of a layer that ends in a later chunk
  double measured_seconds_ = 0;    ///< of the layers that have ended, without the print's first
  mutable double highest_percent_ = 0;
};

}  // namespace unicursal::host
