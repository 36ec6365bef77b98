// What a terminal's screen shows after the bytes that a program has written: enough of ECMA-48 for this
// program. Characters are taken to be one column wide; colours are counted and dropped.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <vector>

namespace unicursal::test {

class Screen {
 public:
  explicit Screen(std::size_t columns) : columns_(columns) {}

  void feed(const std::string& bytes) {
    for (const char byte : bytes) take(byte);
  }
  /// A terminal that does not break lines again. Lines that are wider than it keep their text.
  void resize(std::size_t columns) { columns_ = columns; }

  /// All rows from the first one on, without blanks at their ends.
  std::vector<std::string> rows() const {
    std::vector<std::string> texts;
    for (const Row& row : rows_) {
      std::string text;
      for (const std::string& cell : row.cells) text += cell;
      text.erase(text.find_last_not_of(' ') + 1);
      texts.push_back(text);
    }
    return texts;
  }
  /// All rows, each with a line end.
  std::string text() const {
    std::string text;
    for (const std::string& row : rows()) text += row + '\n';
    return text;
  }
  /// The last row that begins with this text; empty if none does.
  std::string last_row(const std::string& start) const {
    std::string found;
    for (const std::string& row : rows()) {
      if (row.starts_with(start)) found = row;
    }
    return found;
  }
  /// Rows that went on in the next one since they did not fit.
  std::size_t broken_rows() const { return broken_; }
  /// Changes of colour.
  std::size_t colours() const { return colours_; }
  /// Cursor movements, erasures and changes of colour.
  std::size_t sequences() const { return sequences_; }

 private:
  struct Row {
    std::vector<std::string> cells;
  };

  void take(char byte) {
    if (!sequence_.empty()) return take_sequence(byte);
    if (byte == '\x1b') {
      sequence_ = byte;
    } else if (byte == '\r') {
      column_ = 0;
    } else if (byte == '\n') {
      if (++row_ == rows_.size()) rows_.emplace_back();
    } else if ((static_cast<unsigned char>(byte) & 0xc0U) == 0x80U) {
      if (column_ > 0) rows_[row_].cells[column_ - 1] += byte;
    } else {
      put(byte);
    }
  }
  void put(char byte) {
    if (column_ >= columns_) {
      ++broken_;
      column_ = 0;
      if (++row_ == rows_.size()) rows_.emplace_back();
    }
    std::vector<std::string>& cells = rows_[row_].cells;
    if (cells.size() <= column_) cells.resize(column_ + 1, " ");
    cells[column_++] = std::string(1, byte);
  }
  void take_sequence(char byte) {
    sequence_ += byte;
    const bool ends = sequence_.size() > 2 && byte >= '@' && byte <= '~';
    if (!ends) return;
    ++sequences_;
    const auto count = static_cast<std::size_t>(std::max(1, std::atoi(sequence_.c_str() + 2)));
    std::vector<std::string>& cells = rows_[row_].cells;
    if (byte == 'A') row_ -= std::min(row_, count);
    if ((byte == 'K' || byte == 'J') && cells.size() > column_) cells.resize(column_);
    if (byte == 'J') rows_.resize(row_ + 1);
    if (byte == 'm') ++colours_;
    sequence_.clear();
  }

  std::size_t columns_;
  std::vector<Row> rows_{1};
  std::size_t row_ = 0, column_ = 0;
  std::size_t broken_ = 0, colours_ = 0, sequences_ = 0;
  std::string sequence_;
};

}  // namespace unicursal::test
