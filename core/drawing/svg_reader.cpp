#include "core/drawing/svg_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <pugixml.hpp>
#include <string_view>
#include <utility>

#include "core/drawing/outline.hpp"
#include "core/drawing/svg_frame.hpp"
#include "core/drawing/svg_path.hpp"
#include "core/drawing/svg_shapes.hpp"
#include "core/drawing/svg_style.hpp"
#include "core/error.hpp"
#include "core/text/file_bytes.hpp"
#include "core/text/malformed.hpp"

namespace unicursal::core {
namespace {

constexpr int deepest_nesting = 256;  ///< of groups; deeper nesting could overflow the stack

bool any_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string_view local_name(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  return name.substr(0, 4) == "svg:" ? name.substr(4) : name;
}

/// What children inherit from their group.
struct Context {
  Style style;
  Eigen::Affine2d to_part = Eigen::Affine2d::Identity();
  std::vector<std::string> names;
  int depth = 0;
};

class SvgReader {
 public:
  SvgReader(const std::filesystem::path& file, Warnings& warnings, const Eigen::Matrix2d& turn)
      : file_(file.string()), bytes_(file_bytes(file)), warnings_(warnings), turn_(turn) {
    for (std::size_t i = 0; i < bytes_.size(); ++i) {
      if (bytes_[i] == '\n') line_ends_.push_back(std::ptrdiff_t(i));
    }
  }

  std::vector<Shape> read();

 private:
  std::ptrdiff_t line(std::ptrdiff_t offset) const {
    return 1 + (std::lower_bound(line_ends_.begin(), line_ends_.end(), offset) - line_ends_.begin());
  }
  std::string where(const pugi::xml_node& node) const;
  [[noreturn]] void refuse(const pugi::xml_node& node, const std::string& problem,
                           const std::string& remedy) const;

  void children(const pugi::xml_node& node, const Context& context);
  void element(const pugi::xml_node& node, const Context& parent);
  void warn_of_unread(const pugi::xml_node& node, std::string_view name);
  Context entered(const pugi::xml_node& node, const Context& parent);
  void shape(const pugi::xml_node& node, const Context& context);
  void draw(const pugi::xml_node& node, Outline& outline) const;
  std::optional<double> optional_length(const pugi::xml_node& node, const char* name, double whole) const;
  double length_or_zero(const pugi::xml_node& node, const char* name, double whole) const;
  double size(const pugi::xml_node& node, const char* name, double whole) const;

