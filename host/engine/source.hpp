// What a session prints, step by step: planned ahead of the nozzle, or known from beginning to end. All
// functions are called on the loop's thread. mm, mm³/s, s.
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
#include "host/loop/clock.hpp"
#include "host/spool/spooled_chunk.hpp"

namespace unicursal::host {

/// A chunk of the print with what the spool keeps of it.
struct PrintStep {
  gcode::Chunk chunk;
  SpooledChunk record;  ///< for the spool; the session adds lines, layers and mixtures from the chunk
  double ready_at = 0;  ///< s of the clock from which on it is there, in virtual time; 0: at once
};

class Source {
 public:
  virtual ~Source() = default;

  /// The printer that the print is made for, and the part's extent, which a pause keeps clear of.
  virtual const gcode::Printer& printer() const = 0;
  virtual core::Box extent() const = 0;
  virtual double flow() const = 0;
  virtual std::vector<std::string> warnings() const = 0;

  /// Layers of the whole print.
  virtual std::size_t layers() const = 0;
  /// The lines that are sent first; they heat the printer.
  virtual gcode::Chunk start() = 0;
  /// Whether next() returns without waiting.
  virtual bool ready() const = 0;
  /// `listener` is called, on any thread, when ready() may have become true, possibly under a lock that
  /// ready() takes: it must not wait for a thread that asks the source.
  virtual void on_ready(std::function<void()> listener) = 0;
  /// The next step; nullopt after the last one and after cancel(). Precondition: ready() or cancelled.
  virtual std::optional<PrintStep> next() = 0;
  /// The lines that park and cool the printer; they fit wherever it has stopped in what was sent.
  virtual gcode::Chunk finish() = 0;
  /// No further step is needed.
  virtual void cancel() = 0;

  /// As Lookahead::printed().
  virtual void printed(double now, double left) = 0;
  /// Layers that are planned and not yet in a step.
  virtual Waiting waiting() const = 0;
  /// s that the layers from `begin` up to, but without, `end` take at the job's flow; nullopt while unknown.
  virtual std::optional<double> foretold(std::size_t begin, std::size_t end) const = 0;
};

/// Reports to the source that the lines sent so far leave `left` s of printing, at the clock's present time.
void report_printed(Source& source, const Clock& clock, double left);

/// A source whose steps a spool keeps, so that they can go on after a session has lost its printer.
class KeptSource : public Source {
 public:
  /// Whether cancel() was called.
  virtual bool cancelled() const = 0;
  /// Chunks that it has handed out.
  virtual std::size_t made() const = 0;
};

/// A job's layers as they are planned. The look-ahead and the chunk maker must outlive it.
class PlannedSource final : public KeptSource {
 public:
  /// `rest_given`: the maker's encoder withholds nothing after the last layer, since that was sent before.
  PlannedSource(Lookahead& lookahead, ChunkMaker& maker, bool rest_given = false)
      : lookahead_(lookahead),
        maker_(maker),
        ended_(rest_given),
        times_(*maker.prepared().part, maker.prepared().first, maker.prepared().count,
               lookahead_options(maker.prepared()).flow) {}

  const gcode::Printer& printer() const override { return maker_.prepared().job.profile.printer; }
  core::Box extent() const override { return maker_.prepared().frame.extent; }
  double flow() const override { return maker_.flow(); }
  std::vector<std::string> warnings() const override { return maker_.warnings(); }

  std::size_t layers() const override { return maker_.prepared().count; }
  gcode::Chunk start() override { return ++made_, maker_.start(); }
  bool ready() const override { return lookahead_.ready(); }
  void on_ready(std::function<void()> listener) override { lookahead_.on_ready(std::move(listener)); }
  std::optional<PrintStep> next() override;
  gcode::Chunk finish() override { return ++made_, maker_.finish(); }
  void cancel() override;
  bool cancelled() const override { return cancelled_; }
  std::size_t made() const override { return made_; }
  void printed(double now, double left) override { lookahead_.printed(now, left); }
  Waiting waiting() const override;
  std::optional<double> foretold(std::size_t begin, std::size_t end) const override {
    return times_.between(begin, end);
  }

 private:
  Lookahead& lookahead_;
  ChunkMaker& maker_;
  bool ended_;             ///< the encoder withholds nothing more, or the print was cancelled
  std::size_t taken_ = 0;  ///< the encoder was given the layers before this one
  std::size_t given_ = 0;  ///< the encoder has returned all of the layers before this one
  std::size_t made_ = 0;
  bool cancelled_ = false;
  ForetoldTimes times_;
};

/// A print that is encoded already.
struct FinishedPrint {
  gcode::Chunk start;              ///< as Source::start()
  std::vector<gcode::Chunk> body;  ///< in order
  gcode::Chunk finish;             ///< as Source::finish()
};

/// The chunks of such a print, each of which counts as a layer. What it refers to must outlive it.
class FinishedSource : public Source {
 public:
  FinishedSource(const FinishedPrint& print, const gcode::Printer& printer)
      : print_(print), printer_(printer) {}

  const gcode::Printer& printer() const override { return printer_; }
  /// The whole bed: the print may lie anywhere.
  core::Box extent() const override { return {{0, 0}, {printer_.bed[0], printer_.bed[1]}}; }
  double flow() const override { return printer_.max_flow; }
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
