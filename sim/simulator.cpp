#include "sim/simulator.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "sim/bed/bead_pictures.hpp"
#include "sim/bed/deposit.hpp"
#include "sim/firmware/firmware.hpp"
#include "sim/line/terminal.hpp"
#include "sim/motion/motion_log.hpp"
#include "sim/motion/motion_picture.hpp"
#include "sim/motion/move_sinks.hpp"
#include "sim/nozzle/feed_log.hpp"
#include "sim/nozzle/nozzle.hpp"
#include "sim/raster.hpp"
#include "sim/report.hpp"
#include "sim/stop_signals.hpp"

namespace unicursal::sim {

namespace {

using Clock = std::chrono::steady_clock;

// Real time from a host's opening the line to the first words, as a boot loader takes it. A host that sets
// its port up and empties it meanwhile misses nothing; what it sends meanwhile is read afterwards.
constexpr std::chrono::milliseconds boot_time{50};
constexpr std::size_t much_output = 1 << 16;  // bytes unsent at which no more input is read
constexpr std::size_t most_output = 1 << 20;  // bytes unsent beyond which replies are lost
constexpr int events_between_looks = 16;      // leaps of time before the line is looked at again

void require(bool condition, const char* sentence) {
  if (!condition) throw std::invalid_argument(sentence);
}

bool positive(double value) {
  return std::isfinite(value) && value > 0;
}

bool three_positive(const std::vector<double>& values) {
  return values.size() == 3 && std::all_of(values.begin(), values.end(), positive);
}

void check(const SimulatorOptions& options) {
  require(three_positive(options.bed), "the bed needs three positive sizes: x, y and z in mm");
  require(three_positive(options.steps_per_mm), "the axes need three positive numbers of steps per mm");
  require(three_positive(options.max_acceleration), "the axes need three positive accelerations in mm/s²");
  require(three_positive(options.max_speed), "the axes need three positive speeds in mm/s");
  require(positive(options.feeder_steps_per_mm), "the feeders need a positive number of steps per mm");
  require(positive(options.filament_diameter), "the filament needs a positive diameter in mm");
  require(positive(options.pixel), "a picture's pixel needs a positive size in mm");
  require(options.raster_pixel >= 0.01 && options.raster_pixel <= 1, "a raster's pixel is 0.01 to 1 mm wide");
  require(options.dead_volume >= 0 && options.dead_volume <= 1000 && options.mixing_volume >= 0 &&
              options.mixing_volume <= 1000,
          "the chamber's volumes are 0 to 1000 mm³");
  require(std::isfinite(options.speed) && options.speed >= 0, "the clock's speed is 0 or a positive number");
  require(options.feeders >= 1 && options.feeders <= max_feeders, "a printer has one to six feeders");
}

Machine machine_for(const SimulatorOptions& options) {
  Machine machine;
  std::copy_n(options.bed.begin(), 3, machine.bed.begin());
  std::copy_n(options.steps_per_mm.begin(), 3, machine.limits.steps_per_mm.begin());
  std::copy_n(options.max_acceleration.begin(), 3, machine.limits.max_acceleration.begin());
  std::copy_n(options.max_speed.begin(), 3, machine.limits.max_speed.begin());
  machine.limits.steps_per_mm[axis_e] = options.feeder_steps_per_mm;
  machine.feeders = options.feeders;
  return machine;
}

std::ofstream open_report(const std::optional<std::filesystem::path>& file) {
  if (!file) return {};
  errno = 0;
  std::ofstream report(*file);
  if (!report)
    throw std::system_error(errno, std::generic_category(), "cannot write the report " + file->string());
  return report;
}

/// The loop between the terminal, the clock and the firmware.
///
/// With speed 0 printer time stands still while the host is silent, and leaps to the next event while the
/// running command waits and nothing is left to read: a queue that is full leaps to the end of its oldest
/// move, a heater to its target. So a run depends on the bytes received only, not on the computer's speed.
class Simulation {
 public:
  Simulation(const SimulatorOptions& options, MoveSink& sink)
      : options_(options),
        terminal_(options.link),
        firmware_(machine_for(options), sink, [this](std::string_view line) { say(line); }) {}

  const Firmware& firmware() const { return firmware_; }
  const std::string& path() const { return terminal_.path(); }

  void run() {
    while (!stopped_) {
      if (!wait_for_host()) break;
      if (!booted_) boot();
      serve();
      terminal_.clear();
      output_.clear();
      if (options_.once && firmware_.counts().received > 0) break;
    }
    firmware_.run_down();
  }

 private:
  bool paced() const { return options_.speed > 0; }

  void say(std::string_view line) {
    if (output_.size() > most_output) return;
    output_.append(line);
    output_ += '\n';
  }

  /// Where printer time stands when it is paced.
  double present() const {
    return std::chrono::duration<double>(Clock::now() - start_).count() * options_.speed;
  }

