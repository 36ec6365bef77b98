#include "core/drawing/svg_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "core/drawing/xml_entities.hpp"
#include "core/error.hpp"
#include "core/text/file_bytes.hpp"
#include "core/text/wording.hpp"
#include "core/text/xml_document.hpp"

namespace unicursal::core {
namespace {

constexpr unsigned how_to_parse =
    pugi::parse_default | pugi::parse_doctype | pugi::parse_ws_pcdata | pugi::parse_pi;

bool declares_entities(const pugi::xml_document& tree) {
  const auto nodes = tree.children();
  return std::any_of(nodes.begin(), nodes.end(), [](const pugi::xml_node& node) {
    return node.type() == pugi::node_doctype &&
           std::string_view(node.value()).find("<!ENTITY") != std::string_view::npos;
  });
}

bool reads_as_utf8(const std::string& bytes) {
  return bytes.find('\0') == std::string::npos;
}

constexpr std::string_view svg_vocabulary = "http://www.w3.org/2000/svg";

bool declares(const pugi::xml_node& node) {
  const auto attributes = node.attributes();
  return std::any_of(attributes.begin(), attributes.end(), [](const pugi::xml_attribute& attribute) {
    return std::string_view(attribute.name()).starts_with("xmlns");
  });
}

/// What the prefix of an element stands for (Namespaces in XML 1.0); empty if that is not declared.
std::string_view vocabulary_of(pugi::xml_node node) {
  const std::string_view whole = node.name();
  const auto colon = whole.find(':');
  const std::string key =
      colon == std::string_view::npos ? "xmlns" : "xmlns:" + std::string(whole.substr(0, colon));
  for (; node; node = node.parent()) {
    if (const auto declaration = node.attribute(key.c_str())) return declaration.value();
  }
  return colon == std::string_view::npos ? std::string_view{} : whole.substr(0, colon);
}

}  // namespace

SvgDocument::SvgDocument(const std::filesystem::path& file) : file_(file.string()), bytes_(file_bytes(file)) {
  count_lines();
  refuse_too_many_elements(bytes_, file_);
  pugi::xml_parse_result parsed = tree_.load_buffer(bytes_.data(), bytes_.size(), how_to_parse);
  if (parsed && declares_entities(tree_)) {
    if (!reads_as_utf8(bytes_)) {
      std::ostringstream utf8;
      tree_.save(utf8, "", pugi::format_raw, pugi::encoding_utf8);
      bytes_ = utf8.str();
    }
    bytes_ = with_entities(bytes_, file_);
    count_lines();
    refuse_too_many_elements(bytes_, file_);
    parsed = tree_.load_buffer(bytes_.data(), bytes_.size(), how_to_parse);
  }
  if (!parsed) {
    throw ModelError(file_, fmt::format("line {}", line(parsed.offset)),
                     fmt::format("this is not well-formed XML ({})", parsed.description()),
                     "save the drawing again as SVG");
  }
  root_ = tree_.document_element();
  const std::string_view whole = root_.name();
  if (local_name(root_) != "svg") {
    throw ModelError(file_, where(root_), "this is not an SVG drawing", "save the drawing as SVG");
  }
  prefix_ = whole.substr(0, whole.size() - 3);
  // Depth-first without recursion: the nesting is a stranger's.
  for (pugi::xml_node node = root_; node;) {
    const pugi::xml_attribute id = node.attribute("id");
    if (id && *id.value() != '\0') ids_.emplace(id.value(), node);
    declares_inside_ = declares_inside_ || (node != root_ && declares(node));
    if (node.first_child()) {
      node = node.first_child();
      continue;
    }
    while (node && node != root_ && !node.next_sibling()) node = node.parent();
    node = node == root_ ? pugi::xml_node{} : node.next_sibling();
  }
}

void SvgDocument::count_lines() {
  line_ends_.clear();
  for (std::size_t i = 0; i < bytes_.size(); ++i) {
    if (bytes_[i] == '\n') line_ends_.push_back(std::ptrdiff_t(i));
  }
}

std::ptrdiff_t SvgDocument::line(std::ptrdiff_t offset) const {
  return 1 + (std::lower_bound(line_ends_.begin(), line_ends_.end(), offset) - line_ends_.begin());
}

pugi::xml_node SvgDocument::by_id(std::string_view id) const {
  const auto found = ids_.find(id);
  return found == ids_.end() ? pugi::xml_node{} : found->second;
}

pugi::xml_node SvgDocument::linked(const pugi::xml_node& node) const {
  return by_id(id_in(link_of(node)));
}

std::string_view SvgDocument::name(const pugi::xml_node& node) const {
  if (node.type() != pugi::node_element) return {};
  const std::string_view whole = node.name();
  if (declares_inside_) {
    const std::string_view vocabulary = vocabulary_of(node);
    return vocabulary.empty() || vocabulary == "svg" || vocabulary == svg_vocabulary ? local_name(node)
                                                                                     : std::string_view{};
  }
  if (!prefix_.empty() && whole.starts_with(prefix_)) return whole.substr(prefix_.size());
  if (whole.starts_with("svg:")) return whole.substr(4);
  return prefix_.empty() && whole.find(':') == std::string_view::npos ? whole : std::string_view{};
}

std::string SvgDocument::where(const pugi::xml_node& node) const {
  const std::string id = node.attribute("id").value();
  return fmt::format("line {}: <{}{}>", line(node.offset_debug()),
                     std::string(local_name(node)).substr(0, 40), id.empty() ? "" : " id=" + in_quotes(id));
}

std::string_view id_in(std::string_view text) {
  if (text.starts_with("url(")) {
    const auto end = text.find(')');
    if (end == std::string_view::npos) return {};
    text = text.substr(4, end - 4);
    const auto first = text.find_first_not_of(" \t\r\n'\"");
    if (first == std::string_view::npos) return {};
    text = text.substr(first, text.find_last_not_of(" \t\r\n'\"") - first + 1);
  }
  return text.starts_with('#') ? text.substr(1) : std::string_view{};
}

std::string_view link_of(const pugi::xml_node& node) {
  if (const auto plain = node.attribute("href")) return plain.value();
  return attribute(node, "href").value();
}

}  // namespace unicursal::core
