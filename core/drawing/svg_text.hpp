// Text of a drawing: letters are placed as SVG 1.1, chapter 10, says and become outlines. Departures:
// right-to-left writing is laid out by runs; text along paths, from top to bottom, of a given length, and
// decorations are left undone, with a note; spaces are collapsed as in SVG 2.
#pragma once

#include <list>
#include <optional>
#include <string>
#include <vector>

#include "core/drawing/svg_scene.hpp"

namespace unicursal::core {

/// One text element, from its letters to its painted outlines.
class SvgText {
 public:
  SvgText(Scene& scene, const pugi::xml_node& node, const Entered& entered);

  void paint();

 private:
  /// Letters of one element.
  struct Run {
    pugi::xml_node node;
    Entered entered;
    double baseline = 0;  ///< user units upwards
  };
  struct Letter {
    std::string bytes;  ///< one character, UTF-8
    std::size_t run = 0;
    std::optional<double> x, y;
    double dx = 0, dy = 0, turn = 0;  ///< user units, radians
  };
  /// The lists of an element that place its letters.
  struct Places {
    std::size_t first = 0;  ///< letter
    std::vector<double> x, y, dx, dy, turn;
  };
  struct Placed {
    Glyph glyph;
    std::size_t run = 0;
    Vec2 at{0, 0};  ///< on the base line, user units
    double turn = 0;
  };

  void collect(const pugi::xml_node& node, const Entered& entered, double baseline);
  void quote(const pugi::xml_node& node, const Entered& entered, double baseline);
  void add_text(const char* text, std::size_t run);
  void open(const pugi::xml_node& node, const Entered& entered);
  std::vector<double> lengths(const pugi::xml_node& node, const Entered& entered, const char* name,
                              double whole);
  void place_letter(Letter& letter);
  void lay_out();
  std::size_t segment_end(std::size_t from) const;
  void lay_segment(std::size_t from, std::size_t to, Vec2& pen);
  void anchor(std::size_t first_glyph, const Letter& first, double width);
  double base_of(const Style& style);

  Scene& scene_;
  const pugi::xml_node& node_;
  const Entered& entered_;
  std::list<Run> runs_;
  std::vector<const Run*> run_at_;
  std::vector<Letter> letters_;
  std::vector<Places> places_;  ///< of the open elements, the innermost last
  std::vector<Placed> placed_;
  bool after_space_ = true;
};

}  // namespace unicursal::core
