// What a print makes, from beginning to end, whatever it is made from: a job whose curves are planned ahead
// of the nozzle, or another program's file. A print (host/engine/print.hpp), a dry run (host/dry_run) and a
// restart (host/engine/restart.hpp) know no more of it.
//
//   production.check();
//   production.begin(clock, {});                      // from now on work goes on in other threads
//   KeptSource& source = production.open({});         // the chunks, in order
//   while (auto step = source.next()) use(*step);
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/polygon.hpp"
#include "host/engine/layer_range.hpp"
#include "host/engine/line_follower.hpp"
#include "host/engine/source.hpp"
#include "host/job/job.hpp"
#include "host/lookahead/planned_layer.hpp"
#include "host/loop/clock.hpp"
#include "host/spool/chunk_reader.hpp"
#include "host/spool/spool.hpp"

namespace unicursal::host {

/// What has been planned on this computer.
struct Planning {
  PlanningEffort effort;
  std::size_t threads = 1;
};

class Production {
 public:
  virtual ~Production() = default;

  virtual const Job& job() const = 0;
  /// Layers of the whole print.
  virtual std::size_t layers() const = 0;
  /// As asked; absent: all of them.
  virtual std::optional<LayerRange> range() const = 0;
  /// Of what is laid, on the bed.
  virtual core::Box extent() const = 0;
  /// mm³/s that is held, as far as it is known.
  virtual double flow() const = 0;

  /// Throws core::DataError if the beginning cannot be printed.
  virtual void check() const = 0;
  /// At the end, in a dry run: throws core::DataError if what was made is not to be printed.
  virtual void check_made() const = 0;
  /// Once: makes what lies behind `kept`, in threads of its own. `clock` is the printer's.
  virtual void begin(const std::shared_ptr<Clock>& clock, const SpoolExtent& kept) = 0;
  /// After begin(): the steps that lie behind `kept`. A further call begins again at the same place; the
  /// source before is gone then.
  virtual KeptSource& open(const SpoolExtent& kept) = 0;
  /// For a print that continues, after open() and before the source's first step: brings it to where the
  /// spool's last chunk ends. Throws SpoolError if the same lines are not made again.
  virtual void catch_up(const Spool& spool) = 0;

  /// After begin(): `viewer` sees each layer on the bed that is planned and not in a step yet, also those
  /// that wait already. As Lookahead::on_planned(); nobody is called if nothing is planned.
  virtual void on_planned(std::function<void(const gcode::PlacedLayer&)> viewer) = 0;

  /// What the print asks for, as it is delivered.
  virtual AskedMaterials asked() const = 0;

  /// What became known while layers were made, one sentence each.
  virtual std::vector<std::string> late_warnings() const = 0;
  /// Absent if nothing is planned.
  virtual std::optional<Planning> planning() const = 0;
};

/// Throws SpoolError if the lines that were made are not those that the spool has kept.
void check_same(const gcode::Chunk& made, const SpooledChunk& kept, const Spool& spool);

}  // namespace unicursal::host
