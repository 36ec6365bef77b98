#include "host/history/history.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "host/files/descriptor.hpp"

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Kind = HistoryError::Kind;

constexpr const char* database_name = "history.db";
constexpr const char* waiting_name = "history";
constexpr std::size_t longest_waiting_line = 256 * 1024;  ///< characters; a longer one is damage
constexpr std::int64_t schema_version = 1;
constexpr std::int64_t most_layers = 10'000'000;  ///< in a range; more is damage

constexpr const char* schema = R"(
  CREATE TABLE prints (
    id INTEGER PRIMARY KEY AUTOINCREMENT,
    print TEXT NOT NULL,
    job TEXT NOT NULL,
    file TEXT NOT NULL,
    first_layer INTEGER, last_layer INTEGER,
    began INTEGER, ended_at INTEGER,
    seconds REAL, foretold REAL,
    ended TEXT NOT NULL, reason TEXT NOT NULL,
    layers_done INTEGER, layers INTEGER,
    currency TEXT NOT NULL,
    warnings TEXT NOT NULL,
    note TEXT NOT NULL DEFAULT '',
    picture BLOB);
  CREATE INDEX prints_by_name ON prints (print);
  CREATE TABLE filaments (
    of_print INTEGER NOT NULL REFERENCES prints (id) ON DELETE CASCADE,
    feeder INTEGER NOT NULL,
    name TEXT NOT NULL, material TEXT NOT NULL, colour TEXT NOT NULL,
    metres REAL NOT NULL, grams REAL NOT NULL, cost REAL);
  CREATE INDEX filaments_of ON filaments (of_print);
  PRAGMA user_version = 1;)";

constexpr const char* columns =
    "SELECT id, print, job, file, first_layer, last_layer, began, ended_at, seconds, foretold, ended, "
    "reason, "
    "layers_done, layers, currency, warnings, note, picture IS NOT NULL FROM prints ";

/// The turn of one program at a time to rename and make files of the history. The system ends it however the
/// program ends.
class HistoryTurn {
 public:
  HistoryTurn(const fs::path& root, std::chrono::milliseconds patience)
      : folder_(::open(root.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (!folder_)
      throw HistoryError(Kind::read_only, root.string(), "cannot be opened", "check its permissions");
    const auto end = std::chrono::steady_clock::now() + patience;
    while (::flock(folder_.get(), LOCK_EX | LOCK_NB) != 0) {
      if (std::chrono::steady_clock::now() > end)
        throw HistoryError(Kind::busy, root.string(), "is locked by another program",
                           "try again when that has ended");
      std::this_thread::sleep_for(pause);
    }
  }

 private:
  static constexpr std::chrono::milliseconds pause{20};
  Descriptor folder_;
};

bool is_there(const fs::path& file) {
  std::error_code unknown;
  return fs::is_regular_file(file, unknown);
}

/// A name beside `wanted` that nobody has yet.
fs::path free_name(const fs::path& wanted) {
  fs::path name = wanted;
  std::error_code unknown;
  for (int more = 2; fs::exists(fs::symlink_status(name, unknown)); ++more)
    name = wanted.string() + "-" + std::to_string(more);
  return name;
}

bool is_sound(const fs::path& file, std::chrono::milliseconds patience) {
  try {
    Database database(file, Database::Access::read, patience);
    Statement check(database, "PRAGMA quick_check(1)");
    return check.step() && check.text(0) == "ok";
  } catch (const HistoryError& error) {
    return error.kind() != Kind::damaged;
  }
}

std::vector<std::string> warnings_in(const std::string& text) {
  const json list = json::parse(text, nullptr, false);
  std::vector<std::string> warnings;
  if (!list.is_array()) return warnings;
  for (const json& one : list) {
    if (one.is_string()) warnings.push_back(one.get<std::string>());
  }
  return warnings;
}

std::string as_text(const std::vector<std::string>& warnings) {
  return json(warnings).dump(-1, ' ', false, json::error_handler_t::replace);
}

std::optional<LayerRange> range_in(const Statement& at, int first, int last) {
  const auto from = at.perhaps_whole(first), to = at.perhaps_whole(last);
  if (!from || !to || *from < 0 || *to < *from || *to > most_layers) return std::nullopt;
  return LayerRange{static_cast<std::size_t>(*from), static_cast<std::size_t>(*to)};
}

std::optional<std::int64_t> end_of(const std::optional<LayerRange>& range, std::size_t LayerRange::*end) {
  return range ? std::optional(static_cast<std::int64_t>((*range).*end)) : std::nullopt;
}

/// Makes the tables, unless another program has just done so. Throws HistoryError for another version.
void prepare_tables(Database& database, const std::string& file) {
  const auto version_of = [&database] {
    Statement version(database, "PRAGMA user_version");
    return version.step() ? version.whole(0) : 0;
  };
  std::int64_t version = version_of();
  if (version == 0) {
    Transaction making(database);
    Statement tables(database, "SELECT count(*) FROM sqlite_master");
    tables.step();
    const bool empty = tables.whole(0) == 0;
    tables.reset();
    version = version_of();
    if (version == 0 && !empty)
      throw HistoryError(Kind::other, file, "is not a history of this program", "move it away");
    if (version == 0) database.run(schema);
    version = version_of();
    making.commit();
  }
  if (version != schema_version)
    throw HistoryError(Kind::other, file, "was made by a later version of this program",
                       "use that version, or move the file away");
}

}  // namespace

