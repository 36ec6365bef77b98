// The history of prints: one row for each, kept until the user removes it. It is the file `history.db` in the
// folder of the prints, an SQLite database (tables `prints` and `filaments`; `PRAGMA user_version` is that of
// the schema). Several programs may use it at once.
//
// A print that cannot be written to it, because another program has locked it or the disk is read-only there,
// waits in the file `history` beside it, a JSON object on each line (past_print.hpp). The next one who opens
// the history takes such lines over, and renames the file to `history.taken`. Older versions of this program
// kept their history in that form. A damaged database is renamed to `history.damaged`, and another begins.
//
//   History history(root, History::For::changing);
//   for (const PastPrint& print : history.list({}, 50)) show(print);
#pragma once

#include <chrono>
#include <functional>

#include "host/history/database.hpp"
#include "host/history/past_print.hpp"

namespace unicursal::host {

class History {
 public:
  static constexpr std::size_t largest_picture = 256 * 1024;  ///< bytes
  static constexpr std::size_t longest_note = 4000;           ///< bytes
  static constexpr std::chrono::seconds usual_patience{5};    ///< with another program's lock

  enum class For {
    reading,  ///< nothing is made where no print has ended yet
    changing
  };
  /// `root`: the folder of the prints. Throws HistoryError.
  History(std::filesystem::path root, For what, std::chrono::milliseconds patience = usual_patience);

  /// What was found and mended meanwhile: sentences for the user.
  const std::vector<std::string>& notes() const { return notes_; }

  /// Adds a print that has ended. If it `goes_on`, a later session of a print has ended, and `print.seconds`
  /// are those of this session: it stays one row, whose filament is the new one. Returns its number. The next
  /// ones throw HistoryError, too. `picture`: PNG, may be empty.
  std::int64_t add(const PastPrint& print, std::string_view picture, bool goes_on);
  /// Whether a print of this name is there.
  bool knows(const std::string& print);
  /// The newest first: at most `most`, whose numbers are below `before`.
  std::vector<PastPrint> list(std::optional<std::int64_t> before, std::size_t most);
  std::optional<PastPrint> find(std::int64_t id);
  PastTotals totals();
  /// PNG; empty: there is none.
  std::string picture(std::int64_t id);
  /// False if no print has that number.
  bool set_note(std::int64_t id, std::string_view note);
  bool remove(std::int64_t id);

  /// Lets a print wait for a history that cannot be written now. Returns whether that went well.
  static bool let_wait(const std::filesystem::path& root, const PastPrint& print, bool goes_on) noexcept;

 private:
  void open();
  void set_aside();
  void take_over();
  void attempt(const std::function<void()>& work);
  bool has_taken(const PastPrint& print);
  std::int64_t add_row(const PastPrint& print, std::string_view picture, bool goes_on);
  std::optional<std::int64_t> newest_named(const std::string& print);
  void put_filaments(std::int64_t id, const PastPrint& print);
  std::vector<PastFilament> filaments_of(std::int64_t id);
  PastPrint row(const Statement& at);

  std::filesystem::path root_;
  std::chrono::milliseconds patience_;
  std::optional<Database> database_;  ///< absent: no print has ended yet
  std::vector<std::string> notes_;
};

}  // namespace unicursal::host
