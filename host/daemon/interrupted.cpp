#include "host/daemon/interrupted.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "host/daemon/state_folder.hpp"
#include "host/spool/journal.hpp"
#include "host/spool/spool_error.hpp"

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

fs::path file_in(const fs::path& state) {
  return state / "printing";
}

bool is_over(const fs::path& folder) {
  std::error_code unknown;
  if (!fs::exists(folder / "journal", unknown)) return true;  // it was removed
  try {
    const JournalState journal = read_journal(folder / "journal");
    return journal.superseded || (journal.ended && journal.ended->outcome != LegOutcome::failed);
  } catch (const SpoolError&) {
    return false;  // damaged: nobody knows
  }
}

}  // namespace

void note_printing(const fs::path& state, const Interrupted& print) {
  const json note = {{"id", print.id}, {"job", print.job}, {"print", print.folder.string()}};
  write_state(file_in(state), note.dump(-1, ' ', false, json::error_handler_t::replace) + "\n");
}

void forget_printing(const fs::path& state) noexcept {
  std::error_code ignored;
  fs::remove(file_in(state), ignored);
}

std::optional<Interrupted> interrupted_print(const fs::path& state) {
  std::ifstream stream(file_in(state));
  const json note = json::parse(stream, nullptr, false);
  if (!note.is_object()) return std::nullopt;
  Interrupted print;
  try {
    print.id = note.at("id").get<std::uint64_t>();
    print.job = note.at("job").get<std::string>();
    print.folder = note.at("print").get<std::string>();
  } catch (const json::exception&) {
    return std::nullopt;
  }
  if (is_over(print.folder)) return std::nullopt;
  return print;
}

}  // namespace unicursal::host
