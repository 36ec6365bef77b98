#include "host/daemon/kept_prints.hpp"

#include <fcntl.h>
#include <sys/file.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "host/engine/restart.hpp"
#include "host/files/descriptor.hpp"
#include "host/spool/chunk_reader.hpp"
#include "host/spool/spool.hpp"
#include "host/spool/spool_error.hpp"

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// As the lock of host/spool/spool.cpp, for a moment.
bool in_use(const fs::path& folder) {
  const Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_CLOEXEC));
  return descriptor && ::flock(descriptor.get(), LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

/// Empty: it may be continued.
std::string why_not_resumed(const fs::path& folder, const JournalState& journal,
                            const std::string& printing) {
  if (folder.filename() == printing) return "it is being printed";
  if (in_use(folder)) return "it is being printed by another program";
  if (journal.ended && journal.ended->outcome == LegOutcome::completed) return "it was completed";
  if (journal.superseded)
    return "another print has begun on its printer since" +
           (journal.superseded_by.empty() ? "" : ": " + journal.superseded_by);
  return {};
}

}  // namespace

KeptPrint kept_print(const fs::path& folder, const std::string& printing, KeptDetail detail) {
  KeptPrint print;
  print.name = print.job = folder.filename().string();
  try {
    std::ifstream stream(folder / "print.json");
    const json order = json::parse(stream);
    print.job = order.at("name").get<std::string>();
    print.layers = order.at("layer_count").get<std::size_t>();
    const JournalState journal = read_journal(folder / "journal");
    if (detail == KeptDetail::all) {
      if (const auto layer = layer_of(folder / "chunks", journal.furthest)) print.layer = layer->index + 1;
    }
    print.why_not = why_not_resumed(folder, journal, printing);
    print.may_resume = print.why_not.empty();
    print.lost = lost_before(journal).has_value();
  } catch (const json::exception&) {
    print.why_not = "its record is damaged";
  } catch (const SpoolError& error) {
    print.why_not = error.problem();
  }
  return print;
}

std::vector<KeptPrint> list_kept_prints(const fs::path& root, const std::string& printing,
                                        KeptDetail detail) {
  std::vector<KeptPrint> prints;
  for (const fs::path& folder : host::kept_prints(root))
    prints.push_back(kept_print(folder, printing, detail));
  return prints;
}

}  // namespace unicursal::host
