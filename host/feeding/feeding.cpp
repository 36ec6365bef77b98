#include "host/feeding/feeding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/error.hpp"
#include "firmware_gcode/dialect/dialect_named.hpp"
#include "firmware_gcode/dialect/number.hpp"
#include "firmware_gcode/dialect/share_writing.hpp"
#include "firmware_gcode/mixing/calibration.hpp"
#include "firmware_gcode/toolpath/checks.hpp"
#include "firmware_gcode/toolpath/job_frame.hpp"
#include "firmware_gcode/toolpath/move_writer.hpp"

namespace unicursal::host {
namespace {

using gcode::Chunk;
using gcode::Mixture;

constexpr double least_length = 1, greatest_length = 2000;  // mm
constexpr double coldest_feed = 170;   ///< °C, Marlin's EXTRUDE_MINTEMP; colder, it only reports a mistake
constexpr double fill_length = 60;     ///< mm that fill an inlet, its tube's end, and the chamber
constexpr double purge_length = 20;    ///< mm, some 50 mm³: an inlet of a Diamond and the chamber, twice
constexpr double unload_length = 100;  ///< mm, out of the hot end
constexpr double beyond_tube = 80;     ///< mm, out of the hot end, through the tube and out of the gears
constexpr double unsure_length = 30;   ///< mm by which a tube may be shorter than its profile says
constexpr double tip_length = 5;       ///< mm, all feeders together
constexpr double tube_speed = 20;      ///< mm/s; a feeder pushes at most so fast through a tube
constexpr double flow_part = 0.5;      ///< of max_flow, which only all inlets together melt
constexpr double piece_seconds = 0.5;  ///< of a line; the lines in the printer's queue run on after a Ctrl-C
constexpr double lifted_nozzle = 50;   ///< mm above the bed, for a hand and a string of plastic
constexpr std::size_t one_tool = 0;    ///< the first of the tools of single feeders

void add_lines(Chunk& chunk, std::vector<std::string> lines) {
  chunk.lines.insert(chunk.lines.end(), std::make_move_iterator(lines.begin()),
                     std::make_move_iterator(lines.end()));
}

Mixture mixture_of_one(std::size_t feeder, std::size_t feeders) {
  gcode::Shares shares = gcode::Shares::zeros(feeders);
  shares[feeder] = 1;
  return Mixture(shares);
}

double usual_length(FeedingKind kind, const std::optional<double>& tube) {
  switch (kind) {
    case FeedingKind::load:
      return tube.value_or(0) + fill_length;
    case FeedingKind::purge:
      return purge_length;
    case FeedingKind::unload:
      break;
  }
  return tube ? *tube + beyond_tube : unload_length;
}

void check_order(const FeedingOrder& order, const Profile& profile) {
  const gcode::Printer& printer = profile.printer;
  gcode::check_printer(printer);
  if (order.feeder && *order.feeder >= printer.feeders)
    throw core::DataError("", "--feeder", fmt::format("this printer has no feeder {}", *order.feeder + 1),
                          fmt::format("choose one of 1 to {}", printer.feeders));
  if (!order.feeder && order.kind != FeedingKind::purge)
    throw core::DataError("", "--feeder", "is missing",
                          fmt::format("choose one of 1 to {}", printer.feeders));
  if (order.length && !(*order.length >= least_length && *order.length <= greatest_length))
    throw core::DataError(
        "", "--length",
        fmt::format("{:g} mm is too {}", *order.length, *order.length < least_length ? "short" : "long"),
        fmt::format("choose {:g} to {:g} mm", least_length, greatest_length));
  if (printer.nozzle_temperature < coldest_feed)
    throw core::DataError(
        profile.file.string(), "temperature.nozzle",
        fmt::format("is {:g} °C, at which firmwares feed no filament", printer.nozzle_temperature),
        fmt::format("write the temperature at which this filament is printed, {:g} °C or more",
                    coldest_feed));
}

class FeedingWriter {
 public:
  FeedingWriter(const FeedingOrder& order, const Profile& profile)
      : order_(order),
        tube_(profile.tube_length),
        printer_(profile.printer),
        dialect_(gcode::dialect_named(printer_.firmware)),
        writer_(printer_, dialect_) {
    for (std::size_t f = 0; f < printer_.feeders; ++f) {
      if (!order.feeder || *order.feeder == f) feeders_.push_back(f);
    }
  }

  Feeding operator()() {
    made_.length = order_.length.value_or(usual_length(order_.kind, tube_));
    made_.print.start = start();
    push(retraction(), printer_.retraction_speed);
    feed();
    made_.print.finish = finish();
    made_.cold_end = cold();
    return std::move(made_);
  }

