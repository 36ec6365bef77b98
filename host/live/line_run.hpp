// Runs a print's lines through reader, nozzle and layers, from any line on for which a state was kept. It
// knows no threads. mm, mm³, s.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "core/picture/filaments.hpp"
#include "host/engine/line_follower.hpp"
#include "host/live/line_reader.hpp"
#include "host/live/line_table.hpp"
#include "host/live/live_layers.hpp"
#include "host/live/nozzle_flow.hpp"

namespace unicursal::host {

/// A chunk's lines.
struct LineBatch {
  std::uint64_t first = 0;  ///< the print's line with which it begins
  std::string text;         ///< one behind the other
  std::vector<std::uint32_t> ends;
  std::vector<LayerBegun> begun;
  std::vector<gcode::MixtureStart> mixtures;
  std::vector<gcode::MaterialStart> asked;
  double seconds = 0;  ///< by the time model; 0: unknown
  bool ends_layer = false;
  double stretch = 1;  ///< of the seconds of its lines
  bool whole = false;  ///< it was run to its end once

  std::size_t size() const { return ends.size(); }
  std::string_view line(std::size_t i) const {
    const std::uint32_t begin = i == 0 ? 0 : ends[i - 1];
    return std::string_view(text).substr(begin, ends[i] - begin);
  }
};

/// A mixture that was fed.
struct FedMixture {
  std::string name;
  gcode::Shares shares;
};

class LineRun {
 public:
  /// What it writes to must outlive it. `filaments`: the colours.
  LineRun(const gcode::Printer& printer, const picture::Filaments& filaments, LiveLayers& layers,
          LineTable& table);

  /// The lines that follow.
  void append(LineBatch batch);
  /// Runs up to `most` lines that have not been run; returns whether more are left.
  bool run(std::size_t most);
  /// Runs lines that are not the print's in front of its line `line`; those behind it are run again.
  void interpose(const std::vector<std::string>& lines, std::uint64_t line);
  /// Forgets what is needed to run lines before `line` again.
  void drop_before(std::uint64_t line);

  const std::vector<FedMixture>& fed() const { return fed_; }
  /// Layers before this one are not written any more.
  std::size_t first_open_layer() const {
    return kept_.empty() || kept_.front().mark.layers == 0 ? 0 : kept_.front().mark.layers - 1;
  }

 private:
  /// Everything that the next line depends on.
  struct Head {
    std::uint64_t line = 0;
    LineReader reader;
    NozzleFlow flow;
    std::uint8_t asked = LaidPath::nothing_asked;
    std::string name;  ///< of the mixture that is fed
    std::uint16_t fed = 0;
    double poured = 0;  ///< mm³ that have left the nozzle
    LiveLayers::Mark mark;
  };

  void keep_state();
  LineBatch& batch_at(std::uint64_t line);
  void run_line(LineBatch& batch, std::size_t index);
  void begin_line(LineBatch& batch, std::size_t index);
  void lay(const LineMotion& motion, LineStep& step);
  void feed_aside(const LineMotion& motion);
  void end_batch(LineBatch& batch);
  std::uint16_t number_of_fed();
  picture::Colour colour_of(const gcode::Shares& shares);

  const gcode::Printer printer_;
  const picture::Filaments& filaments_;
  LiveLayers& layers_;
  LineTable& table_;
  Head head_;
  std::deque<Head> kept_;  ///< states, the oldest first
  std::deque<LineBatch> batches_;
  std::uint64_t end_ = 0;  ///< behind the last batch
  std::vector<FedMixture> fed_;
  double last_stretch_ = 1;
  gcode::Shares coloured_;  ///< shares of which the colour is known
  picture::Colour colour_;
};

}  // namespace unicursal::host
