#include "core/drawing/svg_reader.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/drawing/contours.hpp"
#include "core/drawing/css_sheet.hpp"
#include "core/drawing/svg_document.hpp"
#include "core/drawing/svg_scene.hpp"
#include "core/error.hpp"
#include "core/text/malformed.hpp"

namespace unicursal::core {
namespace {

bool is_css(const pugi::xml_node& style) {
  const std::string_view type = style.attribute("type").value();
  return type.empty() || type == "text/css";
}

/// All style sheets of the drawing, in their order.
StyleSheet sheets(const SvgDocument& document, DrawingNotes& notes) {
  StyleSheet result;
  for (pugi::xml_node node = document.root(); node;) {
    if (document.name(node) == "style" && is_css(node)) {
      std::string text;
      for (const pugi::xml_node& child : node.children()) text += child.value();
      result.add(text, document.where(node), notes.sentences());
    }
    if (node.first_child()) {
      node = node.first_child();
      continue;
    }
    while (node && node != document.root() && !node.next_sibling()) node = node.parent();
    node = node == document.root() ? pugi::xml_node{} : node.next_sibling();
  }
  for (const pugi::xml_node& node : document.root().parent().children()) {
    if (node.type() == pugi::node_pi && std::string_view(node.name()) == "xml-stylesheet")
      notes.say(
          "the drawing's style sheet in another file is not read; save the drawing with its styles inside");
  }
  return result;
}

Page page_of(const SvgDocument& document, DrawingNotes& notes) {
  const pugi::xml_node root = document.root();
  try {
    return page({root.attribute("width").value(), root.attribute("height").value(),
                 root.attribute("viewBox").value(), root.attribute("preserveAspectRatio").value()},
                notes.sentences());
  } catch (const Malformed& problem) {
    throw ModelError(document.file(), document.where(root), problem.what(), "correct the drawing's size");
  }
}

/// What covers: faint pieces are left out.
std::vector<Shape> shapes_of(std::vector<Piece> pieces, const SvgDocument& document, DrawingNotes& notes) {
  constexpr double opaque = 0.99;
  std::vector<Shape> result;
  for (Piece& piece : pieces) {
    if (piece.alpha < covers_from) {
      notes.add(Finding::faint, document.where(piece.node));
      continue;
    }
    if (piece.alpha < opaque) notes.add(Finding::translucent, document.where(piece.node));
    result.push_back({std::move(piece.region), std::move(piece.paint), std::move(piece.names)});
  }
  return result;
}

/// The area that the drawing's lines surround, if there is one.
std::vector<Shape> surrounded(const std::vector<Contour>& contours, DrawingNotes& notes) {
  std::vector<Subpath> lines;
  for (const Contour& contour : contours) lines.push_back(contour.line);
  Enclosed found = enclosed_by(lines);
  if (found.open > 0) {
    notes.say(
        fmt::format("{} of the drawing's lines surround no area, and are left out; close them if they are "
                    "contours",
                    found.open));
  }
  if (found.region.empty()) return {};
  return {{std::move(found.region), contours.front().colour, nullptr}};
}

}  // namespace

Drawing read_svg(const std::filesystem::path& file, Warnings& warnings, const DrawingOptions& options) {
  const SvgDocument document(file);
  DrawingNotes notes(warnings);
  try {
    const StyleSheet sheet = sheets(document, notes);
    Scene scene(document, sheet, notes, options.strokes_are_contours);
    const Page page = page_of(document, notes);
    scene.walk(page, options.turn);
    const std::vector<Contour> contours = scene.contours();
    Drawing result;
    result.lines = contours.size();
    result.gradients = scene.gradients();
    if (page.known) result.page = page.paper;
    if (options.strokes_are_contours) result.shapes = surrounded(contours, notes);
    std::vector<Shape> painted = shapes_of(scene.pieces(), document, notes);
    result.shapes.insert(result.shapes.end(), std::make_move_iterator(painted.begin()),
                         std::make_move_iterator(painted.end()));
    notes.finish();
    return result;
  } catch (const Malformed& problem) {
    throw ModelError(file.string(), "", problem.what(), "simplify the drawing");
  }
}

}  // namespace unicursal::core
