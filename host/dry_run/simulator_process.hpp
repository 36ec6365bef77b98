// The simulated printer as a child process. It never outlives this object or its parent.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace unicursal::host {

/// The simulator could not be started, or did not end well.
class SimulatorError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class SimulatorProcess {
 public:
  enum class Time {
    own,       ///< the simulator keeps it
    lockstep,  ///< the host does, through control()
  };

  /// Runs this program's own `simulate --once --report …` with `arguments` added, and waits for its terminal.
  /// Call before starting threads. Throws SimulatorError.
  SimulatorProcess(const std::vector<std::string>& arguments, Time time);
  ~SimulatorProcess();
  SimulatorProcess(const SimulatorProcess&) = delete;
  SimulatorProcess& operator=(const SimulatorProcess&) = delete;

  /// The stream of the layers that were laid (sim/bed/raster.hpp). Hands the descriptor over; once.
  int take_rasters();

  /// The pseudo-terminal that the simulated printer listens on.
  const std::string& port() const { return port_; }
  /// The socket of the lockstep clock.
  std::filesystem::path control() const { return folder_ / "clock"; }

  /// Waits for the simulator to end, which it does when its line is closed, and reads its report.
  /// Throws SimulatorError.
  nlohmann::json finish();

 private:
  void spawn(const std::vector<std::string>& arguments);
  void read_port();
  void clean_up() noexcept;

  std::filesystem::path folder_;  ///< for the report; removed by the destructor
  std::string port_;
  pid_t child_ = -1;
  int output_ = -1;   ///< reading end of its standard output
  int rasters_ = -1;  ///< reading end of its rasters
};

}  // namespace unicursal::host
