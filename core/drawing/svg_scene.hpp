// The third stage of reading a drawing: elements with resolved styles → painted areas in the part's frame.
// The scene walks the tree in painter's order through groups, clones (`use`), symbols, drawings inside the
// drawing and `switch`, and cuts by viewports, clip paths and masks. SVG 1.1, with what is common of SVG 2.
//
// Departures: opacity does not blend, since a bead has one mixture (`Piece::alpha` is handed on); masks and
// gradients of opacity are cut at one half; filters, blend modes and pictures are not drawn; languages are
// compared with English.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/drawing/drawing_notes.hpp"
#include "core/drawing/drawn_gradient.hpp"
#include "core/drawing/fonts.hpp"
#include "core/drawing/shape.hpp"
#include "core/drawing/svg_document.hpp"
#include "core/drawing/svg_frame.hpp"
#include "core/drawing/svg_style.hpp"
#include "core/geometry/region.hpp"

namespace unicursal::core {

/// Strokes thinner than this are lines, not areas, mm.
inline constexpr double hairline = 0.15;
/// What is less opaque than this does not cover what lies below.
inline constexpr double covers_from = 0.5;
/// A clip path, a mask or a marker costs as much as this many elements.
inline constexpr std::size_t price_of_a_cut = 50;

/// An area of one paint.
struct Piece {
  Region region;      ///< not empty
  std::string paint;  ///< "#rrggbb", or "url(#id)" of a gradient or pattern
  double alpha = 1;   ///< opacity, with that of the groups around it
  double light = 0;   ///< luminance of the paint
  bool even = true;   ///< whether opacity and luminance are the same everywhere
  std::shared_ptr<const Names> names;
  pugi::xml_node node;
};

/// A line that is not filled and could be a contour, in the part's frame.
struct Contour {
  Subpath line;
  std::string colour;
};

/// What children take over from the elements around them.
struct Context {
  InheritedStyle style;
  Eigen::Affine2d to_part = Eigen::Affine2d::Identity();
  std::shared_ptr<const Names> names;
  int depth = 0;
  Vec2 viewport{100, 100};  ///< user units
  double opacity = 1;
  std::shared_ptr<const Region> clip;  ///< null: everything is seen
  std::shared_ptr<const InheritedStyle>
      marked;  ///< the style of the clone or of the shape with markers around
};

/// An element, with its style applied to the context.
struct Entered {
  Style style;
  Context context;
};

using Draw = std::function<void(Outline&)>;

class Scene {
 public:
  Scene(const SvgDocument& document, const StyleSheet& sheet, DrawingNotes& notes, bool strokes_are_contours);

  /// Walks through the drawing. Throws ModelError if it is nested too deeply or becomes too large.
  void walk(const Page& page, const Eigen::Matrix2d& turn);
  std::vector<Piece> pieces() { return std::move(pieces_); }
  std::vector<Contour> contours() { return std::move(contours_); }
  std::vector<DrawnGradient> gradients() { return std::move(gradients_); }

 private:
  friend class SvgText;
  enum class Purpose { paint, clip, measure };

  // The walk: svg_scene.cpp.
  void children(const pugi::xml_node& node, const Context& context);
  void element(const pugi::xml_node& node, const Context& context);
  std::optional<Entered> enter(const pugi::xml_node& node, const Context& outer);
  void content(const pugi::xml_node& node, const Entered& entered);
  void choose(const pugi::xml_node& node, const Context& context);
  void clone(const pugi::xml_node& node, const Entered& entered);
  void viewport(const pugi::xml_node& node, const Style& style, Context context, const Vec2& corner,
                const Vec2& size);
  void shape(const pugi::xml_node& node, const Entered& entered);
  void draw(const pugi::xml_node& node, const Entered& entered, Outline& outline);
  bool is_renderable(const pugi::xml_node& node) const;
  Eigen::Affine2d own_transform(const pugi::xml_node& node, const Entered& entered);
  InheritedStyle style_around(const pugi::xml_node& node);
  std::optional<double> optional_length(const pugi::xml_node& node, const Entered& entered, const char* name,
                                        double whole);
  double length_or(const pugi::xml_node& node, const Entered& entered, const char* name, double whole,
                   double otherwise);
  Box box_of(const pugi::xml_node& node, const Entered& entered);
  void spend(const pugi::xml_node& node, std::size_t elements, std::size_t points);
  StyleSource source() { return {document_, sheet_, notes_.sentences()}; }

  // Text: svg_text.cpp.
  void text(const pugi::xml_node& node, const Entered& entered);

  // Areas and their paints: svg_paint.cpp.
  void paint(const pugi::xml_node& node, const Entered& entered, const Draw& draw);
  void fill(const pugi::xml_node& node, const Entered& entered, const Draw& draw);
  void stroke(const pugi::xml_node& node, const Entered& entered, const Draw& draw);
  void cover(Region region, const Paint& paint, double opacity, const pugi::xml_node& node,
             const Entered& entered);
  void serve(Region region, const Paint& paint, double opacity, const pugi::xml_node& node,
             const Entered& entered);
  void note_direction(const pugi::xml_node& node, const struct Gradient& gradient, const Region& region,
                      const Context& context);
  Outline outlined(const pugi::xml_node& node, const Eigen::Affine2d& map, const Draw& draw);
  Region seen(Region region, const Context& context) const;
  void emit(Piece piece, const Context& context);
  static void mark(Context& context, const InheritedStyle& style);
  void markers(const pugi::xml_node& node, const Entered& entered, const Draw& draw);
  void marker(const pugi::xml_node& marker, const Entered& entered, const Vec2& at, double angle, bool first);

  // Cuts: svg_clip.cpp.
  void cut(const pugi::xml_node& node, Entered& entered);
  void narrow(Context& context, Region by) const;
  std::shared_ptr<const Region> clip_region(const pugi::xml_node& clip, const pugi::xml_node& node,
                                            const Entered& entered);
  Region cut_further(Region region, const pugi::xml_node& node, const Entered& entered,
                     const std::string& clip_path, const std::string& mask);
  Region mask_region(const pugi::xml_node& mask, const pugi::xml_node& node, const Entered& entered);
  bool in_use(const pugi::xml_node& node) const;

  /// Marks an element as being drawn.
  class Opened {
   public:
    Opened(std::vector<pugi::xml_node>& open, const pugi::xml_node& node) : open_(open) {
      open_.push_back(node);
    }
    ~Opened() { open_.pop_back(); }
    Opened(const Opened&) = delete;
    Opened& operator=(const Opened&) = delete;

   private:
    std::vector<pugi::xml_node>& open_;
  };

  const SvgDocument& document_;
  const StyleSheet& sheet_;
  DrawingNotes& notes_;
  Fonts fonts_;
  Page page_;
  std::shared_ptr<const Region> page_clip_;  ///< null: nothing is cut off
  Box around_page_;
  bool strokes_are_contours_;
  Purpose purpose_ = Purpose::paint;
  std::vector<Piece> pieces_;  ///< what is painted, or of a clip path
  std::vector<Contour> contours_;
  Eigen::Affine2d measured_from_;  ///< part's frame → frame of the box that is measured
  std::optional<Box> measured_;
  std::vector<pugi::xml_node> open_;  ///< clones, clips, masks and markers that are being drawn
  std::map<std::pair<const void*, std::array<double, 6>>, std::shared_ptr<const Region>> clips_;
  std::vector<const void*> described_;  ///< gradients that have a note
  std::vector<DrawnGradient> gradients_;
  double root_font_size_ = 16;  ///< px
  std::size_t elements_ = 0, points_ = 0;
};

}  // namespace unicursal::core
