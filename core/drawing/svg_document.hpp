// The first stage of reading a drawing: bytes → elements. The tree of an SVG file, with its entities put in,
// its lines counted and its ids looked up. The encodings are those of pugixml: UTF-8, UTF-16, UTF-32,
// Latin-1. Departures from XML 1.0: external entities and parameter entities are not read, and a name without
// a declaration stays as it is written.
#pragma once

#include <cstddef>
#include <filesystem>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace unicursal::core {

class SvgDocument {
 public:
  /// Throws FileError, or ModelError for what is not well-formed, or not SVG, or too large.
  explicit SvgDocument(const std::filesystem::path& file);

  pugi::xml_node root() const { return root_; }
  /// The element of this id; empty if the drawing has none.
  pugi::xml_node by_id(std::string_view id) const;
  /// The element that `href` or `xlink:href` of `node` names; empty if it is not one of this drawing.
  pugi::xml_node linked(const pugi::xml_node& node) const;
  /// The name of an element of SVG without its prefix; empty for elements of other vocabularies.
  std::string_view name(const pugi::xml_node& node) const;

  const std::string& file() const { return file_; }
  /// "line 7: <rect id="plate">", for messages.
  std::string where(const pugi::xml_node& node) const;

 private:
  std::ptrdiff_t line(std::ptrdiff_t offset) const;
  void count_lines();

  std::string file_, bytes_;
  std::vector<std::ptrdiff_t> line_ends_;  ///< offsets of the newlines in bytes_
  pugi::xml_document tree_;
  pugi::xml_node root_;
  std::string prefix_;            ///< of the elements of SVG, with its colon; mostly empty
  bool declares_inside_ = false;  ///< whether elements below the root declare vocabularies of their own
  std::unordered_map<std::string_view, pugi::xml_node> ids_;
};

/// The target of "url(#id)", "url('#id')" or "#id"; empty if `text` is neither.
std::string_view id_in(std::string_view text);

/// The value of `href`, or of `xlink:href` if it is absent.
std::string_view link_of(const pugi::xml_node& node);

}  // namespace unicursal::core
