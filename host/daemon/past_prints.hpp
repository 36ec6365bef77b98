// The daemon's view of prints that have ended: the history, and those that are kept and may be continued.
// Files are read and changed in a thread of its own; the rest belongs to the loop's thread. Everything throws
// Refused.
#pragma once

#include <asio/awaitable.hpp>
#include <asio/thread_pool.hpp>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "host/history/history.hpp"
#include "host/history/keep.hpp"

namespace unicursal::host {

class PastPrints {
 public:
  static constexpr std::size_t most_at_once = 200;  ///< prints in one answer

  /// `root`: the folder of the prints; empty: there is none. `kept`: is called in the other thread when a
  /// print has been added, with a sentence if that did not go well.
  PastPrints(std::filesystem::path root, std::function<void(const std::string& trouble)> kept)
      : root_(std::move(root)), kept_(std::move(kept)) {}
  ~PastPrints() { thread_.join(); }

  /// As in API.md: `prints`, the newest first, and `totals`. `printing`: the name of the print that is going
  /// on; may be empty.
  asio::awaitable<nlohmann::json> list(std::optional<std::int64_t> before, std::size_t most,
                                       std::string printing);
  asio::awaitable<std::string> csv();
  asio::awaitable<std::string> picture(std::int64_t id);
  asio::awaitable<PastPrint> find(std::int64_t id);
  asio::awaitable<void> set_note(std::int64_t id, std::string note);
  asio::awaitable<void> remove(std::int64_t id);
  /// Adds a print that has ended, in the other thread; may be called from any.
  void keep(HistoryEntry entry);
  /// When what was asked for so far is done.
  asio::awaitable<void> settled();
  /// `prints`: those that are kept, the newest first.
  asio::awaitable<nlohmann::json> kept(std::string printing);
  /// The folder of a kept print: by its name, or the only one that begins so.
  asio::awaitable<std::filesystem::path> folder_of(std::string name);

 private:
  template <class Work>
  auto with_history(Work work);

  const std::filesystem::path root_;
  const std::function<void(const std::string& trouble)> kept_;
  asio::thread_pool thread_{1};
};

}  // namespace unicursal::host