 private:
  std::size_t equal_tool() const { return one_tool + feeders_.size(); }
  double retraction() const { return printer_.retraction_length; }
  double filament_area() const {
    return std::numbers::pi / 4 * printer_.filament_diameter * printer_.filament_diameter;
  }
  double slow() const { return std::min(flow_part * printer_.max_flow / filament_area(), fast()); }
  double fast() const {
    return std::min({tube_speed, printer_.retraction_speed, printer_.motion.extruder_speed});
  }
  /// What the other feeders push meanwhile must melt, unlike that of this one, which is not at the nozzle.
  double through_tube(std::size_t which) const {
    const double others = 1 - share_[which];
    const double melting = flow_part * printer_.max_flow / filament_area();
    return others * fast() > melting ? melting / others : fast();
  }
  double pull() const { return std::min(printer_.retraction_speed, printer_.motion.extruder_speed); }

  Chunk start() {
    Chunk chunk;
    const std::string nozzle = gcode::short_number(printer_.nozzle_temperature, 1);
    add_lines(chunk, gcode::choose_extruder(dialect_));
    add_lines(chunk, {gcode::stay_watchful(), "M220 S100", "M221 S100", "M104 S" + nozzle, "G28"});
    add_lines(chunk, gcode::modes());
    writer_.rise(chunk, std::min(lifted_nozzle, printer_.bed[2]));
    writer_.travel(chunk, {printer_.bed[0] / 2, 0});
    add_lines(chunk, {"M109 S" + nozzle});
    add_lines(chunk, gcode::calibration(printer_));
    for (std::size_t i = 0; i < feeders_.size(); ++i)
      define(chunk, one_tool + i, fmt::format("feeder {}", feeders_[i] + 1), alone(feeders_[i]));
    define(chunk, equal_tool(), "all feeders", Mixture::equal(printer_.feeders));
    return chunk;
  }

  Mixture alone(std::size_t feeder) const {
    const Mixture mixture = mixture_of_one(feeder, printer_.feeders);
    return order_.kind == FeedingKind::unload ? mixture : mixture.with_floor(printer_.floor_share);
  }

  void define(Chunk& chunk, std::size_t tool, const std::string& name, const Mixture& mixture) {
    const gcode::CalibratedMixture written = gcode::calibrated(mixture, printer_.flow_factors, dialect_);
    writer_.define_tool(tool, name, written);
    add_lines(chunk, dialect_.define_tool(tool, written.written));
    if (tool != equal_tool()) share_.push_back(written.delivered.share(feeders_[tool - one_tool]));
  }

  void feed() {
    if (order_.kind == FeedingKind::unload) {
      push(tip_length, slow());
      return one(0, -made_.length, pull());
    }
    const bool from_far = order_.kind == FeedingKind::load && tube_;
    const double quick =
        from_far ? std::max(0.0, std::min(*tube_ - unsure_length, made_.length - fill_length)) : 0;
    for (std::size_t i = 0; i < feeders_.size(); ++i) {
      one(i, quick, through_tube(i));
      one(i, made_.length - quick, slow());
    }
    if (!order_.feeder) push(made_.length, slow());
  }

  /// The feeder itself moves `length`, the others their floor share of it besides.
  void one(std::size_t which, double length, double speed) {
    move(one_tool + which, length / share_[which], speed);
  }
  /// All feeders together, in equal shares.
  void push(double length, double speed) { move(equal_tool(), length, speed); }

  void move(std::size_t tool, double length, double speed) {
    if (length == 0) return;
    Chunk chunk;
    writer_.select_tool(chunk, tool);
    const double longest = std::min(piece_seconds * speed, dialect_.limits().extrusion / 2);
    const double pieces = std::ceil(std::abs(length) / longest);
    for (double piece = 0; piece < pieces; ++piece) writer_.filament(chunk, length / pieces, speed);
    chunk.seconds = std::abs(length) / speed;
    made_.seconds += chunk.seconds;
    made_.print.body.push_back(std::move(chunk));
  }

  /// It may have been ended anywhere, so the lines set every state that they need.
  Chunk finish() {
    Chunk chunk;
    writer_.forget();
    add_lines(chunk, gcode::modes());
    writer_.select_tool(chunk, equal_tool());
    writer_.filament(chunk, -retraction(), printer_.retraction_speed);
    add_lines(chunk, cold().lines);
    return chunk;
  }

  static Chunk cold() {
    Chunk chunk;
    add_lines(chunk, {"M104 S0", "M84", gcode::shut_down_after(0)});
    return chunk;
  }

  const FeedingOrder& order_;
  const std::optional<double> tube_;
  const gcode::Printer& printer_;
  const gcode::Dialect& dialect_;
  gcode::MoveWriter writer_;
  std::vector<std::size_t> feeders_;  ///< of the order
  std::vector<double> share_;         ///< that each of them has in its own tool
  Feeding made_;
};

}  // namespace

Feeding feeding(const FeedingOrder& order, const Profile& profile) {
  check_order(order, profile);
  return FeedingWriter(order, profile)();
}

}  // namespace unicursal::host
