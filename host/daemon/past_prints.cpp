#include "host/daemon/past_prints.hpp"

#include <algorithm>
#include <asio/post.hpp>

#include "host/daemon/elsewhere.hpp"
#include "host/daemon/kept_prints.hpp"
#include "host/daemon/log.hpp"
#include "host/daemon/refused.hpp"
#include "host/history/csv.hpp"
#include "host/spool/spool.hpp"

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t most_in_table = 100'000;  ///< prints

Refused no_such_print() {
  return {Why::not_found, "no print in the history has that number"};
}

json json_of(const KeptPrint& print) {
  json object = {{"name", print.name},
                 {"job", print.job},
                 {"layer", print.layer},
                 {"layers", print.layers},
                 {"may_resume", print.may_resume}};
  if (print.layers > 0)
    object["percent"] = 100.0 * static_cast<double>(print.layer) / static_cast<double>(print.layers);
  if (!print.why_not.empty()) object["why_not"] = print.why_not;
  return object;
}

}  // namespace

/// Opens the history in the other thread, and does the work there.
template <class Work>
auto PastPrints::with_history(Work work) {
  const auto all = [root = root_, work = std::move(work)] {
    if (root.empty())
      throw Refused(Why::conflict, "this daemon has no folder of prints; start it with --spool");
    try {
      History history(root, History::For::reading);
      for (const std::string& note : history.notes()) log_line(note);
      return work(history);
    } catch (const HistoryError& error) {
      throw Refused(error.kind() == HistoryError::Kind::busy ? Why::busy : Why::no_room, error.what());
    }
  };
  return elsewhere(thread_, all);
}

asio::awaitable<void> PastPrints::settled() {
  const auto done = [] { return true; };
  co_await elsewhere(thread_, done);
}

asio::awaitable<json> PastPrints::list(std::optional<std::int64_t> before, std::size_t most,
                                       std::string printing) {
  const auto read = [=, root = root_](History& history) {
    json prints = json::array();
    const std::vector<KeptPrint> kept = list_kept_prints(root, printing, KeptDetail::whether);
    for (const PastPrint& print : history.list(before, std::min(most, most_at_once))) {
      json one = to_json(print);
      one["can_resume"] = std::any_of(kept.begin(), kept.end(), [&](const KeptPrint& k) {
        return k.may_resume && k.name == print.print;
      });
      prints.push_back(std::move(one));
    }
    return json{{"prints", prints}, {"totals", to_json(history.totals())}};
  };
  co_return co_await with_history(read);
}

asio::awaitable<std::string> PastPrints::csv() {
  const auto read = [](History& history) {
    std::vector<PastPrint> prints = history.list({}, most_in_table);
    std::reverse(prints.begin(), prints.end());
    return csv_of(prints);
  };
  co_return co_await with_history(read);
}

asio::awaitable<std::string> PastPrints::picture(std::int64_t id) {
  std::string bytes = co_await with_history([id](History& history) { return history.picture(id); });
  if (bytes.empty()) throw Refused(Why::not_found, "that print has no picture");
  co_return bytes;
}

asio::awaitable<PastPrint> PastPrints::find(std::int64_t id) {
  const auto found = co_await with_history([id](History& history) { return history.find(id); });
  if (!found) throw no_such_print();
  co_return *found;
}

asio::awaitable<void> PastPrints::set_note(std::int64_t id, std::string note) {
  const auto set = [=](History& history) { return history.set_note(id, note); };
  if (!co_await with_history(set)) throw no_such_print();
}

asio::awaitable<void> PastPrints::remove(std::int64_t id) {
  if (!co_await with_history([id](History& history) { return history.remove(id); })) throw no_such_print();
}

void PastPrints::keep(HistoryEntry entry) {
  asio::post(thread_, [kept = kept_, entry = std::move(entry)]() mutable {
    std::string trouble;
    const KeptInHistory outcome = keep_in_history(std::move(entry));
    for (const std::string& note : outcome.notes) {
      log_line(note);
      if (!outcome.written) trouble += (trouble.empty() ? "" : "; ") + note;
    }
    kept(trouble);
  });
}

asio::awaitable<json> PastPrints::kept(std::string printing) {
  const auto read = [=, root = root_] {
    json prints = json::array();
    for (const KeptPrint& print : list_kept_prints(root, printing, KeptDetail::all))
      prints.push_back(json_of(print));
    return json{{"prints", prints}};
  };
  co_return co_await elsewhere(thread_, read);
}

asio::awaitable<fs::path> PastPrints::folder_of(std::string name) {
  const auto look = [=, root = root_]() -> fs::path {
    fs::path found;
    for (const fs::path& folder : kept_prints(root)) {
      const std::string one = folder.filename().string();
      if (one == name) return folder;
      if (!one.starts_with(name) || name.empty()) continue;
      if (!found.empty()) throw Refused(Why::conflict, "several kept prints have names that begin like that");
      found = folder;
    }
    if (found.empty()) throw Refused(Why::not_found, "no kept print has that name; see GET /api/prints");
    return found;
  };
  co_return co_await elsewhere(thread_, look);
}

}  // namespace unicursal::host