History::History(fs::path root, For what, std::chrono::milliseconds patience)
    : root_(std::move(root)), patience_(patience) {
  const bool waiting = is_there(root_ / waiting_name);
  std::error_code unknown;
  if (what == For::reading && !waiting && !is_there(root_ / database_name)) return;
  fs::create_directories(root_, unknown);
  attempt([this] {
    if (!database_) open();
  });
  if (waiting) attempt([this] { take_over(); });
}

void History::open() {
  database_.emplace(root_ / database_name, Database::Access::change, patience_);
  database_->run("PRAGMA foreign_keys = ON");
  prepare_tables(*database_, (root_ / database_name).string());
}

/// Does the work; if the database turns out to be damaged, another takes its place first.
void History::attempt(const std::function<void()>& work) {
  try {
    work();
  } catch (const HistoryError& error) {
    if (error.kind() != Kind::damaged) throw;
    database_.reset();
    set_aside();
    open();
    work();
  }
}

void History::set_aside() {
  const fs::path file = root_ / database_name;
  const HistoryTurn turn(root_, patience_);
  if (is_sound(file, patience_)) return;  // another program has been faster
  const fs::path aside = free_name(root_ / "history.damaged");
  std::error_code error;
  // A journal of it would be taken for one of the next database.
  const fs::path journal = file.string() + "-journal";
  if (is_there(journal)) fs::rename(journal, aside.string() + "-journal", error);
  if (!error) fs::rename(file, aside, error);
  if (error)
    throw HistoryError(Kind::read_only, file.string(),
                       "is damaged and cannot be renamed (" + error.message() + ")",
                       "check the permissions of its folder");
  notes_.push_back(fmt::format("the history of prints was damaged; it is kept as {}, and another one begins",
                               aside.string()));
}

// ---- what waits

bool History::let_wait(const fs::path& root, const PastPrint& print, bool goes_on) noexcept {
  try {
    const HistoryTurn turn(root, usual_patience);
    const fs::path waiting = root / waiting_name;
    const std::uintmax_t before = is_there(waiting) ? fs::file_size(waiting) : 0;
    std::ofstream file(waiting, std::ios::app);
    const std::string line = waiting_line(print, goes_on);
    file.write(line.data(), static_cast<std::streamsize>(line.size()));
    file.flush();
    if (file.good()) return true;
    file.close();
    if (is_there(waiting)) fs::resize_file(waiting, before);  // a part of a line would spoil the next one
    return false;
  } catch (...) {
    return false;
  }
}

void History::take_over() {
  const HistoryTurn turn(root_, patience_);
  if (!is_there(root_ / waiting_name)) return;
  std::ifstream file(root_ / waiting_name);
  std::size_t taken = 0, left = 0;
  {
    Transaction all(*database_);
    for (std::string line; std::getline(file, line);) {
      try {
        if (line.size() > longest_waiting_line) throw std::length_error("a line");
        const WaitingPrint waiting = print_in_line(line);
        if (!has_taken(waiting.print)) add_row(waiting.print, {}, waiting.goes_on);
        ++taken;
      } catch (const HistoryError&) {
        throw;
      } catch (const std::exception&) {
        ++left;
      }
    }
    all.commit();
  }
  const fs::path old = free_name(root_ / "history.taken");
  std::error_code error;
  fs::rename(root_ / waiting_name, old, error);
  if (error)
    throw HistoryError(Kind::read_only, (root_ / waiting_name).string(),
                       "cannot be renamed (" + error.message() + ")", "check the permissions of its folder");
  std::string note =
      fmt::format("{} lines of an older history were taken over; they are kept in {}", taken, old.string());
  if (left > 0) note += fmt::format(", with {} that could not be read", left);
  notes_.push_back(std::move(note));
}

