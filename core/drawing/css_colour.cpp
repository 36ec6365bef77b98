#include "core/drawing/css_colour.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "core/text/malformed.hpp"
#include "core/text/number_scanner.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {
namespace {

// CSS Color Module Level 4, section 6.1, in alphabetical order.
constexpr std::array<std::pair<std::string_view, std::uint32_t>, 148> names{{
    {"aliceblue", 0xf0f8ff},
    {"antiquewhite", 0xfaebd7},
    {"aqua", 0x00ffff},
    {"aquamarine", 0x7fffd4},
    {"azure", 0xf0ffff},
    {"beige", 0xf5f5dc},
    {"bisque", 0xffe4c4},
    {"black", 0x000000},
    {"blanchedalmond", 0xffebcd},
    {"blue", 0x0000ff},
    {"blueviolet", 0x8a2be2},
    {"brown", 0xa52a2a},
    {"burlywood", 0xdeb887},
    {"cadetblue", 0x5f9ea0},
    {"chartreuse", 0x7fff00},
    {"chocolate", 0xd2691e},
    {"coral", 0xff7f50},
    {"cornflowerblue", 0x6495ed},
    {"cornsilk", 0xfff8dc},
    {"crimson", 0xdc143c},
    {"cyan", 0x00ffff},
    {"darkblue", 0x00008b},
    {"darkcyan", 0x008b8b},
    {"darkgoldenrod", 0xb8860b},
    {"darkgray", 0xa9a9a9},
    {"darkgreen", 0x006400},
    {"darkgrey", 0xa9a9a9},
    {"darkkhaki", 0xbdb76b},
    {"darkmagenta", 0x8b008b},
    {"darkolivegreen", 0x556b2f},
    {"darkorange", 0xff8c00},
    {"darkorchid", 0x9932cc},
    {"darkred", 0x8b0000},
    {"darksalmon", 0xe9967a},
    {"darkseagreen", 0x8fbc8f},
    {"darkslateblue", 0x483d8b},
    {"darkslategray", 0x2f4f4f},
    {"darkslategrey", 0x2f4f4f},
    {"darkturquoise", 0x00ced1},
    {"darkviolet", 0x9400d3},
    {"deeppink", 0xff1493},
    {"deepskyblue", 0x00bfff},
    {"dimgray", 0x696969},
    {"dimgrey", 0x696969},
    {"dodgerblue", 0x1e90ff},
    {"firebrick", 0xb22222},
    {"floralwhite", 0xfffaf0},
    {"forestgreen", 0x228b22},
    {"fuchsia", 0xff00ff},
    {"gainsboro", 0xdcdcdc},
    {"ghostwhite", 0xf8f8ff},
    {"gold", 0xffd700},
    {"goldenrod", 0xdaa520},
    {"gray", 0x808080},
    {"green", 0x008000},
    {"greenyellow", 0xadff2f},
    {"grey", 0x808080},
    {"honeydew", 0xf0fff0},
    {"hotpink", 0xff69b4},
    {"indianred", 0xcd5c5c},
    {"indigo", 0x4b0082},
    {"ivory", 0xfffff0},
    {"khaki", 0xf0e68c},
    {"lavender", 0xe6e6fa},
    {"lavenderblush", 0xfff0f5},
    {"lawngreen", 0x7cfc00},
    {"lemonchiffon", 0xfffacd},
    {"lightblue", 0xadd8e6},
    {"lightcoral", 0xf08080},
    {"lightcyan", 0xe0ffff},
    {"lightgoldenrodyellow", 0xfafad2},
    {"lightgray", 0xd3d3d3},
    {"lightgreen", 0x90ee90},
    {"lightgrey", 0xd3d3d3},
    {"lightpink", 0xffb6c1},
    {"lightsalmon", 0xffa07a},
    {"lightseagreen", 0x20b2aa},
    {"lightskyblue", 0x87cefa},
    {"lightslategray", 0x778899},
    {"lightslategrey", 0x778899},
    {"lightsteelblue", 0xb0c4de},
    {"lightyellow", 0xffffe0},
    {"lime", 0x00ff00},
    {"limegreen", 0x32cd32},
    {"linen", 0xfaf0e6},
    {"magenta", 0xff00ff},
    {"maroon", 0x800000},
    {"mediumaquamarine", 0x66cdaa},
    {"mediumblue", 0x0000cd},
    {"mediumorchid", 0xba55d3},
    {"mediumpurple", 0x9370db},
    {"mediumseagreen", 0x3cb371},
    {"mediumslateblue", 0x7b68ee},
    {"mediumspringgreen", 0x00fa9a},
    {"mediumturquoise", 0x48d1cc},
    {"mediumvioletred", 0xc71585},
    {"midnightblue", 0x191970},
    {"mintcream", 0xf5fffa},
    {"mistyrose", 0xffe4e1},
    {"moccasin", 0xffe4b5},
    {"navajowhite", 0xffdead},
    {"navy", 0x000080},
    {"oldlace", 0xfdf5e6},
    {"olive", 0x808000},
    {"olivedrab", 0x6b8e23},
    {"orange", 0xffa500},
    {"orangered", 0xff4500},
    {"orchid", 0xda70d6},
    {"palegoldenrod", 0xeee8aa},
    {"palegreen", 0x98fb98},
    {"paleturquoise", 0xafeeee},
    {"palevioletred", 0xdb7093},
    {"papayawhip", 0xffefd5},
    {"peachpuff", 0xffdab9},
    {"peru", 0xcd853f},
    {"pink", 0xffc0cb},
    {"plum", 0xdda0dd},
    {"powderblue", 0xb0e0e6},
    {"purple", 0x800080},
    {"rebeccapurple", 0x663399},
    {"red", 0xff0000},
    {"rosybrown", 0xbc8f8f},
    {"royalblue", 0x4169e1},
    {"saddlebrown", 0x8b4513},
    {"salmon", 0xfa8072},
    {"sandybrown", 0xf4a460},
    {"seagreen", 0x2e8b57},
    {"seashell", 0xfff5ee},
    {"sienna", 0xa0522d},
    {"silver", 0xc0c0c0},
    {"skyblue", 0x87ceeb},
    {"slateblue", 0x6a5acd},
    {"slategray", 0x708090},
    {"slategrey", 0x708090},
    {"snow", 0xfffafa},
    {"springgreen", 0x00ff7f},
    {"steelblue", 0x4682b4},
    {"tan", 0xd2b48c},
    {"teal", 0x008080},
    {"thistle", 0xd8bfd8},
    {"tomato", 0xff6347},
    {"turquoise", 0x40e0d0},
    {"violet", 0xee82ee},
    {"wheat", 0xf5deb3},
    {"white", 0xffffff},
    {"whitesmoke", 0xf5f5f5},
    {"yellow", 0xffff00},
    {"yellowgreen", 0x9acd32},
}};

static_assert(std::is_sorted(names.begin(), names.end()));

// CSS Color Module Level 4, section 6.2, with the values of a light desktop.
constexpr std::array<std::pair<std::string_view, std::uint32_t>, 16> system_colours{{
    {"accentcolor", 0x0078d7},
    {"activetext", 0xff0000},
    {"buttonborder", 0x767676},
    {"buttonface", 0xefefef},
    {"buttontext", 0x000000},
    {"canvas", 0xffffff},
    {"canvastext", 0x000000},
    {"field", 0xffffff},
    {"fieldtext", 0x000000},
    {"graytext", 0x808080},
    {"highlight", 0xb5d5ff},
    {"highlighttext", 0x000000},
    {"linktext", 0x0000ee},
    {"menutext", 0x000000},
    {"visitedtext", 0x551a8b},
    {"windowtext", 0x000000},
}};

static_assert(std::is_sorted(system_colours.begin(), system_colours.end()));

std::string without_spaces_around(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\n\f");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n\f") - first + 1);
}

