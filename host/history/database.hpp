// A database in one file (SQLite 3), as far as the history needs it: statements with values, and errors that
// name a remedy. Belongs to one thread at a time.
//
//   Database database(file, Database::Access::change, std::chrono::seconds(2));
//   Statement find(database, "SELECT job FROM prints WHERE id = ?");
//   find.bind(std::int64_t{7});
//   while (find.step()) show(find.text(0));
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/error.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace unicursal::host {

class HistoryError : public core::DataError {
 public:
  enum class Kind {
    damaged,    ///< the file is not a database, or its pages do not fit together
    busy,       ///< another program has locked it for too long
    full,       ///< the disk is full
    read_only,  ///< the file or its folder cannot be written
    other
  };
  HistoryError(Kind kind, const std::string& file, const std::string& problem, const std::string& remedy)
      : core::DataError(file, "", problem, remedy), kind_(kind) {}
  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

class Database {
 public:
  enum class Access {
    read,   ///< the file must be there
    change  ///< it is made if it is missing, readable by its owner only
  };
  /// `patience`: how long another program's lock is waited for. Throws HistoryError.
  Database(const std::filesystem::path& file, Access access, std::chrono::milliseconds patience);
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  /// Runs statements without values. Throws HistoryError.
  void run(const char* statements);
  std::int64_t last_id() const;
  /// Rows that the last statement has changed.
  std::int64_t changes() const;

 private:
  friend class Statement;
  struct Close {
    void operator()(sqlite3* open) const;
  };
  [[noreturn]] void refuse(int code) const;

  std::filesystem::path file_;
  std::unique_ptr<sqlite3, Close> handle_;
};

class Statement {
 public:
  /// Throws HistoryError, like everything here that asks the database.
  Statement(Database& database, const char* text);

  /// The values of the statement's question marks, in order.
  Statement& bind(std::int64_t value);
  Statement& bind(double value);
  Statement& bind(std::string_view text);
  Statement& bind_bytes(std::string_view bytes);
  Statement& bind_null();
  template <class Value>
  Statement& bind(const std::optional<Value>& value) {
    return value ? bind(*value) : bind_null();
  }
  /// Forgets the row and the values, for the next run.
  void reset();

  /// The next row; false behind the last one.
  bool step();
  bool is_null(int column) const;
  std::int64_t whole(int column) const;
  double number(int column) const;
  /// Also of bytes.
  std::string text(int column) const;
  std::optional<std::int64_t> perhaps_whole(int column) const;
  std::optional<double> perhaps_number(int column) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* made) const;
  };
  void check(int code) const;

  Database& database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
  int bound_ = 0;
};

/// Everything until commit() is done, or nothing. Others may read meanwhile, but not change.
class Transaction {
 public:
  explicit Transaction(Database& database);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Database& database_;
  bool done_ = false;
};

}  // namespace unicursal::host
