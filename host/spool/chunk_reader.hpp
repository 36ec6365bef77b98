// Reading the chunks of a print back, one at a time: memory does not grow with their number. And the lines of
// a leg (journal.hpp) from any place on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware_gcode/interruption/modal_state.hpp"
#include "host/spool/journal.hpp"
#include "host/spool/record_file.hpp"
#include "host/spool/spooled_chunk.hpp"

namespace unicursal::host {

class ChunkReader {
 public:
  /// Throws SpoolError.
  explicit ChunkReader(const std::filesystem::path& file) : records_(file) {}

  /// None behind the last sound one.
  std::optional<SpooledChunk> next();
  /// The print's line that the chunk given last begins with.
  std::uint64_t first_line() const { return first_line_; }
  /// Whether there is more behind the last sound one than a torn end. Precondition: next() has returned none.
  bool damaged_within();
  /// Bytes of sound chunks so far.
  std::uint64_t sound() const { return sound_; }

 private:
  RecordReader records_;
  std::uint64_t sound_ = 0, first_line_ = 0, next_line_ = 0;
};

/// What a spool holds, in numbers.
struct SpoolExtent {
  std::uint64_t lines = 0;
  std::uint64_t start_lines = 0;  ///< lines before the first layer
  std::size_t layers = 0;
  bool rest = false;              ///< the lines that the encoder had withheld are there
  bool finished = false;          ///< the lines that end the print are there, too
  std::uint64_t last_begins = 0;  ///< the first line of the last chunk
  std::size_t chunks = 0;

  void add(const SpooledChunk& chunk);
};

/// The lines of one leg, in order.
class LegReader {
 public:
  /// From `place` on.
  LegReader(const std::filesystem::path& chunks, Leg leg, std::uint64_t place);

  /// Up to `most` lines, never of two chunks; none at the end of what is spooled.
  std::vector<std::string> next(std::size_t most);
  /// Layers before the one that the lines given last belong to.
  std::size_t layers_begun() const { return layers_begun_; }
  /// The mixture in use after the lines given last; empty before the first.
  const std::string& mixture() const { return mixture_; }
  /// How much of its chunk has been given, 0 … 1.
  double fraction() const;

 private:
  bool open_next();
  void start_mixtures();

  ChunkReader reader_;
  Leg leg_;
  std::uint64_t line_;  ///< the print's next
  std::vector<std::string> lines_;
  std::vector<gcode::MixtureStart> mixtures_;  ///< in lines_
  std::size_t given_ = 0;                      ///< of lines_
  std::string mixture_;
  bool leading_ = false;  ///< they are the lead-in's
  std::size_t layers_ = 0, layers_begun_ = 0;
};

/// The state of a printer that has run a leg up to `place`, all legs before it included.
gcode::ModalState state_at(const std::filesystem::path& chunks, const Leg& leg, std::uint64_t place);

/// The mixture in use before a print's line is run: its name, empty before the first.
std::string mixture_before(const std::filesystem::path& chunks, std::uint64_t line);

/// The layer, counted from 0 among those printed, that a print's line belongs to, with its upper face in mm;
/// none for lines before the first.
struct LayerPlace {
  std::size_t index = 0;
  double top = 0;
};
std::optional<LayerPlace> layer_of(const std::filesystem::path& chunks, std::uint64_t line);

}  // namespace unicursal::host