std::string written(const std::array<double, 3>& shares) {
  std::uint32_t rgb = 0;
  for (const double share : shares) {
    rgb = rgb << 8U | static_cast<std::uint32_t>(std::lround(std::clamp(share, 0.0, 1.0) * 255));
  }
  return fmt::format("#{:06x}", rgb);
}

std::optional<CssColour> from_hex(const std::string& text) {
  std::string digits = text.substr(1);
  if (digits.find_first_not_of("0123456789abcdef") != std::string::npos) return std::nullopt;
  if (digits.size() == 3 || digits.size() == 4) {
    std::string twice;
    for (const char c : digits) twice += {c, c};
    digits = twice;
  }
  if (digits.size() != 6 && digits.size() != 8) return std::nullopt;
  double alpha = 1;
  if (digits.size() == 8) {
    unsigned value = 0;
    std::from_chars(digits.data() + 6, digits.data() + 8, value, 16);
    alpha = value / 255.0;
  }
  return CssColour{"#" + digits.substr(0, 6), alpha};
}

/// CSS Color Module Level 4, section 7.1: hue in degrees, saturation and lightness from 0 to 1.
std::array<double, 3> from_hsl(double hue, double saturation, double lightness) {
  saturation = std::clamp(saturation, 0.0, 1.0);
  lightness = std::clamp(lightness, 0.0, 1.0);
  const auto channel = [&](double n) {
    const double k = std::fmod(n + std::fmod(hue, 360.0) / 30 + 12, 12.0);
    return lightness -
           saturation * std::min(lightness, 1 - lightness) * std::clamp(std::min(k - 3, 9 - k), -1.0, 1.0);
  };
  return {channel(0), channel(8), channel(4)};
}

