// An append-only file of records, each with its length and a checksum (CRC-32 of length and content). A
// record that a killed program or a power cut left incomplete at the end is detected and cut off. That is not
// the same as damage further in, behind which more was written: damaged_within() finds that.
//
//   length (4 bytes) · checksum (4 bytes) · content (length bytes, at least one)
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

namespace unicursal::host {

/// The CRC-32 of zip, PNG and Ethernet.
std::uint32_t crc32(std::string_view bytes, std::uint32_t before = 0);

/// The bytes of a record in the file.
std::string framed_record(std::string_view content);

class RecordReader {
 public:
  /// Throws SpoolError if the file cannot be read.
  explicit RecordReader(std::filesystem::path file);

  /// Returns the content of the next record; nullopt at the end and at the first damaged record.
  std::optional<std::string> next();
  /// Whether the file goes on behind the record at which next() has stopped, so that it is damaged and not
  /// only torn. A row of zeros does not count. The first byte of every record is taken to be at most `first`.
  /// Precondition: next() has returned nullopt.
  bool damaged_within(unsigned char first);
  /// Number of bytes of sound records read so far.
  std::uint64_t sound() const { return sound_; }
  /// Lets next() continue at a position. Precondition: sound() has returned this value before.
  void seek(std::uint64_t sound);

 private:
  std::filesystem::path file_;
  std::ifstream stream_;
  std::uint64_t size_ = 0, sound_ = 0;
};

class RecordWriter {
 public:
  /// Makes the file if it is missing, and truncates it to `sound` bytes. `reserve` bytes of the disk are
  /// allocated at once (best effort), so that small records can still be written if the disk is full. Throws
  /// SpoolError.
  RecordWriter(std::filesystem::path file, std::uint64_t sound, std::uint64_t reserve = 0);
  ~RecordWriter();
  RecordWriter(const RecordWriter&) = delete;
  RecordWriter& operator=(const RecordWriter&) = delete;

  /// Writes a record; it then survives the end of this program. Throws SpoolFull.
  void append(std::string_view content);
  /// Syncs the file: all records then survive a power cut, too. Throws SpoolFull.
  void sync();
  /// Removes the last record; best effort. Precondition: a record was appended, and none removed since.
  void drop_last() noexcept;

 private:
  [[noreturn]] void refuse(int error);
  void cut() noexcept;  ///< Truncates the file to `length_`.

  std::filesystem::path file_;
  int descriptor_ = -1;
  std::uint64_t length_, before_last_ = 0;
};

}  // namespace unicursal::host
