#include "firmware_gcode/sliced/line_source.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/error.hpp"

namespace unicursal::gcode {
namespace {

constexpr std::size_t block = 1 << 16;

}  // namespace

LineSource::LineSource(std::istream& file, std::string name) : file_(file), name_(std::move(name)) {}

bool LineSource::fill() {
  buffer_.resize(block);
  file_.read(buffer_.data(), static_cast<std::streamsize>(block));
  buffer_.resize(static_cast<std::size_t>(file_.gcount()));
  at_ = 0;
  if (file_.bad())
    throw core::FileError(name_, "", "cannot be read to its end", "check the disk, and copy the file again");
  if (bytes_ == 0 && buffer_.starts_with("\xef\xbb\xbf")) at_ = 3;  // a byte order mark
  if (bytes_ == 0 && buffer_.starts_with("GCDE")) {
    throw core::DataError(name_, "", "is binary G-code",
                          "switch binary G-code off in the slicer's printer settings, and slice again");
  }
  if (bytes_ == 0 && buffer_.starts_with("PK\x03\x04")) {
    throw core::DataError(name_, "", "is a zip archive and not G-code",
                          "export plain G-code from the slicer, or take the .gcode file out of the archive");
  }
  bytes_ += buffer_.size();
  return !buffer_.empty();
}

/// Adds a piece of the line, and cuts off what is too long of a comment.
void LineSource::take(std::string_view piece) {
  if (!in_comment_) {
    const auto begins = piece.find(';');
    in_comment_ = begins != std::string_view::npos;
    const std::size_t command = line_.size() + (in_comment_ ? begins : piece.size());
    if (command > longest_command) {
      throw core::DataError(name_, fmt::format("line {}", number_ + 1),
                            fmt::format("has a command of more than {} characters", longest_command),
                            "check that the file is G-code, and slice again");
    }
  }
  const std::size_t room =
      longest_command + longest_comment - std::min(line_.size(), longest_command + longest_comment);
  line_.append(piece.substr(0, room));
}

void LineSource::check(std::string_view line) const {
  if (line.find('\0') == std::string_view::npos) return;
  throw core::DataError(name_, fmt::format("line {}", number_), "has a byte that no text has",
                        "check that the file is G-code, and slice again");
}

std::optional<std::string_view> LineSource::next() {
  line_.clear();
  in_comment_ = false;
  bool any = false;
  while (at_ < buffer_.size() || fill()) {
    any = true;
    const auto end = buffer_.find('\n', at_);
    take(std::string_view(buffer_).substr(at_, end == std::string::npos ? std::string::npos : end - at_));
    at_ = end == std::string::npos ? buffer_.size() : end + 1;
    if (end != std::string::npos) break;
  }
  if (!any) return std::nullopt;
  ++number_;
  while (!line_.empty() && line_.back() == '\r') line_.pop_back();
  check(line_);
  return line_;
}

}  // namespace unicursal::gcode
