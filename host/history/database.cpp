#include "host/history/database.hpp"

#include <fcntl.h>
#include <sqlite3.h>

#include "host/files/descriptor.hpp"

namespace unicursal::host {
namespace {

/// SQLite gives its files the permissions of the database, which umask may have left open to all.
void make_private(const std::filesystem::path& file) {
  const Descriptor made(::open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC | O_NOFOLLOW, 0600));
}

}  // namespace

void Database::Close::operator()(sqlite3* open) const {
  sqlite3_close(open);
}

Database::Database(const std::filesystem::path& file, Access access, std::chrono::milliseconds patience)
    : file_(file) {
  if (access == Access::change) make_private(file);
  sqlite3* open = nullptr;
  const int code = sqlite3_open_v2(file.c_str(), &open, SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX, nullptr);
  handle_.reset(open);
  if (code != SQLITE_OK) refuse(code);
  sqlite3_extended_result_codes(handle_.get(), 1);
  sqlite3_busy_timeout(handle_.get(), static_cast<int>(patience.count()));
  // A stranger's file may not call functions of this program.
  sqlite3_db_config(handle_.get(), SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(handle_.get(), SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
}

void Database::refuse(int code) const {
  using enum HistoryError::Kind;
  const std::string file = file_.string();
  const std::string why = handle_ ? sqlite3_errmsg(handle_.get()) : "out of memory";
  switch (code & 0xff) {
    case SQLITE_NOTADB:
    case SQLITE_CORRUPT:
      throw HistoryError(damaged, file, "is damaged (" + why + ")", "move it away; another one is made then");
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      throw HistoryError(busy, file, "is locked by another program", "try again when that has ended");
    case SQLITE_FULL:
      throw HistoryError(full, file, "cannot be written, because the disk is full", "make room");
    case SQLITE_READONLY:
    case SQLITE_PERM:
    case SQLITE_CANTOPEN:
      throw HistoryError(read_only, file, "cannot be opened or written (" + why + ")",
                         "check its permissions and those of its folder");
    default:
      throw HistoryError(other, file, "cannot be used (" + why + ")", "check the disk and the permissions");
  }
}

void Database::run(const char* statements) {
  const int code = sqlite3_exec(handle_.get(), statements, nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) refuse(code);
}

std::int64_t Database::last_id() const {
  return sqlite3_last_insert_rowid(handle_.get());
}

std::int64_t Database::changes() const {
  return sqlite3_changes(handle_.get());
}

// ---- statements

void Statement::Finalize::operator()(sqlite3_stmt* made) const {
  sqlite3_finalize(made);
}

Statement::Statement(Database& database, const char* text) : database_(database) {
  sqlite3_stmt* made = nullptr;
  check(sqlite3_prepare_v2(database.handle_.get(), text, -1, &made, nullptr));
  statement_.reset(made);
}

void Statement::check(int code) const {
  if (code != SQLITE_OK) database_.refuse(code);
}

Statement& Statement::bind(std::int64_t value) {
  check(sqlite3_bind_int64(statement_.get(), ++bound_, value));
  return *this;
}

Statement& Statement::bind(double value) {
  check(sqlite3_bind_double(statement_.get(), ++bound_, value));
  return *this;
}

Statement& Statement::bind(std::string_view text) {
  check(sqlite3_bind_text64(statement_.get(), ++bound_, text.data() ? text.data() : "", text.size(),
                            SQLITE_TRANSIENT, SQLITE_UTF8));
  return *this;
}

Statement& Statement::bind_bytes(std::string_view bytes) {
  check(sqlite3_bind_blob64(statement_.get(), ++bound_, bytes.data(), bytes.size(), SQLITE_TRANSIENT));
  return *this;
}

Statement& Statement::bind_null() {
  check(sqlite3_bind_null(statement_.get(), ++bound_));
  return *this;
}

void Statement::reset() {
  sqlite3_reset(statement_.get());
  sqlite3_clear_bindings(statement_.get());
  bound_ = 0;
}

bool Statement::step() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) database_.refuse(code);
  return false;
}

bool Statement::is_null(int column) const {
  return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL;
}

std::int64_t Statement::whole(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

double Statement::number(int column) const {
  return sqlite3_column_double(statement_.get(), column);
}

std::string Statement::text(int column) const {
  const void* const bytes = sqlite3_column_blob(statement_.get(), column);
  const int size = sqlite3_column_bytes(statement_.get(), column);
  return bytes ? std::string(static_cast<const char*>(bytes), static_cast<std::size_t>(size)) : std::string();
}

std::optional<std::int64_t> Statement::perhaps_whole(int column) const {
  return is_null(column) ? std::nullopt : std::optional(whole(column));
}

std::optional<double> Statement::perhaps_number(int column) const {
  return is_null(column) ? std::nullopt : std::optional(number(column));
}

// ---- transactions

Transaction::Transaction(Database& database) : database_(database) {
  database_.run("BEGIN IMMEDIATE");
}

Transaction::~Transaction() {
  if (done_) return;
  try {
    database_.run("ROLLBACK");
  } catch (const HistoryError&) {
    // SQLite has rolled it back itself, as it does when the disk is full.
  }
}

void Transaction::commit() {
  database_.run("COMMIT");
  done_ = true;
}

}  // namespace unicursal::host