  /// How long poll() may sleep before the printer does something by itself; negative: for ever. ms
  int sleep_time() const {
    if (!paced() || !booted_) return -1;
    const auto next = firmware_.next_event();
    if (!next) return -1;
    constexpr double longest = 3.6e6;
    return static_cast<int>(std::clamp(std::ceil((*next - present()) / options_.speed * 1000), 0.0, longest));
  }

  void keep_time() {
    if (paced() && booted_) firmware_.advance(present());
  }

  /// False when a signal came first.
  bool wait_for_host() {
    for (;;) {
      terminal_.forget_openings();
      if (terminal_.host_present()) return true;
      pollfd waits[2] = {{stop_.descriptor(), POLLIN, 0}, {terminal_.openings(), POLLIN, 0}};
      ::poll(waits, 2, sleep_time());
      if (waits[0].revents != 0) return false;
      keep_time();
      output_.clear();  // nobody listens
    }
  }

  void boot() {
    pollfd wait{stop_.descriptor(), POLLIN, 0};
    if (::poll(&wait, 1, static_cast<int>(boot_time.count())) > 0) stopped_ = true;
    start_ = Clock::now();
    booted_ = true;
    firmware_.boot();
  }

  /// Until the host hangs up or a signal comes.
  void serve() {
    while (!stopped_) {
      flush();
      const bool leap = !paced() && firmware_.blocked() && output_.size() < much_output;
      const auto line_events =
          static_cast<short>((output_.size() < much_output ? POLLIN : 0) | (output_.empty() ? 0 : POLLOUT));
      pollfd waits[2] = {{stop_.descriptor(), POLLIN, 0}, {terminal_.master(), line_events, 0}};
      ::poll(waits, 2, leap ? 0 : sleep_time());
      if (waits[0].revents != 0) stopped_ = true;
      keep_time();
      if ((waits[1].revents & (POLLIN | POLLHUP)) != 0) {
        if (!read_line()) return;
      } else if (leap) {
        leap_ahead();
      }
    }
  }

  /// False when the host has hung up and everything it sent has been read.
  bool read_line() {
    char bytes[4096];
    const auto count = ::read(terminal_.master(), bytes, sizeof bytes);
    if (count <= 0) return count < 0 && (errno == EAGAIN || errno == EINTR);
    firmware_.receive({bytes, static_cast<std::size_t>(count)});
    return true;
  }

  void leap_ahead() {
    for (int i = 0; i < events_between_looks && firmware_.blocked(); ++i)
      firmware_.advance(*firmware_.next_event());
  }

  void flush() {
    while (!output_.empty()) {
      const auto count = ::write(terminal_.master(), output_.data(), output_.size());
      if (count <= 0) return;
      output_.erase(0, static_cast<std::size_t>(count));
    }
  }

  const SimulatorOptions& options_;
  StopSignals stop_;
  Terminal terminal_;
  std::string output_;  ///< replies not yet written
  Firmware firmware_;
  Clock::time_point start_{};
  bool booted_ = false, stopped_ = false;
};

}  // namespace

int run_simulator(const SimulatorOptions& options, const std::function<void(const std::string&)>& ready) {
  check(options);
  std::ofstream report = open_report(options.report);
  std::optional<BeadStore> pictures;
  if (options.pictures) {
    clear_pictures(*options.pictures);
    pictures.emplace(*options.pictures);
  }
  std::optional<RasterWriter> rasters;
  std::optional<Spread> spread;
  Deposit deposit({.drawing = pictures ? &*pictures : nullptr});
  if (options.rasters) {
    rasters.emplace(*options.rasters);
    spread.emplace(BedSize{options.bed[0], options.bed[1]}, options.raster_pixel);
    deposit = Deposit({pictures ? &*pictures : nullptr, &*spread, &*rasters});
  }
  Nozzle nozzle(options.filament_diameter,
                Chamber({options.dead_volume, options.mixing_volume}, options.feeders), deposit);
  FeedLog feed;
  MotionLog motion(nozzle.filament_area());
  MoveSinks sinks({&feed, &nozzle, &motion});
  Simulation simulation(options, sinks);

  ready(simulation.path());
  simulation.run();
  deposit.finish();

  if (options.report) {
    report << report_json(machine_for(options), simulation.firmware(), {feed, nozzle, deposit, motion})
           << '\n';
    report.close();
    if (!report)
      throw std::system_error(EIO, std::generic_category(), "cannot write " + options.report->string());
  }
  if (pictures) {
    draw_layers(*pictures, *options.pictures, options.pixel);
    draw_part(*pictures, *options.pictures);
    picture::write_png(*options.pictures / "motion.png", draw_motion(motion));
  }
  return 0;
}

}  // namespace unicursal::sim
