// Parses XML files of strangers (pugixml) within a limit of memory, and reads what files of meshes have in
// common.
#pragma once

#include <pugixml.hpp>
#include <string>
#include <string_view>

namespace unicursal::core {

/// Throws ModelError if the tree of such a file would need too much memory.
void refuse_too_many_elements(const std::string& bytes, const std::string& file);

/// Parses in place: the document refers to `bytes`. `file` is for messages. Throws ModelError.
void parse_xml(pugi::xml_document& document, std::string& bytes, const std::string& file);

/// A name without its namespace's prefix.
std::string_view local_name(const char* name);
inline std::string_view local_name(const pugi::xml_node& node) {
  return local_name(node.name());
}

/// The first child or attribute of this local name; empty if there is none.
pugi::xml_node child(const pugi::xml_node& node, std::string_view name);
pugi::xml_attribute attribute(const pugi::xml_node& node, std::string_view name);

/// A name as it is kept for each body: at most 200 bytes of UTF-8. It may be copied ten thousand times.
std::string name_in(std::string_view text);

/// A number in any of XML's spellings. Throws Malformed.
double xml_number(std::string_view text);
/// A whole number from 0 on. Throws Malformed.
std::size_t xml_index(std::string_view text);

}  // namespace unicursal::core
