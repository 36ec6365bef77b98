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

bool is_binary(std::string_view bytes) {
  return bytes.size() >= header_size && bytes.size() == announced_size(bytes);
}

std::vector<Triangle> binary_triangles(std::string_view bytes) {
  std::vector<Triangle> triangles((bytes.size() - header_size) / record_size);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const std::size_t corners = header_size + i * record_size + 12;  // behind the normal
    for (std::size_t k = 0; k < 9; ++k) {
      triangles[i][k / 3][Eigen::Index(k % 3)] =
          double(std::bit_cast<float>(little_endian(bytes, corners + 4 * k)));
    }
  }
  return triangles;
}

class AsciiReader {
 public:
  AsciiReader(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  std::vector<Triangle> read() {
    std::vector<Triangle> triangles;
    expect("solid");
    skip_line();
    for (std::string word = next(); !word.empty(); word = next()) {
      if (word == "facet") {
        triangles.push_back(facet());
      } else if (word == "endsolid") {
        skip_line();
        inside_ = false;
      } else if (word == "solid" && !inside_) {
        skip_line();
        inside_ = true;
      } else {
        refuse("a facet or endsolid should stand here, not " + in_quotes(word));
      }
    }
    if (inside_) refuse("the file ends before endsolid");
    return triangles;
  }

 private:
  [[noreturn]] void refuse(const std::string& problem) const {
    throw ModelError(file_, fmt::format("line {}", line_), problem, "export the mesh again as binary STL");
  }

  static bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

  /// The next word in lower case; empty at the end.
  std::string next() {
    while (at_ < text_.size() && is_space(text_[at_])) line_ += text_[at_++] == '\n';
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    return lower(text_.substr(begin, at_ - begin));
  }

  void skip_line() {
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  }

  void expect(std::string_view word) {
    const std::string found = next();
    if (found == word) return;
    refuse(found.empty() ? fmt::format("the file ends where {} should stand", word)
                         : fmt::format("{} should stand here, not {}", word, in_quotes(found)));
  }

  double number() {
    const std::string word = next();
    const char* first = word.data() + (word.starts_with('+') ? 1 : 0);
    double value = 0;
    const auto [end, error] = std::from_chars(first, word.data() + word.size(), value);
    if (error == std::errc::result_out_of_range) return word.find("e-") != std::string::npos ? 0 : HUGE_VAL;
    // "1.#QNAN", "nan(ind)" and the like are how some compilers write what is no number.
    if (word.find("nan") != std::string::npos || word.find("#ind") != std::string::npos) return NAN;
    if (word.find("#inf") != std::string::npos) return HUGE_VAL;
    if (error != std::errc{} || end != word.data() + word.size()) {
      refuse(word.empty() ? "the file ends where a number should stand" : in_quotes(word) + " is no number");
    }
    return value;
  }

  Triangle facet() {
    expect("normal");
    for (int i = 0; i < 3; ++i) number();
    expect("outer");
    expect("loop");
    Triangle triangle;
    for (Vec3& corner : triangle) {
      expect("vertex");
      for (Eigen::Index k = 0; k < 3; ++k) corner[k] = number();
    }
    expect("endloop");
    expect("endfacet");
    return triangle;
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  bool inside_ = true;  ///< of solid … endsolid
};

bool begins_with_solid(std::string_view bytes) {
  const auto first = bytes.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return false;
  return lower(bytes.substr(first, 5)) == "solid";
}

/// Neither size nor text fits: say which of the two it seems to be.
[[noreturn]] void refuse_size(std::string_view bytes, const std::string& file) {
  const std::string remedy = "export or copy the mesh again";
  if (bytes.size() < header_size) throw ModelError(file, "", "this is too short for an STL file", remedy);
  throw ModelError(file, "",
                   fmt::format("its header announces {} triangles, {} bytes, but the file has {} bytes",
                               little_endian(bytes, header_size - 4), announced_size(bytes), bytes.size()),
                   remedy);
}

std::vector<Triangle> triangles_of(std::string_view bytes, const std::string& file) {
  if (is_binary(bytes)) return binary_triangles(bytes);
  // A binary file that begins with "solid" but was cut short is no text: it holds zero bytes.
  const bool text = begins_with_solid(bytes) && bytes.find('\0') == std::string_view::npos;
  if (!text) refuse_size(bytes, file);
  return AsciiReader(bytes, file).read();
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

std::vector<Triangle> read_stl(const std::filesystem::path& file) {
  const std::string bytes = file_bytes(file);
  std::vector<Triangle> triangles = triangles_of(bytes, file.string());
  if (triangles.empty())
    throw ModelError(file.string(), "", "the mesh has no triangles", "export the model again");
  require_finite(triangles, file.string());
  return triangles;
}

}  // namespace unicursal::core
