#include "core/model/stl_reader.hpp"

#include <fmt/format.h>

#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "core/error.hpp"
#include "core/text/file_bytes.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {
namespace {

constexpr std::size_t header_size = 84, record_size = 50;  ///< bytes
constexpr double farthest_vertex = 1e5;                    ///< mm

std::uint32_t little_endian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

std::size_t announced_size(std::string_view bytes) {
  return header_size + record_size * std::size_t{little_endian(bytes, header_size - 4)};
}

/// The bytes of the text without a byte order mark.
std::string_view without_mark(std::string_view bytes) {
  return bytes.starts_with("\xef\xbb\xbf") ? bytes.substr(3) : bytes;
}

std::vector<Triangle> binary_triangles(std::string_view bytes, std::size_t count) {
  std::vector<Triangle> triangles(count);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const std::size_t corners = header_size + i * record_size + 12;  // after the normal
    for (std::size_t k = 0; k < 9; ++k) {
      triangles[i][k / 3][Eigen::Index(k % 3)] =
          double(std::bit_cast<float>(little_endian(bytes, corners + 4 * k)));
    }
  }
  return triangles;
}

class AsciiReader {
 public:
  AsciiReader(std::string_view text, const std::string& file, Warnings& warnings)
      : text_(text), file_(file), warnings_(warnings) {}

  std::vector<Triangle> read() {
    expect("solid");
    skip_name();
    for (std::string word = next(); !word.empty(); word = next()) {
      if (word == "facet") {
        facet();
      } else if (word == "endsolid") {
        skip_name();
        inside_ = false;
      } else if (word == "solid") {
        skip_name();
        inside_ = true;
      } else if (word == "color") {
        skip_name();
      } else {
        refuse("a facet or endsolid should stand here, not " + in_quotes(word));
      }
    }
    if (inside_ && !triangles_.empty()) {
      warnings_.add(fmt::format("{}: the file ends without endsolid; all of its {} facets were read", file_,
                                triangles_.size()));
    }
    return std::move(triangles_);
  }

 private:
  [[noreturn]] void refuse(const std::string& problem) const {
    throw ModelError(file_, fmt::format("line {}", line_), problem, "export the mesh again as binary STL");
  }

  /// Old editors end a text with the byte 26.
  static bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0 || c == '\x1a'; }

  bool at_line_end() const { return text_[at_] == '\n' || text_[at_] == '\r'; }

  void skip_spaces() {
    for (; at_ < text_.size() && is_space(text_[at_]); ++at_) {
      const bool first_of_two = text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n';
      if (at_line_end() && !first_of_two) ++line_;
    }
  }

  /// The next word in lower case; empty at the end.
  std::string next() {
    skip_spaces();
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    return lower(text_.substr(begin, at_ - begin));
  }

  /// Skips the rest of the line, or of a name if facets follow on the same line.
  void skip_name() {
    while (at_ < text_.size()) {
      while (at_ < text_.size() && is_space(text_[at_]) && !at_line_end()) ++at_;
      if (at_ >= text_.size() || at_line_end()) return;
      if (lower(text_.substr(at_, 13)) == "facet normal ") return;
      while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    }
  }

  /// Skips words that say nothing, up to the end of the line or a word of the format.
  void skip_remark() {
    while (true) {
      while (at_ < text_.size() && is_space(text_[at_]) && !at_line_end()) ++at_;
      if (at_ >= text_.size() || at_line_end()) return;
      const std::size_t begin = at_;
      const std::string word = next();
      if (word == "endfacet" || word == "facet" || word == "endsolid" || word == "solid" || word == "color") {
        at_ = begin;
        return;
      }
    }
  }

  void expect(std::string_view word) {
    const std::string found = next();
    if (found == word) return;
    refuse(found.empty() ? fmt::format("the file ends where {} should stand", word)
                         : fmt::format("{} should stand here, not {}", word, in_quotes(found)));
  }

  double number() {
    std::string word = next();
    // Some programs write the comma of their language.
    if (word.find('.') == std::string::npos) {
      if (const auto comma = word.find(','); comma != std::string::npos) word[comma] = '.';
    }
    const char* first = word.data() + (word.starts_with('+') ? 1 : 0);
    double value = 0;
    const auto [end, error] = std::from_chars(first, word.data() + word.size(), value);
    if (error == std::errc::result_out_of_range) return word.find("e-") != std::string::npos ? 0 : HUGE_VAL;
    // Some compilers write NaN as "1.#QNAN", "nan(ind)" and the like.
    if (word.find("nan") != std::string::npos || word.find("#ind") != std::string::npos) return NAN;
    if (word.find("#inf") != std::string::npos) return HUGE_VAL;
    if (error != std::errc{} || end != word.data() + word.size()) {
      refuse(word.empty() ? "the file ends where a number should stand"
                          : in_quotes(word) + " is not a number");
    }
    return value;
  }

  /// A facet of three corners, or of more, which is taken apart.
  void facet() {
    constexpr int longest_normal = 8;  // words; nobody needs the normal, so it may be anything
    std::string word = next();
    for (int i = 0; i < longest_normal && word != "outer" && word != "vertex" && !word.empty(); ++i)
      word = next();
    if (word == "outer") {
      expect("loop");
      word = next();
    }
    std::vector<Vec3> corners;
    for (; word == "vertex"; word = next()) {
      corners.emplace_back();
      for (Eigen::Index k = 0; k < 3; ++k) corners.back()[k] = number();
    }
    const char* const due = corners.size() < 3 ? "vertex" : "endloop";
    if (word != due || corners.size() < 3) {
      refuse(word.empty() ? fmt::format("the file ends where {} should stand", due)
                          : fmt::format("{} should stand here, not {}", due, in_quotes(word)));
    }
    skip_remark();
    expect("endfacet");
    skip_remark();
    for (std::size_t i = 2; i < corners.size(); ++i)
      triangles_.push_back({corners[0], corners[i - 1], corners[i]});
  }

  std::string_view text_;
  const std::string& file_;
  Warnings& warnings_;
  std::vector<Triangle> triangles_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  bool inside_ = true;  ///< between solid and endsolid
};

