// What a session prints, piece by piece: planned ahead of the nozzle, or known from beginning to end. All of
// it is called on the loop's thread. mm, mm³/s, s.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/polygon.hpp"
#include "firmware_gcode/print/chunk.hpp"
#include "firmware_gcode/print/printer.hpp"
#include "host/engine/chunk_maker.hpp"
#include "host/lookahead/foretold_times.hpp"
#include "host/lookahead/lookahead.hpp"
#include "host/spool/spooled_chunk.hpp"

namespace unicursal::host {

/// A stretch of the print.
struct PrintStep {
  gcode::Chunk chunk;
  SpooledChunk record;  ///< for the spool, but for its lines
  double ready_at = 0;  ///< s of the clock before which it would not have been there, in virtual time
};

/// A mixture by the name that a person knows.
struct NamedMixture {
  std::string name;
  gcode::Mixture mixture;
};

class Source {
 public:
  virtual ~Source() = default;

  /// On which printer, and what a pause has to keep clear of.
  virtual const gcode::Printer& printer() const = 0;
  virtual core::Box extent() const = 0;
  virtual double flow() const = 0;
  virtual std::vector<NamedMixture> mixtures() const = 0;
  virtual std::vector<std::string> warnings() const = 0;

  virtual std::size_t layers() const = 0;  ///< in all
  /// Heats; what is sent first.
  virtual gcode::Chunk start() = 0;
  /// Whether next() has something to say; `listener` is told, by any thread, when that may have become so.
  virtual bool ready() const = 0;
  virtual void on_ready(std::function<void()> listener) = 0;
  /// The next piece, or nothing after the last and after cancel(). Precondition: ready.
  virtual std::optional<PrintStep> next() = 0;
  /// Parks and cools, wherever the printer has stopped in what was sent.
  virtual gcode::Chunk finish() = 0;
  /// No further piece is needed.
  virtual void cancel() = 0;

  /// As Lookahead::printed().
  virtual void printed(double now, double left) = 0;
  /// Planned, and in no piece yet.
  virtual Waiting waiting() const = 0;
  /// s that the flow foretells for the layers from `begin` up to `end`, which is not one of them; nothing as
  /// long as that is unknown.
  virtual std::optional<double> foretold(std::size_t begin, std::size_t end) const = 0;
};

/// A job's layers as they are planned. What it refers to must outlive it.
class PlannedSource final : public Source {
 public:
  /// `rest_given`: nothing is withheld by the maker's encoder behind the last layer.
  PlannedSource(Lookahead& lookahead, ChunkMaker& maker, bool rest_given = false)
      : lookahead_(lookahead),
        maker_(maker),
        ended_(rest_given),
        times_(*maker.prepared().part, maker.prepared().first, maker.prepared().count,
               lookahead_options(maker.prepared()).flow) {}

  const gcode::Printer& printer() const override { return maker_.prepared().job.profile.printer; }
  core::Box extent() const override { return maker_.prepared().frame.extent; }
  double flow() const override { return maker_.flow(); }
  std::vector<NamedMixture> mixtures() const override;
  std::vector<std::string> warnings() const override { return maker_.warnings(); }

  std::size_t layers() const override { return maker_.prepared().count; }
  gcode::Chunk start() override { return maker_.start(); }
  bool ready() const override { return lookahead_.ready(); }
  void on_ready(std::function<void()> listener) override { lookahead_.on_ready(std::move(listener)); }
  std::optional<PrintStep> next() override;
  gcode::Chunk finish() override { return maker_.finish(); }
  void cancel() override;
  void printed(double now, double left) override { lookahead_.printed(now, left); }
  Waiting waiting() const override;
  std::optional<double> foretold(std::size_t begin, std::size_t end) const override {
    return times_.between(begin, end);
  }

 private:
  Lookahead& lookahead_;
  ChunkMaker& maker_;
  bool ended_;                         ///< nothing is withheld any more, or wanted
  std::size_t taken_ = 0, given_ = 0;  ///< layers of the print up to which the encoder has taken, and given
  ForetoldTimes times_;
};

/// A print that needs no planning any more.
struct FinishedPrint {
  gcode::Chunk start;              ///< heats; what is sent first
  std::vector<gcode::Chunk> body;  ///< in order
  gcode::Chunk finish;             ///< parks and cools, wherever the printer has stopped in what was sent
};

/// Its chunks; they count as layers. What it refers to must outlive it.
class FinishedSource final : public Source {
 public:
  FinishedSource(const FinishedPrint& print, const gcode::Printer& printer)
      : print_(print), printer_(printer) {}

  const gcode::Printer& printer() const override { return printer_; }
  /// It may lie anywhere.
  core::Box extent() const override { return {{0, 0}, {printer_.bed[0], printer_.bed[1]}}; }
  double flow() const override { return printer_.max_flow; }
  std::vector<NamedMixture> mixtures() const override { return {}; }
  std::vector<std::string> warnings() const override { return {}; }

  std::size_t layers() const override { return print_.body.size(); }
  gcode::Chunk start() override { return print_.start; }
  bool ready() const override { return true; }
  void on_ready(std::function<void()>) override {}
  std::optional<PrintStep> next() override;
  gcode::Chunk finish() override { return print_.finish; }
  void cancel() override { taken_ = print_.body.size(); }
  void printed(double, double) override {}
  Waiting waiting() const override;
  std::optional<double> foretold(std::size_t, std::size_t) const override { return std::nullopt; }

 private:
  const FinishedPrint& print_;
  const gcode::Printer& printer_;
  std::size_t taken_ = 0;
};

}  // namespace unicursal::host