  std::string file_, bytes_;
  std::vector<std::ptrdiff_t> line_ends_;  ///< offsets of the newlines in bytes_
  Warnings& warnings_;
  Eigen::Matrix2d turn_;
  Page page_;
  std::vector<Shape> shapes_;
};

std::string SvgReader::where(const pugi::xml_node& node) const {
  const std::string id = node.attribute("id").value();
  return fmt::format("line {}: <{}{}>", line(node.offset_debug()),
                     std::string(local_name(node)).substr(0, 40), id.empty() ? "" : " id=" + in_quotes(id));
}

void SvgReader::refuse(const pugi::xml_node& node, const std::string& problem,
                       const std::string& remedy) const {
  throw ModelError(file_, where(node), problem, remedy);
}

std::vector<Shape> SvgReader::read() {
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(bytes_.data(), bytes_.size());
  if (!parsed) {
    throw ModelError(file_, fmt::format("line {}", line(parsed.offset)),
                     fmt::format("this is not well-formed XML ({})", parsed.description()),
                     "save the drawing again as SVG");
  }
  const pugi::xml_node root = document.document_element();
  if (local_name(root) != "svg") refuse(root, "this is not an SVG drawing", "save the drawing as SVG");
  Context context;
  try {
    page_ = page({root.attribute("width").value(), root.attribute("height").value(),
                  root.attribute("viewBox").value(), root.attribute("preserveAspectRatio").value()},
                 warnings_);
    context = entered(root, context);
  } catch (const Malformed& problem) {
    refuse(root, problem.what(), "correct the drawing's size");
  }
  context.names.clear();  // the page's own name would match everything
  context.to_part = Eigen::Affine2d(turn_) * page_.to_part * context.to_part;
  if (context.style.displayed) children(root, context);
  return std::move(shapes_);
}

void SvgReader::children(const pugi::xml_node& node, const Context& context) {
  if (context.depth > deepest_nesting) {
    refuse(node, fmt::format("groups are nested more than {} deep", deepest_nesting), "ungroup the drawing");
  }
  for (const pugi::xml_node& child : node.children()) {
    if (child.type() == pugi::node_element) element(child, context);
  }
}

void SvgReader::element(const pugi::xml_node& node, const Context& parent) {
  const std::string_view name = local_name(node);
  const bool group = any_of(name, {"g", "a", "switch"});
  const bool shape_of_its_own = any_of(name, {"path", "rect", "circle", "ellipse", "polygon", "polyline"});
  if (name == "svg")
    refuse(node, "a drawing inside the drawing is not read", "ungroup it in the drawing program");
  if (!group && !shape_of_its_own) return warn_of_unread(node, name);
  try {
    const Context context = entered(node, parent);
    if (!context.style.displayed) return;
    if (group) {
      children(node, context);
    } else if (context.style.filled()) {
      shape(node, context);
    }
  } catch (const Malformed& problem) {
    refuse(node, problem.what(), "correct the element or draw it again");
  }
}

void SvgReader::warn_of_unread(const pugi::xml_node& node, std::string_view name) {
  const bool printable_elsewhere =
      any_of(name, {"use", "text", "image", "foreignObject", "textPath", "tspan"});
  if (printable_elsewhere) {
    warnings_.add(where(node) + " is skipped; convert it to a path if it belongs to the part");
  } else if (name == "style" && !std::string_view(node.child_value()).empty()) {
    warnings_.add(where(node) + ": style sheets are not read; give fills by attributes");
  }
}

Context SvgReader::entered(const pugi::xml_node& node, const Context& parent) {
  Context context;
  context.style = parent.style;
  context.depth = parent.depth + 1;
  for (const char* key : {"color", "fill", "fill-rule", "fill-opacity", "display", "visibility"}) {
    if (const auto attribute = node.attribute(key)) {
      apply_property(context.style, key, attribute.value(), where(node), warnings_);
    }
  }
  if (const auto style = node.attribute("style"))
    apply_style(context.style, style.value(), where(node), warnings_);
  for (const char* key : {"clip-path", "mask"}) {
    if (node.attribute(key)) warnings_.add(fmt::format("{}: its {} is not applied", where(node), key));
  }
  context.to_part = parent.to_part * transform(node.attribute("transform").value());
  for (const char* key : {"id", "inkscape:label", "name"}) {
    if (const auto attribute = node.attribute(key)) context.names.emplace_back(attribute.value());
  }
  context.names.insert(context.names.end(), parent.names.begin(), parent.names.end());
  return context;
}

void SvgReader::shape(const pugi::xml_node& node, const Context& context) {
  Outline outline(context.to_part);
  draw(node, outline);
  Region region = enclosed(outline.rings(), context.style.rule);
  if (region.empty()) return;
  shapes_.push_back({std::move(region), context.style.fill, context.names});
}

void SvgReader::draw(const pugi::xml_node& node, Outline& outline) const {
  const std::string_view name = local_name(node);
  const double w = page_.size.x(), h = page_.size.y(), d = page_.size.norm() / std::sqrt(2.0);
  const Vec2 center(length_or_zero(node, "cx", w), length_or_zero(node, "cy", h));
  if (name == "path") {
    draw_path(node.attribute("d").value(), outline);
  } else if (name == "rect") {
    draw_rect({{length_or_zero(node, "x", w), length_or_zero(node, "y", h)},
               {size(node, "width", w), size(node, "height", h)},
               optional_length(node, "rx", w),
               optional_length(node, "ry", h)},
              outline);
  } else if (name == "circle") {
    draw_ellipse(center, Vec2::Constant(size(node, "r", d)), outline);
  } else if (name == "ellipse") {
    draw_ellipse(center, {size(node, "rx", w), size(node, "ry", h)}, outline);
  } else {
    draw_polygon(node.attribute("points").value(), outline);
  }
}

std::optional<double> SvgReader::optional_length(const pugi::xml_node& node, const char* name,
                                                 double whole) const {
  const std::string_view text = node.attribute(name).value();
  if (text.empty() || text == "auto") return std::nullopt;
  return length(text, whole);
}

double SvgReader::length_or_zero(const pugi::xml_node& node, const char* name, double whole) const {
  return optional_length(node, name, whole).value_or(0);
}

double SvgReader::size(const pugi::xml_node& node, const char* name, double whole) const {
  const double value = length_or_zero(node, name, whole);
  if (value < 0) throw Malformed(fmt::format("{} must not be negative", name));
  return value;
}

}  // namespace

std::vector<Shape> read_svg(const std::filesystem::path& file, Warnings& warnings,
                            const Eigen::Matrix2d& turn) {
  return SvgReader(file, warnings, turn).read();
}

}  // namespace unicursal::core
