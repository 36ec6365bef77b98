#include "core/text/xml_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include "core/error.hpp"
#include "core/text/malformed.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {
namespace {

/// Bytes of a node and of an attribute in pugixml 1.13 on 64 bits.
constexpr std::size_t node_size = 64, attribute_size = 40;
constexpr std::size_t most_memory = std::size_t{1536} << 20;  ///< bytes of one document

std::string_view without_xml_space(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

}  // namespace

void refuse_too_many_elements(const std::string& bytes, const std::string& file) {
  // Every node begins with '<', every attribute has a '='.
  const auto nodes = std::size_t(std::count(bytes.begin(), bytes.end(), '<'));
  const auto attributes = std::size_t(std::count(bytes.begin(), bytes.end(), '='));
  if (nodes * node_size + attributes * attribute_size > most_memory) {
    throw ModelError(file, "", fmt::format("it has {} elements, more than can be read", nodes),
                     "simplify the model");
  }
}

void parse_xml(pugi::xml_document& document, std::string& bytes, const std::string& file) {
  refuse_too_many_elements(bytes, file);
  const pugi::xml_parse_result parsed = document.load_buffer_inplace(bytes.data(), bytes.size());
  if (!parsed) {
    throw ModelError(file, fmt::format("byte {}", parsed.offset),
                     fmt::format("this is not well-formed XML ({})", parsed.description()),
                     "save the model again");
  }
}

std::string_view local_name(const char* name) {
  const std::string_view whole = name;
  const auto colon = whole.find(':');
  return colon == std::string_view::npos ? whole : whole.substr(colon + 1);
}

pugi::xml_node child(const pugi::xml_node& node, std::string_view name) {
  for (const pugi::xml_node& inner : node.children()) {
    if (local_name(inner) == name) return inner;
  }
  return {};
}

pugi::xml_attribute attribute(const pugi::xml_node& node, std::string_view name) {
  for (const pugi::xml_attribute& found : node.attributes()) {
    if (local_name(found.name()) == name) return found;
  }
  return {};
}

std::string name_in(std::string_view text) {
  constexpr std::size_t longest = 200;
  if (text.size() <= longest) return std::string(text);
  std::size_t end = longest;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0U) == 0x80U) --end;
  return std::string(text.substr(0, end));
}

double xml_number(std::string_view text) {
  std::string_view word = without_xml_space(text);
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::result_out_of_range && word.find("e-") != std::string_view::npos) return 0;
  if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value)) {
    throw Malformed(in_quotes(text) + " is not a number");
  }
  return value;
}

std::size_t xml_index(std::string_view text) {
  const std::string_view word = without_xml_space(text);
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) {
    throw Malformed(in_quotes(text) + " is not a whole number");
  }
  return value;
}

}  // namespace unicursal::core
