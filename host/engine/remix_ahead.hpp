// Remixes a slicer's file ahead of the nozzle, in a thread of its own: reading a file may block. What waits
// is bounded by seconds of printing, chunks and lines, so memory does not grow with the file.
//
//   RemixAhead ahead(remix);
//   ahead.begin();
//   while (auto made = ahead.wait()) use(made->chunk);
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "firmware_gcode/remix/remix.hpp"
#include "host/lookahead/planned_layer.hpp"

namespace unicursal::host {

/// A chunk with the layers that end in it, which are known only if the remix listens.
struct RemixedChunk {
  gcode::Chunk chunk;
  std::vector<gcode::WantedLayer> wanted;
  gcode::SeenMixing seen;  ///< of all chunks up to this one
  double left_out = 0;     ///< mm³ of the wipe tower, likewise
};

class RemixAhead {
 public:
  /// `remix` has given its start, and must outlive this object. From begin() on it belongs to the thread.
  explicit RemixAhead(gcode::Remix& remix) : remix_(remix) {}
  /// As stop().
  ~RemixAhead() { stop(); }
  RemixAhead(const RemixAhead&) = delete;
  RemixAhead& operator=(const RemixAhead&) = delete;

  /// Once.
  void begin();
  /// Waits for the next chunk. Returns nullopt after the last one and after stop(). Rethrows what remixing
  /// threw when it is that chunk's turn.
  std::optional<RemixedChunk> wait();
  /// Whether wait() would return at once.
  bool ready() const;
  /// As Lookahead::on_ready().
  void on_ready(std::function<void()> listener);
  /// Gives up remixing and waits for the thread; the remix is its owner's again.
  void stop();
  /// What waits; a layer that ends in a later chunk is left out.
  Waiting waiting() const;
  /// The most chunks that ever waited.
  std::size_t most_waiting() const;

 private:
  void run(const std::stop_token& over);
  bool is_full() const;

  gcode::Remix& remix_;
  mutable std::mutex mutex_;  ///< guards all below
  std::condition_variable_any changed_;
  std::deque<RemixedChunk> made_;
  double seconds_ = 0;  ///< of printing, in made_
  std::size_t lines_ = 0, most_ = 0;
  bool ended_ = false;
  std::exception_ptr failed_;
  std::function<void()> listener_;
  std::jthread thread_;
};

}  // namespace unicursal::host
