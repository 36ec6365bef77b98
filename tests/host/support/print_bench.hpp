// The program as a real process that prints to a simulated printer, which is another and lives on when a
// print is cut short.
#pragma once

#include <poll.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/host/support/child_process.hpp"
#include "tests/host/support/sample_job.hpp"
#include "tests/host/support/temp_folder.hpp"

namespace unicursal::test {

/// What a simulated printer has run and laid.
struct Seen {
  std::vector<std::string> lines;  ///< without the hosts' questions, and what the display shows
  nlohmann::json report;
};

/// A job, a printer of its own, and the folder in which its prints are kept.
class PrintBench {
 public:
  /// `speed`: printer seconds per second; 0: as fast as lines come. `more`: options of the simulator.
  explicit PrintBench(int speed, const std::vector<std::string>& more = {},
                      const std::string& profile = sample_profile)
      : speed_(speed) {
    folder_.write("bench.toml", profile);
    folder_.write("plate.svg", sample_drawing);
    folder_.write("job.toml", sample_job);
    start_printer(more);
  }

  std::string path(const std::string& name) const { return folder_ / name; }
  const TempFolder& folder() const { return folder_; }
  /// Planned in no hurry, so that two prints of the job are alike on a busy computer as well.
  std::vector<std::string> print(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"print",   path("job.toml"), "--port",        path("port"),
                                   "--spool", path("spool"),    "--full-quality"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  std::vector<std::string> resume() const { return {"resume", "--spool", path("spool")}; }
  Outcome resume_anyway() const {
    auto arguments = resume();
    arguments.push_back("--yes");
    return run(arguments);
  }
  /// Whether a print has begun, judged by its folder.
  bool begun() const {
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(path("spool"), none)) {
      if (std::filesystem::exists(entry.path() / "print.json")) return true;
    }
    return false;
  }
  std::filesystem::path print_folder() const {
    for (const auto& entry : std::filesystem::directory_iterator(path("spool"))) {
      if (entry.is_directory()) return entry.path();
    }
    throw std::logic_error("no print was kept");
  }

  const Child& printer() const { return *printer_; }
  /// Another printer, cold and sound, stands at the old one's port.
  void replace_printer() {
    end_printer();
    start_printer({});
  }
  /// Ends the printer.
  Seen seen() {
    end_printer();
    return {lines_, nlohmann::json::parse(read_text(path("seen.json")))};
  }

  template <class Condition>
  static void wait_for(Condition condition, const Child& child) {
    while (!condition() && child.running()) poll(nullptr, 0, 2);
  }

 private:
  void start_printer(const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"simulate",    "--profile", path("bench.toml"),     "--link",
                                       path("port"),  "--speed",   std::to_string(speed_), "--transcript",
                                       path("t.txt"), "--report",  path("seen.json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    printer_ = std::make_unique<Child>(arguments);
    wait_for([&] { return std::filesystem::exists(path("port")); }, *printer_);
  }

  void end_printer() {
    if (printer_->id() < 0) throw std::logic_error("the printer has ended");  // kill(-1) would end everything
    kill(printer_->id(), SIGTERM);
    CHECK(printer_->wait().code == 0);
    std::istringstream transcript(read_text(path("t.txt")));
    bool asks_for_tools = false;  // a Marlin is asked T<highest>, T0 behind the question whether it mixes
    for (std::string line; std::getline(transcript, line);) {
      asks_for_tools = line == "M163 S99 P1" || (asks_for_tools && (line.starts_with('T') || line == "M105"));
      const bool question = asks_for_tools || line == "*" || line == "M115" || line == "M105" ||
                            line == "M114" || line.starts_with("M155") || line.starts_with("M110") ||
                            line == "M567 P0" || line == "G4 S1" ||  // until the nozzle cools
                            line.starts_with("M117 ") || line.starts_with("M73 ");
      if (!question) lines_.push_back(line);
    }
  }

  int speed_;
  TempFolder folder_;
  std::unique_ptr<Child> printer_;
  std::vector<std::string> lines_;  ///< of the printers that have ended
};

inline void check_equal(const Seen& seen, const Seen& expected) {
  CHECK((seen.lines == expected.lines));
  for (const char* figure : {"extruded_mm", "feeders", "deposited_length_mm"}) {
    INFO(figure);
    CHECK(seen.report[figure] == expected.report[figure]);
  }
  CHECK(seen.report["chamber"]["fed_mm3"] == expected.report["chamber"]["fed_mm3"]);
  CHECK(seen.report["deposited_mm3"].get<double>() ==
        Approx(expected.report["deposited_mm3"].get<double>()).epsilon(1e-9));
}

/// Whether what was seen ends with everything of a print from one of its lines on.
inline bool ends_like(const std::vector<std::string>& seen, const std::vector<std::string>& whole,
                      std::size_t from) {
  const std::size_t count = whole.size() - from;
  return seen.size() >= count && std::equal(whole.begin() + static_cast<std::ptrdiff_t>(from), whole.end(),
                                            seen.end() - static_cast<std::ptrdiff_t>(count));
}

/// Where a print was cut, and where it was taken up again.
struct Cut {
  std::size_t run = 0;    ///< lines that were run before
  std::size_t again = 0;  ///< the first that was run afterwards
};

inline Cut cut_in(const std::vector<std::string>& seen, const std::vector<std::string>& whole) {
  Cut cut;
  const auto differs = std::mismatch(seen.begin(), seen.end(), whole.begin(), whole.end());
  cut.run = static_cast<std::size_t>(differs.first - seen.begin());
  cut.again = whole.size();
  while (cut.again > 0 && ends_like(seen, whole, cut.again - 1)) --cut.again;
  return cut;
}

}  // namespace unicursal::test
