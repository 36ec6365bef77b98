#include "tests/fuzz/kept.hpp"

#include <poll.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "tests/host/support/child_process.hpp"
#include "tests/host/support/sample_job.hpp"

namespace unicursal::test {
namespace {

namespace fs = std::filesystem;
using Lines = std::vector<std::string>;

/// Lines that may count as acknowledged too early, or are in the printer's queue (host/engine/restart.cpp).
constexpr std::size_t in_doubt = 36;

/// A simulated printer and the program, in a folder of their own.
class Place {
 public:
  explicit Place(const std::vector<std::string>& faults) {
    folder_.write("bench.toml", sample_profile);
    folder_.write("plate.svg", sample_drawing);
    folder_.write("job.toml", sample_job);
    std::vector<std::string> words{"simulate", "--profile",    path("bench.toml"),
                                   "--link",   path("port"),   "--speed",
                                   "0",        "--transcript", path("lines.txt")};
    words.insert(words.end(), faults.begin(), faults.end());
    printer_ = std::make_unique<Child>(words);
    while (!fs::exists(path("port")) && printer_->running()) poll(nullptr, 0, 2);
  }

  std::string path(const std::string& name) const { return folder_ / name; }
  Outcome print() const {
    return run(
        {"print", path("job.toml"), "--port", path("port"), "--spool", path("spool"), "--full-quality"});
  }
  Outcome resume() const {
    return run({"resume", "--spool", path("spool"), "--port", path("port"), "--yes"});
  }
  /// What the printer has run, without questions; ends it.
  Lines lines() {
    kill(printer_->id(), SIGTERM);
    printer_->wait();
    std::istringstream transcript(read_text(path("lines.txt")));
    Lines all;
    for (std::string line; std::getline(transcript, line);) {
      const bool question = line == "M115" || line == "M105" || line == "M114" || line.starts_with("M155") ||
                            line.starts_with("M110") || line == "M163 S99 P1";
      if (!question) all.push_back(line);
    }
    return all;
  }

 private:
  TempFolder folder_;
  std::unique_ptr<Child> printer_;
};

/// The lines that lay beads. How often the nozzle stands aside while it waits for planning, and how long it
/// cools at the end, differs from print to print.
Lines beads(const Lines& lines) {
  Lines found;
  std::copy_if(lines.begin(), lines.end(), std::back_inserter(found), [](const std::string& line) {
    return line.starts_with("G1 X") && line.find(" E") != std::string::npos;
  });
  return found;
}

struct Base {
  Lines whole;                               ///< the beads of an undisturbed print
  Lines run;                                 ///< those of the interrupted one
  std::map<std::string, std::string> files;  ///< kept of it
};

/// One print, interrupted by a reset of its printer in its second layer.
const Base& base() {
  static const Base made = [] {
    Base base;
    Place sound({}), cut({"--fault", "reset@line=700"});
    if (sound.print().code != 0 || cut.print().code != 1)
      throw std::runtime_error("the print did not go as it should");
    base.whole = beads(sound.lines());
    base.run = beads(cut.lines());
    const fs::path kept = fs::directory_iterator(cut.path("spool"))->path();
    for (const auto& entry : fs::recursive_directory_iterator(kept)) {
      if (entry.is_regular_file()) base.files[fs::relative(entry.path(), kept)] = read_text(entry.path());
    }
    return base;
  }();
  return made;
}

std::string damaged_somehow(std::string bytes, core::Random& random) {
  if (bytes.empty()) return bytes;
  const std::size_t at = random.below(bytes.size());
  switch (random.below(5)) {
    case 0:
      return bytes.substr(0, at);
    case 1:
      return bytes.substr(0, at) + std::string(bytes.size() - at, '\0');
    case 2:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << random.below(8)));
      return bytes;
    case 3:
      return bytes.replace(at, 1 + random.below(512), random.below(512), '\0');
    default:
      return bytes.substr(0, at) + bytes.substr(random.below(bytes.size()));  // lost or doubled
  }
}

/// Mostly the records; also a copy of the job, and the note that nothing was laid yet, which may come back.
void write_damaged(const fs::path& folder, core::Random& random) {
  std::map<std::string, std::string> files = base().files;
  for (std::size_t left = 1 + random.below(3); left > 0; --left) {
    static const Lines often{"journal", "chunks", "print.json"};
    const std::size_t which = random.below(often.size() + 1);
    const std::string name =
        which < often.size()
            ? often[which]
            : std::next(files.begin(), static_cast<std::ptrdiff_t>(random.below(files.size())))->first;
    files[name] = damaged_somehow(files[name], random);
  }
  for (const auto& [name, bytes] : files) {
    fs::create_directories((folder / name).parent_path());
    std::ofstream(folder / name, std::ios::binary) << bytes;
  }
}

bool is_move(const std::string& line) {
  return line.starts_with("G0 ") || line.starts_with("G1 ") || line.starts_with("G28");
}

/// The greatest number in the program's sentences on lines that are printed again.
std::size_t announced(const std::string& said) {
  std::size_t most = 0;
  for (const char* words : {"next ([0-9]+) lines", "up to ([0-9]+) lines"}) {
    std::smatch match;
    if (std::regex_search(said, match, std::regex(words)))
      most = std::max<std::size_t>(most, std::stoul(match[1]));
  }
  return most;
}

/// The first bead of the whole print with which the resumed one ends.
std::size_t begin_of_end(const Lines& resumed, const Lines& whole) {
  std::size_t same = 0;
  while (same < std::min(resumed.size(), whole.size()) &&
         resumed[resumed.size() - 1 - same] == whole[whole.size() - 1 - same])
    ++same;
  return whole.size() - same;
}

}  // namespace

void kept_print(const fs::path& folder, core::Random& random) {
  const Base& print = base();
  fs::remove_all(folder / "kept");
  write_damaged(folder / "kept", random);
  Place place({});
  fs::create_directories(place.path("spool"));
  fs::copy(folder / "kept", fs::path(place.path("spool")) / "kept", fs::copy_options::recursive);
  const Outcome outcome = place.resume();
  const Lines lines = place.lines();
  if (outcome.code == 2) {
    if (std::any_of(lines.begin(), lines.end(), is_move))
      throw std::runtime_error("refused, and yet it moved");
    throw core::DataError("", "", outcome.err, "");
  }
  if (outcome.code != 0) throw std::runtime_error("it failed: " + outcome.err);
  if (std::count(lines.begin(), lines.end(), "G28") > 0)
    throw std::runtime_error("z was homed onto the part");
  const std::size_t again = begin_of_end(beads(lines), print.whole), run = print.run.size();
  if (again > run) throw std::runtime_error("lines are missing");
  if (run - again > announced(outcome.out) + in_doubt)
    throw std::runtime_error("more lines were repeated than announced");
}

}  // namespace unicursal::test
