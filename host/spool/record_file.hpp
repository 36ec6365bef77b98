// An append-only file of records, each with its length and a checksum (CRC-32 of length and content), so that
// what a killed program or a lost mains left half written is seen and cut off. Everything behind a damaged
// record counts as lost, too: what it depends on is gone.
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

/// A record as it stands in the file.
std::string framed_record(std::string_view content);

class RecordReader {
 public:
  /// Throws SpoolError when the file cannot be read.
  explicit RecordReader(std::filesystem::path file);

  /// The next sound record's content; none at the end and at the first damaged one.
  std::optional<std::string> next();
  /// Bytes of sound records read so far.
  std::uint64_t sound() const { return sound_; }
  /// Where next() reads on. Precondition: a value that sound() had.
  void seek(std::uint64_t sound);

 private:
  std::filesystem::path file_;
  std::ifstream stream_;
  std::uint64_t size_ = 0, sound_ = 0;
};

class RecordWriter {
 public:
  /// Makes the file if it is missing, and cuts what stands behind the first `sound` bytes. `reserve`: room
  /// on the disk that is set aside at once, so that small records can be written when the disk is full; best
  /// effort. Throws SpoolError.
  RecordWriter(std::filesystem::path file, std::uint64_t sound, std::uint64_t reserve = 0);
  ~RecordWriter();
  RecordWriter(const RecordWriter&) = delete;
  RecordWriter& operator=(const RecordWriter&) = delete;

  /// Hands the record to the system: from then on it survives this program. Throws SpoolFull.
  void append(std::string_view content);
  /// From here on what was appended survives the computer, too. Throws SpoolFull.
  void sync();
  /// As if the last record had never been appended; best effort. Precondition: one was, and none dropped
  /// since.
  void drop_last() noexcept;

 private:
  [[noreturn]] void refuse(int error);
  void cut() noexcept;  ///< to `length_`

  std::filesystem::path file_;
  int descriptor_ = -1;
  std::uint64_t length_, before_last_ = 0;
};

}  // namespace unicursal::host
