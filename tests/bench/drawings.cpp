// How drawings are read, against pictures by librsvg: for each file of some folders the share of the coloured
// area that has another colour, and whether a note says so.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "tests/core/support/second_opinion.hpp"

namespace fs = std::filesystem;

namespace {

constexpr double agreed = 0.02;  ///< share of the area

std::vector<fs::path> drawings_in(int count, char** names) {
  std::vector<fs::path> files;
  for (int i = 0; i < count; ++i) {
    if (fs::is_regular_file(names[i])) files.emplace_back(names[i]);
    if (!fs::is_directory(names[i])) continue;
    for (const auto& entry : fs::recursive_directory_iterator(names[i])) {
      if (entry.is_regular_file() && entry.path().extension() == ".svg") files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

int main(int argc, char** argv) {
  std::string pattern = (fs::temp_directory_path() / "unicursal-drawings-XXXXXX").string();
  const fs::path folder = mkdtemp(pattern.data());
  std::size_t alike = 0, noted = 0, refused = 0, silent = 0, uncompared = 0;
  for (const fs::path& file : drawings_in(argc - 1, argv + 1)) {
    std::string verdict, reason;
    double difference = 0;
    try {
      const auto opinion = unicursal::test::second_opinion(file, folder);
      difference = opinion.difference;
      // A page without a size says nothing about areas.
      std::vector<std::string> notes = opinion.notes;
      std::erase_if(notes,
                    [](const std::string& note) { return note.find("no width and height") != note.npos; });
      if (!notes.empty()) reason = notes.front();
      if (!opinion.trouble.empty()) {
        verdict = "uncompared", reason = opinion.trouble, ++uncompared;
      } else if (difference <= agreed) {
        verdict = "alike", ++alike;
      } else if (!notes.empty()) {
        verdict = "noted", ++noted;
      } else {
        verdict = "SILENT", ++silent;
      }
    } catch (const unicursal::core::DataError& error) {
      verdict = "refused", reason = error.problem(), ++refused;
    }
    fmt::print("{:10} {:7.2f} %  {}  {}\n", verdict, 100 * difference, file.string(), reason);
  }
  fs::remove_all(folder);
  fmt::print("alike {}, noted {}, refused {}, silently different {}, not compared {}\n", alike, noted,
             refused, silent, uncompared);
}
