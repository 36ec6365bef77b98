#include "core/drawing/svg_path.hpp"

#include <fmt/format.h>

#include <numbers>

#include "core/text/malformed.hpp"
#include "core/text/number_scanner.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {
namespace {

class PathReader {
 public:
  PathReader(std::string_view text, Outline& outline) : scanner_(text), outline_(outline) {}

  void read() {
    scanner_.skip_spaces();
    while (!scanner_.at_end()) {
      next_command();
      draw();
      scanner_.skip_spaces();
    }
  }

 private:
  char upper() const { return relative() ? static_cast<char>(command_ - 'a' + 'A') : command_; }
  bool relative() const { return command_ >= 'a'; }

  /// Reads a command letter, or keeps the last command if its arguments repeat.
  void next_command() {
    const char before = command_;
    if (before != '\0') scanner_.skip_separator();
    if (before != '\0' && upper() != 'Z' && scanner_.starts_number()) {
      if (before == 'M') command_ = 'L';
      if (before == 'm') command_ = 'l';
      return;
    }
    command_ = scanner_.peek();
    if (std::string_view("MmLlHhVvCcSsQqTtAaZz").find(command_) == std::string_view::npos ||
        command_ == '\0') {
      throw Malformed(fmt::format("character {} should be a path command but is {}", scanner_.position() + 1,
                                  in_quotes(scanner_.rest())));
    }
    if (before == '\0' && upper() != 'M') throw Malformed("the path does not start with M");
    scanner_.advance();
  }

  Vec2 origin() const { return relative() ? outline_.pen() : Vec2(0, 0); }

  Vec2 pair() {
    const double x = scanner_.required();
    const double y = scanner_.required();
    return {x, y};
  }
  Vec2 point() { return origin() + pair(); }

  /// The control point mirrored at the pen, for S after C or S and for T after Q or T.
  Vec2 mirrored(char kind) const {
    return last_curve_ == kind ? Vec2(2 * outline_.pen() - control_) : outline_.pen();
  }

  void draw() {
    char curve = '\0';
    switch (upper()) {
      case 'M':
        outline_.move_to(point());
        break;
      case 'L':
        outline_.line_to(point());
        break;
      case 'H':
        outline_.line_to({origin().x() + scanner_.required(), outline_.pen().y()});
        break;
      case 'V':
        outline_.line_to({outline_.pen().x(), origin().y() + scanner_.required()});
        break;
      case 'C':
        cubic(point()), curve = 'C';
        break;
      case 'S':
        cubic(mirrored('C')), curve = 'C';
        break;
      case 'Q':
        quadratic(point()), curve = 'Q';
        break;
      case 'T':
        quadratic(mirrored('Q')), curve = 'Q';
        break;
      case 'A':
        arc();
        break;
      default:
        outline_.close();
    }
    last_curve_ = curve;
  }

  void cubic(const Vec2& first) {
    control_ = point();
    outline_.cubic_to(first, control_, point());
  }

  void quadratic(const Vec2& control) {
    control_ = control;
    outline_.quadratic_to(control, point());
  }

  void arc() {
    const Vec2 radii = pair();
    const double rotation = scanner_.required() * std::numbers::pi / 180;
    const bool large = scanner_.flag();
    const bool sweep = scanner_.flag();
    outline_.arc_to(radii, rotation, large, sweep, point());
  }

  NumberScanner scanner_;
  Outline& outline_;
  char command_ = '\0';
  char last_curve_ = '\0';  ///< 'C' or 'Q' when the last command left a control point
  Vec2 control_{0, 0};
};

}  // namespace

std::optional<std::string> draw_path(std::string_view text, Outline& outline) {
  if (text == "none") return std::nullopt;
  try {
    PathReader(text, outline).read();
  } catch (const TooFar&) {
    throw;
  } catch (const Malformed& mistake) {
    return mistake.what();
  }
  return std::nullopt;
}

}  // namespace unicursal::core