/// Section 8 of the same.
std::array<double, 3> from_hwb(double hue, double white, double black) {
  white = std::clamp(white, 0.0, 1.0);
  black = std::clamp(black, 0.0, 1.0);
  if (white + black >= 1) return {white / (white + black), white / (white + black), white / (white + black)};
  std::array<double, 3> rgb = from_hsl(hue, 1, 0.5);
  for (double& share : rgb) share = share * (1 - white - black) + white;
  return rgb;
}

/// The arguments of a colour function.
class Arguments {
 public:
  explicit Arguments(NumberScanner& scanner) : scanner_(scanner) {}

  /// A percentage as a share, or a number over `whole`.
  double share(double whole) {
    const double value = scanner_.required();
    if (scanner_.peek() != '%') return value / whole;
    scanner_.advance();
    return value / 100;
  }

  double degrees() {
    const double value = scanner_.required();
    const std::string_view unit = scanner_.word();
    if (unit.empty() || unit == "deg") return value;
    if (unit == "grad") return value * 0.9;
    if (unit == "rad") return value * 180 / std::numbers::pi;
    if (unit == "turn") return value * 360;
    throw Malformed("the hue has an unknown unit");
  }

  double alpha() {
    scanner_.skip_separator();
    if (scanner_.peek() == '/') scanner_.advance();
    scanner_.skip_spaces();
    const double value = scanner_.peek() == ')' ? 1 : share(1);
    scanner_.skip_spaces();
    if (scanner_.peek() != ')' || scanner_.rest().size() != 1) throw Malformed("the colour does not end");
    return std::clamp(value, 0.0, 1.0);
  }

 private:
  NumberScanner& scanner_;
};

CssColour from_function(const std::string& text) {
  NumberScanner scanner(text);
  const std::string_view name = scanner.word();
  if (scanner.peek() != '(') throw Malformed("the colour has no arguments");
  scanner.advance();
  Arguments arguments(scanner);
  std::array<double, 3> rgb{};
  if (name == "rgb" || name == "rgba") {
    for (double& share : rgb) share = arguments.share(255);
  } else if (name == "hsl" || name == "hsla" || name == "hwb") {
    const double hue = arguments.degrees(), second = arguments.share(100), third = arguments.share(100);
    rgb = name == "hwb" ? from_hwb(hue, second, third) : from_hsl(hue, second, third);
  } else {
    throw Malformed("the colour function is unknown");
  }
  return {written(rgb), arguments.alpha()};
}

}  // namespace

std::optional<CssColour> read_css_colour(std::string_view text) {
  const std::string word = without_spaces_around(lower(text));
  if (word.empty()) return std::nullopt;
  if (word == "transparent") return CssColour{"#000000", 0};
  if (word.front() == '#') return from_hex(word);
  if (word.find('(') != std::string::npos) {
    try {
      return from_function(word);
    } catch (const Malformed&) {
      return std::nullopt;
    }
  }
  const auto by_name = [&word](const auto& table) -> std::optional<std::uint32_t> {
    const auto found =
        std::lower_bound(table.begin(), table.end(), word,
                         [](const auto& entry, const std::string& key) { return entry.first < key; });
    if (found == table.end() || found->first != word) return std::nullopt;
    return found->second;
  };
  auto rgb = by_name(names);
  if (!rgb) rgb = by_name(system_colours);
  if (!rgb) return std::nullopt;
  return CssColour{fmt::format("#{:06x}", *rgb), 1};
}

std::optional<std::string> css_colour(std::string_view text) {
  const auto colour = read_css_colour(text);
  if (!colour) return std::nullopt;
  return colour->alpha <= 0 ? "none" : colour->rgb;
}

}  // namespace unicursal::core
