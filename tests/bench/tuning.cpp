// Measures what `unicursal tune transition` finds on simulated printers with hidden volumes: 20 random ones
// and the 24 extreme ones. Readings are rounded to the printed ticks. mm³.
#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "host/cli/cli.hpp"
#include "host/job/profile.hpp"
#include "tests/host/support/hidden_nozzles.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace {

using namespace unicursal;

std::string profile_with(double dead, double mixing) {
  return fmt::format(
      "[printer]\nnozzle = 0.6\nbead_width_range = [0.36, 1.6]\n[transition]\ndead_volume = {}\n"
      "mixing_volume = {}\n",
      dead, mixing);
}

/// Runs the program without its output.
int run_quietly(std::vector<std::string> arguments) {
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  std::fflush(stdout);
  const int out = dup(STDOUT_FILENO), err = dup(STDERR_FILENO), nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO), dup2(nowhere, STDERR_FILENO);
  const int code = host::run_command_line(static_cast<int>(pointers.size()), pointers.data());
  std::fflush(stdout), std::fflush(stderr);
  dup2(out, STDOUT_FILENO), dup2(err, STDERR_FILENO);
  for (const int file : {out, err, nowhere}) close(file);
  return code;
}

/// The greater of both errors as a share of dead + mixing volume.
double measure(const test::HiddenNozzle& hidden) {
  const test::TempFolder folder;
  const std::string profile = folder.write("profile.toml", profile_with(2.1, 4)).string();
  const std::string machine = folder.write("machine.toml", profile_with(hidden.dead, hidden.mixing)).string();
  const int code =
      run_quietly({"unicursal", "tune", "transition", profile, "--simulate", "--machine", machine, "--tanks",
                   std::to_string(hidden.tanks), "--read-simulated", "--yes"});
  if (code != 0) throw std::runtime_error(fmt::format("tuning ended with code {}", code));
  const gcode::Printer found = host::load_profile(profile).printer;
  const double worse =
      std::max(std::abs(found.dead_volume - hidden.dead), std::abs(found.mixing_volume - hidden.mixing));
  const double error = worse / (hidden.dead + hidden.mixing);
  fmt::print("{:5}  {:8.2f} {:8.2f}  {:8.2f} {:8.2f}  {:6.1f} %\n", hidden.tanks, hidden.dead,
             found.dead_volume, hidden.mixing, found.mixing_volume, 100 * error);
  return error;
}

void measure_all(const char* title, const std::vector<test::HiddenNozzle>& nozzles) {
  fmt::print("{}\ntanks      dead    found    mixing    found  error of dead + mixing\n", title);
  double worst = 0;
  for (const test::HiddenNozzle& nozzle : nozzles) worst = std::max(worst, measure(nozzle));
  fmt::print("worst {:.1f} %\n\n", 100 * worst);
}

}  // namespace

int main(int argc, char** argv) {
  // The simulated printer is another process of this program.
  if (argc > 1 && std::string_view(argv[1]) == "simulate") return host::run_command_line(argc, argv);
  measure_all("20 nozzles by chance", test::hidden_nozzles());
  measure_all("The extremes", test::extreme_nozzles());
}