bool begins_with_solid(std::string_view bytes) {
  const auto first = bytes.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return false;
  return lower(bytes.substr(first, 5)) == "solid";
}

/// How many triangles a binary file holds. If its size is wrong, either whole triangles follow the header,
/// whatever their announced number, or all announced triangles are there and something follows them.
std::size_t binary_count(std::string_view bytes, const std::string& file, Warnings& warnings) {
  const std::string remedy = "export or copy the mesh again";
  if (bytes.size() < header_size) throw ModelError(file, "", "this is too short for an STL file", remedy);
  const std::size_t announced = little_endian(bytes, header_size - 4);
  const std::size_t held = (bytes.size() - header_size) / record_size,
                    rest = (bytes.size() - header_size) % record_size;
  if (held == announced && rest == 0) return held;
  if (held > 0 && (rest == 0 || announced == 0)) {
    warnings.add(fmt::format("{}: its header announces {} triangles; the {} that the file holds were read",
                             file, announced, held));
    return held;
  }
  if (announced > 0 && announced <= held) {
    warnings.add(fmt::format("{}: {} bytes behind its last triangle were not read", file,
                             bytes.size() - announced_size(bytes)));
    return announced;
  }
  throw ModelError(file, "",
                   fmt::format("its header announces {} triangles, {} bytes, but the file has {} bytes",
                               announced, announced_size(bytes), bytes.size()),
                   remedy);
}

std::vector<Triangle> triangles_of(std::string_view bytes, const std::string& file, Warnings& warnings) {
  const bool right_size = bytes.size() >= header_size && bytes.size() == announced_size(bytes);
  // A binary file whose header begins with "solid" is recognised by its zero bytes.
  const std::string_view text = without_mark(bytes);
  if (!right_size && begins_with_solid(text) && text.find('\0') == std::string_view::npos) {
    return AsciiReader(text, file, warnings).read();
  }
  return binary_triangles(bytes, binary_count(bytes, file, warnings));
}

void require_finite(const std::vector<Triangle>& triangles, const std::string& file) {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double farthest = triangles[i][k].cwiseAbs().maxCoeff();
      const bool finite = triangles[i][k].allFinite();
      if (finite && farthest <= farthest_vertex) continue;
      throw ModelError(file, fmt::format("triangle {}, vertex {}", i + 1, k + 1),
                       finite ? "it lies more than 100 m away" : "a coordinate is not a finite number",
                       "repair the mesh or export it again");
    }
  }
}

}  // namespace

std::vector<Triangle> read_stl(const std::filesystem::path& file, Warnings& warnings) {
  const std::string bytes = file_bytes(file);
  std::vector<Triangle> triangles = triangles_of(bytes, file.string(), warnings);
  if (triangles.empty())
    throw ModelError(file.string(), "", "the mesh has no triangles", "export the model again");
  require_finite(triangles, file.string());
  return triangles;
}

}  // namespace unicursal::core