/// A line may come twice, if the file could not be renamed after it had been taken over.
bool History::has_taken(const PastPrint& print) {
  Statement find(*database_, "SELECT 1 FROM prints WHERE print = ? AND ended_at = ?");
  return find.bind(std::string_view(print.print)).bind(print.ended_at).step();
}

// ---- rows

std::int64_t History::add(const PastPrint& print, std::string_view picture, bool goes_on) {
  std::int64_t id = 0;
  attempt([&] {
    Transaction adding(*database_);
    id = add_row(print, picture, goes_on);
    adding.commit();
  });
  return id;
}

std::optional<std::int64_t> History::newest_named(const std::string& print) {
  Statement find(*database_, "SELECT max(id) FROM prints WHERE print = ?");
  find.bind(std::string_view(print)).step();
  return find.perhaps_whole(0);
}

bool History::knows(const std::string& print) {
  bool known = false;
  attempt([&] { known = database_ && newest_named(print).has_value(); });
  return known;
}

std::int64_t History::add_row(const PastPrint& print, std::string_view picture, bool goes_on) {
  PastPrint whole = print;
  const auto before = goes_on ? newest_named(print.print) : std::nullopt;
  if (before) {
    Statement find(*database_, (std::string(columns) + "WHERE id = ?").c_str());
    find.bind(*before).step();
    PastPrint old = row(find);
    const bool known = old.seconds && print.seconds;
    whole.seconds = known ? std::optional(*old.seconds + *print.seconds) : std::nullopt;
    whole.foretold = old.foretold;
    for (const std::string& warning : print.warnings) {
      if (std::find(old.warnings.begin(), old.warnings.end(), warning) == old.warnings.end())
        old.warnings.push_back(warning);
    }
    whole.warnings = std::move(old.warnings);
    if (!old.file.empty()) whole.file = old.file;
    if (old.began) whole.began = old.began;
  }
  Statement put(*database_,
                before
                    ? "UPDATE prints SET print = ?, job = ?, file = ?, first_layer = ?, "
                      "last_layer = ?, began = ?, ended_at = ?, seconds = ?, foretold = ?, ended = ?, "
                      "reason = ?, layers_done = ?, layers = ?, currency = ?, warnings = ?, "
                      "picture = coalesce(?, picture) WHERE id = ?"
                    : "INSERT INTO prints (print, job, file, first_layer, last_layer, began, "
                      "ended_at, seconds, foretold, ended, reason, layers_done, layers, currency, "
                      "warnings, picture, note) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  put.bind(std::string_view(whole.print))
      .bind(std::string_view(whole.job))
      .bind(std::string_view(whole.file));
  put.bind(end_of(whole.range, &LayerRange::first)).bind(end_of(whole.range, &LayerRange::last));
  put.bind(whole.began).bind(whole.ended_at).bind(whole.seconds).bind(whole.foretold);
  put.bind(std::string_view(whole.ended)).bind(std::string_view(whole.reason));
  put.bind(whole.layers_done).bind(whole.layers);
  put.bind(std::string_view(whole.currency)).bind(std::string_view(as_text(whole.warnings)));
  if (picture.empty() || picture.size() > largest_picture)
    put.bind_null();
  else
    put.bind_bytes(picture);
  if (before)
    put.bind(*before);
  else
    put.bind(std::string_view(whole.note));
  put.step();
  const std::int64_t id = before ? *before : database_->last_id();
  put_filaments(id, whole);
  return id;
}

void History::put_filaments(std::int64_t id, const PastPrint& print) {
  Statement clear(*database_, "DELETE FROM filaments WHERE of_print = ?");
  clear.bind(id).step();
  Statement put(*database_,
                "INSERT INTO filaments (of_print, feeder, name, material, colour, metres, grams, cost) "
                "VALUES (?, ?, ?, ?, ?, ?, ?, ?)");
  for (const PastFilament& one : print.filaments) {
    put.bind(id).bind(one.feeder).bind(std::string_view(one.name)).bind(std::string_view(one.material));
    put.bind(std::string_view(one.colour))
        .bind(one.amount.metres)
        .bind(one.amount.grams)
        .bind(one.amount.cost);
    put.step();
    put.reset();
  }
}

std::vector<PastFilament> History::filaments_of(std::int64_t id) {
  Statement find(
      *database_,
      "SELECT feeder, name, material, colour, metres, grams, cost FROM filaments WHERE of_print = ? "
      "ORDER BY feeder, rowid");
  find.bind(id);
  std::vector<PastFilament> filaments;
  while (find.step())
    filaments.push_back({find.whole(0),
                         find.text(1),
                         find.text(2),
                         find.text(3),
                         {find.number(4), find.number(5), find.perhaps_number(6)}});
  return filaments;
}

PastPrint History::row(const Statement& at) {
  PastPrint print;
  print.id = at.whole(0);
  print.print = at.text(1);
  print.job = at.text(2);
  print.file = at.text(3);
  print.range = range_in(at, 4, 5);
  print.began = at.perhaps_whole(6);
  print.ended_at = at.perhaps_whole(7);
  print.seconds = at.perhaps_number(8);
  print.foretold = at.perhaps_number(9);
  print.ended = at.text(10);
  print.reason = at.text(11);
  print.layers_done = at.perhaps_whole(12);
  print.layers = at.perhaps_whole(13);
  print.currency = at.text(14);
  print.warnings = warnings_in(at.text(15));
  print.note = at.text(16);
  print.picture = at.whole(17) != 0;
  print.filaments = filaments_of(print.id);
  return print;
}

std::vector<PastPrint> History::list(std::optional<std::int64_t> before, std::size_t most) {
  std::vector<PastPrint> prints;
  attempt([&] {
    prints.clear();
    if (!database_) return;
    Statement find(*database_,
                   (std::string(columns) + "WHERE ?1 IS NULL OR id < ?1 ORDER BY id DESC LIMIT ?2").c_str());
    find.bind(before).bind(static_cast<std::int64_t>(most));
    while (find.step()) prints.push_back(row(find));
  });
  return prints;
}

std::optional<PastPrint> History::find(std::int64_t id) {
  std::optional<PastPrint> found;
  attempt([&] {
    if (!database_) return;
    Statement find(*database_, (std::string(columns) + "WHERE id = ?").c_str());
    if (find.bind(id).step()) found = row(find);
  });
  return found;
}

PastTotals History::totals() {
  PastTotals totals;
  attempt([&] {
    totals = {};
    if (!database_) return;
    Statement prints(*database_, "SELECT count(*), total(seconds) FROM prints");
    if (prints.step()) totals = {prints.whole(0), prints.number(1), {}};
    // A sum has a cost as long as all its parts that were fed have one.
    Statement find(*database_,
                   "SELECT name, material, colour, total(metres), total(grams), "
                   "CASE WHEN total(grams > 0 AND cost IS NULL) = 0 THEN total(cost) END, currency, "
                   "count(DISTINCT of_print) FROM filaments JOIN prints ON of_print = id "
                   "GROUP BY name, material, colour, currency ORDER BY min(filaments.rowid)");
    while (find.step())
      totals.filaments.push_back({{0,
                                   find.text(0),
                                   find.text(1),
                                   find.text(2),
                                   {find.number(3), find.number(4), find.perhaps_number(5)}},
                                  find.text(6),
                                  find.whole(7)});
  });
  return totals;
}

std::string History::picture(std::int64_t id) {
  std::string bytes;
  attempt([&] {
    if (!database_) return;
    Statement find(*database_, "SELECT picture FROM prints WHERE id = ?");
    if (find.bind(id).step()) bytes = find.text(0);
  });
  return bytes;
}

bool History::set_note(std::int64_t id, std::string_view note) {
  bool found = false;
  attempt([&] {
    if (!database_) return;
    Statement set(*database_, "UPDATE prints SET note = ? WHERE id = ?");
    set.bind(note).bind(id).step();
    found = database_->changes() > 0;
  });
  return found;
}

bool History::remove(std::int64_t id) {
  bool found = false;
  attempt([&] {
    if (!database_) return;
    Statement drop(*database_, "DELETE FROM prints WHERE id = ?");
    drop.bind(id).step();
    found = database_->changes() > 0;
  });
  return found;
}

}  // namespace unicursal::host
