#include "host/spool/record_file.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "host/spool/bytes.hpp"
#include "host/spool/spool_error.hpp"

namespace unicursal::host {
namespace {

constexpr std::size_t header = 8;  ///< Bytes before a record's content.

std::string length_bytes(std::size_t length) {
  return ByteWriter().put(static_cast<std::uint32_t>(length)).bytes();
}

/// Includes the length, so that a row of zeros is not a valid record.
std::uint32_t checksum(std::string_view content) {
  return crc32(content, crc32(length_bytes(content.size())));
}

std::string why(int error) {
  return std::strerror(error);
}

}  // namespace

std::uint32_t crc32(std::string_view bytes, std::uint32_t before) {
  if (bytes.empty()) return before;  // zlib returns 0 for a null pointer
  return static_cast<std::uint32_t>(
      crc32_z(before, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

std::string framed_record(std::string_view content) {
  return length_bytes(content.size()) + ByteWriter().put(checksum(content)).bytes() + std::string(content);
}

// ---- reading

RecordReader::RecordReader(std::filesystem::path file)
    : file_(std::move(file)), stream_(file_, std::ios::binary) {
  std::error_code error;
  size_ = std::filesystem::file_size(file_, error);
  if (error || !stream_) {
    throw SpoolError(file_.string(), "", "cannot be read", "check that it is there and its permissions");
  }
}

std::optional<std::string> RecordReader::next() {
  if (size_ - sound_ <= header) return std::nullopt;
  std::string head(header, '\0');
  if (!stream_.read(head.data(), header)) return std::nullopt;
  ByteReader numbers(head);
  const std::size_t length = numbers.take<std::uint32_t>();
  const auto expected = numbers.take<std::uint32_t>();
  if (length == 0 || length > size_ - sound_ - header) return std::nullopt;
  std::string content(length, '\0');
  if (!stream_.read(content.data(), static_cast<std::streamsize>(length))) return std::nullopt;
  if (checksum(content) != expected) return std::nullopt;
  sound_ += header + length;
  return content;
}

bool RecordReader::damaged_within(unsigned char first) {
  stream_.clear();
  stream_.seekg(static_cast<std::streamoff>(sound_));
  std::string rest(size_ - sound_, '\0');
  if (!stream_.read(rest.data(), static_cast<std::streamsize>(rest.size()))) return false;
  const std::size_t last = rest.find_last_not_of('\0');
  if (last == std::string::npos) return false;
  const std::string_view all = rest;
  const auto length_at = [&](std::size_t at) -> std::size_t {
    return ByteReader(all.substr(at, 4)).take<std::uint32_t>();
  };
  for (std::size_t at = 0; at + header < all.size(); ++at) {
    const std::size_t length = length_at(at);
    if (length == 0 || length > all.size() - at - header) continue;
    if (at == 0 && header + length <= last) return true;  // something stands behind the damaged record
    if (static_cast<unsigned char>(all[at + header]) > first) continue;
    const auto expected = ByteReader(all.substr(at + 4, 4)).take<std::uint32_t>();
    if (checksum(all.substr(at + header, length)) == expected) return true;
  }
  return false;
}

void RecordReader::seek(std::uint64_t sound) {
  stream_.clear();
  stream_.seekg(static_cast<std::streamoff>(sound));
  sound_ = sound;
}

// ---- writing

RecordWriter::RecordWriter(std::filesystem::path file, std::uint64_t sound, std::uint64_t reserve)
    : file_(std::move(file)),
      descriptor_(::open(file_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600)),
      length_(sound) {
  const auto end = static_cast<off_t>(sound);
  if (descriptor_ < 0 || ::ftruncate(descriptor_, end) != 0 || ::lseek(descriptor_, end, SEEK_SET) != end) {
    const int error = errno;
    if (descriptor_ >= 0) ::close(descriptor_);
    throw SpoolError(file_.string(), "", "cannot be written (" + why(error) + ")",
                     "check the folder, its permissions and that the disk is not full");
  }
  if (reserve > 0) ::fallocate(descriptor_, FALLOC_FL_KEEP_SIZE, end, static_cast<off_t>(reserve));
}

RecordWriter::~RecordWriter() {
  ::close(descriptor_);
}

void RecordWriter::refuse(int error) {
  throw SpoolFull(file_.string(), "", "cannot be written (" + why(error) + ")",
                  "make room on the disk that the print is kept on");
}

void RecordWriter::append(std::string_view content) {
  const std::string bytes = framed_record(content);
  for (std::size_t done = 0; done < bytes.size();) {
    const auto count = ::write(descriptor_, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      const int error = count < 0 ? errno : ENOSPC;
      cut();
      refuse(error);
    }
    done += static_cast<std::size_t>(count);
  }
  before_last_ = std::exchange(length_, length_ + bytes.size());
}

/// If this fails, too, the half record is cut off when the file is read again.
void RecordWriter::cut() noexcept {
  const auto end = static_cast<off_t>(length_);
  if (::ftruncate(descriptor_, end) == 0) ::lseek(descriptor_, end, SEEK_SET);
}

void RecordWriter::drop_last() noexcept {
  length_ = before_last_;
  cut();
}

void RecordWriter::sync() {
  if (::fdatasync(descriptor_) != 0) refuse(errno);
}

}  // namespace unicursal::host
