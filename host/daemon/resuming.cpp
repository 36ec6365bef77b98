// How a daemon continues a print that is kept, after somebody has read what that will do.
#include <fmt/format.h>

#include "core/error.hpp"
#include "host/daemon/daemon.hpp"
#include "host/daemon/elsewhere.hpp"
#include "host/daemon/kept_prints.hpp"
#include "host/daemon/refused.hpp"
#include "host/engine/produce.hpp"
#include "host/engine/restart.hpp"

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;

constexpr const char* asks_printer =
    "The printer is asked which line comes next. If it is still on and has kept its place and its heat, the "
    "print goes on with that line: none is left out, and none is repeated. Otherwise nothing moves, and you "
    "are asked again.\n";

/// Reads files, and may read the part; blocks. Throws Refused and core::DataError.
std::string outlook(const fs::path& folder, const std::optional<std::string>& port) {
  const KeptPrint kept = kept_print(folder, {}, KeptDetail::all);
  if (!kept.may_resume) throw Refused(Why::conflict, kept.name + " cannot be continued: " + kept.why_not);
  const Spool spool = Spool::open(folder);
  const std::string later = check_not_superseded(spool, port);
  std::string words = fmt::format("{}: layer {} of {}.\n", kept.job, kept.layer, kept.layers);
  if (const auto lost = lost_before(spool.before())) {
    std::optional<LayerRange> range;
    if (const auto& asked = spool.order().layers) range = LayerRange{asked->first, asked->second};
    const auto production = produce(spool.job(), range);
    words += restart_in_words(restart_after(*production, spool, *lost), *lost, spool);
  } else {
    words += asks_printer;
  }
  if (!later.empty())
    words += "A later print, " + later +
             ", has begun on another port. Continue only if that was another printer.\n";
  return words;
}

}  // namespace

void Daemon::check_may_begin() const {
  if (when_idle_) throw Refused(Why::conflict, "ending", "the daemon is ending");
  if (current_) throw Refused(Why::printing, "a print is going on");
  check_not_at_work();
}

asio::awaitable<std::string> Daemon::would_resume(std::string name) {
  check_may_begin();
  const fs::path folder = co_await past_prints_.folder_of(std::move(name));
  if (interrupted_ && interrupted_->folder == folder && !interrupted_->question.empty())
    co_return interrupted_->question;
  const auto look = [folder, port = options_.port] {
    try {
      return outlook(folder, port);
    } catch (const core::DataError& error) {
      throw Refused(Why::conflict, error.what());
    }
  };
  const auto away = [] { return true; };
  co_await elsewhere(ending_, away);  // the print may have ended a moment ago
  co_return co_await elsewhere(looking_, look);
}

asio::awaitable<std::uint64_t> Daemon::resume_kept(std::string name) {
  check_may_begin();
  const fs::path folder = co_await past_prints_.folder_of(std::move(name));
  const auto look = [folder] { return kept_print(folder, {}, KeptDetail::whether); };
  const KeptPrint kept = co_await elsewhere(disk_, look);
  check_may_begin();
  if (!kept.may_resume) throw Refused(Why::conflict, kept.name + " cannot be continued: " + kept.why_not);
  check_port_exists();
  Continuing how{{0, kept.job, folder, {}}, kept.lost};
  if (interrupted_ && interrupted_->folder == folder) {
    how.print = *interrupted_;
    how.sure = kept.lost || !how.print.question.empty();
  }
  if (!queue_.find(how.print.id)) how.print.id = queue_.add(how.print.job, std::nullopt);
  const std::uint64_t id = how.print.id;
  note_printing(options_.state, how.print);
  interrupted_ = how.print;
  begin(id, std::move(how));
  co_return id;
}

}  // namespace unicursal::host
