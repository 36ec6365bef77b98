#include "core/drawing/fonts.hpp"

#include <fontconfig/fontconfig.h>
#include <ft2build.h>
#include <hb-ft.h>

#include <algorithm>
#include <deque>
#include <map>
#include <optional>
#include <utility>
#include FT_FREETYPE_H
#include FT_OUTLINE_H
#include FT_TRUETYPE_TABLES_H

#include "core/text/utf8.hpp"
#include "core/text/xml_document.hpp"

namespace unicursal::core {
namespace {

constexpr std::size_t most_faces = 200;     ///< open at a time
constexpr std::size_t most_requests = 200;  ///< further ones get the first one's fonts
constexpr std::size_t most_fallbacks = 16;  ///< fonts in which a character is looked for

template <class Pointer, auto Destroy>
struct Destroyer {
  void operator()(Pointer pointer) const { Destroy(pointer); }
};
template <class Type, auto Destroy>
using Owned = std::unique_ptr<Type, Destroyer<Type*, Destroy>>;
using FontPattern = Owned<FcPattern, FcPatternDestroy>;
using FontSet = Owned<FcFontSet, FcFontSetDestroy>;
using Buffer = Owned<hb_buffer_t, hb_buffer_destroy>;

std::vector<std::string> family_names(std::string_view list) {
  std::vector<std::string> result;
  while (!list.empty() && result.size() < 20) {
    std::string_view name = list.substr(0, list.find(','));
    list.remove_prefix(std::min(name.size() + 1, list.size()));
    const auto first = name.find_first_not_of(" \t\r\n\"'");
    if (first == std::string_view::npos) continue;
    name = name.substr(first, name.find_last_not_of(" \t\r\n\"'") - first + 1);
    result.push_back(name_in(name));
  }
  return result;
}

bool is_generic(const std::string& family) {
  const std::string name = lower(family);
  return name == "serif" || name == "sans-serif" || name == "monospace" || name == "cursive" ||
         name == "fantasy" || name == "system-ui" || name == "sans" || name == "mono";
}

/// A font file, opened.
struct Face {
  FT_Face face = nullptr;
  hb_font_t* shaper = nullptr;
  double units = 1000;  ///< per font size

  Face() = default;
  Face(const Face&) = delete;
  Face& operator=(const Face&) = delete;
  ~Face() {
    if (shaper) hb_font_destroy(shaper);
    if (face) FT_Done_Face(face);
  }
};

Vec2 point(const FT_Vector* p, const std::pair<const Eigen::Affine2d*, double>& map) {
  return *map.first * Vec2(double(p->x) / map.second, double(p->y) / map.second);
}

/// What FreeType's walk along an outline draws with.
struct Pen {
  Outline& outline;
  std::pair<const Eigen::Affine2d*, double> map;
};

int move_to(const FT_Vector* to, void* user) {
  Pen& pen = *static_cast<Pen*>(user);
  pen.outline.close();
  pen.outline.move_to(point(to, pen.map));
  return 0;
}
int line_to(const FT_Vector* to, void* user) {
  Pen& pen = *static_cast<Pen*>(user);
  pen.outline.line_to(point(to, pen.map));
  return 0;
}
int conic_to(const FT_Vector* control, const FT_Vector* to, void* user) {
  Pen& pen = *static_cast<Pen*>(user);
  pen.outline.quadratic_to(point(control, pen.map), point(to, pen.map));
  return 0;
}
int cubic_to(const FT_Vector* control1, const FT_Vector* control2, const FT_Vector* to, void* user) {
  Pen& pen = *static_cast<Pen*>(user);
  pen.outline.cubic_to(point(control1, pen.map), point(control2, pen.map), point(to, pen.map));
  return 0;
}

struct Decoded {
  char32_t character = 0xfffd;
  std::size_t size = 1;  ///< bytes
};

/// The character at the beginning of a text that is not empty.
Decoded first_character(std::string_view text) {
  const std::size_t size = utf8_size(text);
  if (size == 0) return {};
  const auto byte = [&](std::size_t i) { return char32_t(static_cast<unsigned char>(text[i])); };
  if (size == 1) return {byte(0), 1};
  char32_t character = byte(0) & (0xffU >> (size + 1));
  for (std::size_t i = 1; i < size; ++i) character = character << 6U | (byte(i) & 0x3fU);
  return {character, size};
}

}  // namespace

#ifdef __SANITIZE_ADDRESS__
// fontconfig 2.14 loses 288 bytes when it reads its settings.
extern "C" {
const char* __lsan_default_suppressions();   // NOLINT(bugprone-reserved-identifier)
const char* __lsan_default_options();        // NOLINT(bugprone-reserved-identifier)
const char* __lsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier)
  return "leak:libfontconfig";
}
const char* __lsan_default_options() {  // NOLINT(bugprone-reserved-identifier)
  return "print_suppressions=0";
}
}
#endif

class Fonts::Impl {
 public:
  explicit Impl(Warnings& notes) : notes_(notes) {}
  ~Impl() {
    faces_.clear();
    if (library_) FT_Done_FreeType(library_);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  const std::vector<std::size_t>& candidates(const FontRequest& request);
  std::vector<Glyph> line(std::string_view text, const FontRequest& request);
  const Face& face(std::size_t index) const { return *faces_[index]; }

 private:
  /// Reads the system's settings, which most drawings do not need.
  void begin() {
    if (library_) return;
    FcInit();
    FT_Init_FreeType(&library_);
  }
  std::optional<std::size_t> open(const std::string& file, int index);
  void shape(std::string_view text, std::size_t from, std::size_t to, std::size_t face,
             std::vector<Glyph>& glyphs) const;
  std::optional<std::size_t> face_with(char32_t character, const std::vector<std::size_t>& candidates) const;

  Warnings& notes_;
  FT_Library library_ = nullptr;
  std::vector<std::unique_ptr<Face>> faces_;
  std::map<std::pair<std::string, int>, std::optional<std::size_t>> opened_;
  std::deque<std::pair<FontRequest, std::vector<std::size_t>>> found_;
};

std::optional<std::size_t> Fonts::Impl::open(const std::string& file, int index) {
  const auto known = opened_.find({file, index});
  if (known != opened_.end()) return known->second;
  std::optional<std::size_t> result;
  auto made = std::make_unique<Face>();
  if (faces_.size() < most_faces && library_ &&
      FT_New_Face(library_, file.c_str(), index, &made->face) == 0 && FT_IS_SCALABLE(made->face)) {
    made->units = std::max<double>(1, made->face->units_per_EM);
    FT_Set_Char_Size(made->face, FT_F26Dot6(made->face->units_per_EM) * 64, 0, 72, 72);
    made->shaper = hb_ft_font_create_referenced(made->face);
    hb_ft_font_set_load_flags(made->shaper, FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP);
    result = faces_.size();
    faces_.push_back(std::move(made));
  }
  opened_[{file, index}] = result;
  return result;
}

/// The fonts for a request, the best first.
const std::vector<std::size_t>& Fonts::Impl::candidates(const FontRequest& request) {
  begin();
  const auto known =
      std::find_if(found_.begin(), found_.end(), [&](const auto& entry) { return entry.first == request; });
  if (known != found_.end()) return known->second;
  if (found_.size() >= most_requests) return found_.front().second;
  const FontPattern wanted(FcPatternCreate());
  const std::vector<std::string> families = family_names(request.families);
  const auto bytes = [](const std::string& text) { return reinterpret_cast<const FcChar8*>(text.c_str()); };
  for (const std::string& family : families) FcPatternAddString(wanted.get(), FC_FAMILY, bytes(family));
  FcPatternAddInteger(wanted.get(), FC_WEIGHT, FcWeightFromOpenType(request.weight));
  FcPatternAddInteger(wanted.get(), FC_SLANT, request.italic ? FC_SLANT_ITALIC : FC_SLANT_ROMAN);
  FcPatternAddBool(wanted.get(), FC_SCALABLE, FcTrue);
  FcConfigSubstitute(nullptr, wanted.get(), FcMatchPattern);
  FcDefaultSubstitute(wanted.get());
  FcResult outcome = FcResultMatch;
  const FontSet sorted(FcFontSort(nullptr, wanted.get(), FcTrue, nullptr, &outcome));
  std::vector<std::size_t> result;
  for (int i = 0; sorted && i < sorted->nfont && result.size() < most_fallbacks; ++i) {
    FcChar8* file = nullptr;
    int index = 0;
    if (FcPatternGetString(sorted->fonts[i], FC_FILE, 0, &file) != FcResultMatch) continue;
    FcPatternGetInteger(sorted->fonts[i], FC_INDEX, 0, &index);
    const auto face = open(reinterpret_cast<const char*>(file), index);
    if (!face) continue;
    if (result.empty() && !families.empty() && !is_generic(families.front())) {
      FcChar8* family = nullptr;
      bool same = false;
      for (int k = 0; FcPatternGetString(sorted->fonts[i], FC_FAMILY, k, &family) == FcResultMatch; ++k)
        same = same || lower(reinterpret_cast<const char*>(family)) == lower(families.front());
      if (!same && FcPatternGetString(sorted->fonts[i], FC_FAMILY, 0, &family) == FcResultMatch) {
        notes_.add("the font " + in_quotes(families.front()) + " is not installed; " +
                   in_quotes(reinterpret_cast<const char*>(family)) + " is used instead");
      }
    }
    result.push_back(*face);
  }
  if (result.empty())
    notes_.add("this computer has no fonts, so text is skipped; install some, or convert it to paths");
  found_.emplace_back(request, std::move(result));
  return found_.back().second;
}

std::optional<std::size_t> Fonts::Impl::face_with(char32_t character,
                                                  const std::vector<std::size_t>& candidates) const {
  for (const std::size_t candidate : candidates) {
    if (FT_Get_Char_Index(faces_[candidate]->face, character) != 0) return candidate;
  }
  return std::nullopt;
}

void Fonts::Impl::shape(std::string_view text, std::size_t from, std::size_t to, std::size_t face,
                        std::vector<Glyph>& glyphs) const {
  const Buffer buffer(hb_buffer_create());
  hb_buffer_add_utf8(buffer.get(), text.data(), int(text.size()), unsigned(from), int(to - from));
  hb_buffer_guess_segment_properties(buffer.get());
  hb_shape(faces_[face]->shaper, buffer.get(), nullptr, 0);
  unsigned count = 0;
  const hb_glyph_info_t* infos = hb_buffer_get_glyph_infos(buffer.get(), &count);
  const hb_glyph_position_t* places = hb_buffer_get_glyph_positions(buffer.get(), &count);
  const double unit = faces_[face]->units * 64;
  for (unsigned i = 0; i < count; ++i) {
    glyphs.push_back({face, infos[i].codepoint, Vec2(places[i].x_offset, places[i].y_offset) / unit,
                      places[i].x_advance / unit, infos[i].cluster});
  }
}

std::vector<Glyph> Fonts::Impl::line(std::string_view text, const FontRequest& request) {
  const std::vector<std::size_t>& fonts = candidates(request);
  std::vector<Glyph> glyphs;
  if (fonts.empty()) return glyphs;
  std::size_t run = 0, run_face = fonts.front();
  for (std::size_t at = 0; at < text.size();) {
    const Decoded next = first_character(text.substr(at));
    auto face = face_with(next.character, fonts);
    if (!face) {
      notes_.add("this computer has no font with the character " + in_quotes(text.substr(at, next.size)) +
                 "; convert the text to paths");
      face = run_face;
    }
    // Spaces and marks stay with the letters before them.
    const bool shared =
        next.character == ' ' || FT_Get_Char_Index(faces_[run_face]->face, next.character) != 0;
    if (*face != run_face && !(shared && at > run)) {
      if (at > run) shape(text, run, at, run_face, glyphs);
      run = at;
      run_face = *face;
    }
    at += next.size;
  }
  if (run < text.size()) shape(text, run, text.size(), run_face, glyphs);
  return glyphs;
}

Fonts::Fonts(Warnings& notes) : impl_(std::make_unique<Impl>(notes)) {}
Fonts::~Fonts() = default;

std::vector<Glyph> Fonts::line(std::string_view text, const FontRequest& request) {
  return impl_->line(text, request);
}

FontHeights Fonts::heights(const FontRequest& request) {
  FontHeights result;
  const auto& fonts = impl_->candidates(request);
  if (fonts.empty()) return result;
  const Face& face = impl_->face(fonts.front());
  result.ascent = face.face->ascender / face.units;
  result.descent = face.face->descender / face.units;
  const auto* table = static_cast<const TT_OS2*>(FT_Get_Sfnt_Table(face.face, FT_SFNT_OS2));
  if (table && table->version >= 2 && table->sxHeight > 0) result.x_height = table->sxHeight / face.units;
  return result;
}

void Fonts::draw(const Glyph& glyph, const Eigen::Affine2d& place, Outline& outline) const {
  const Face& face = impl_->face(glyph.face);
  if (FT_Load_Glyph(face.face, glyph.index, FT_LOAD_NO_SCALE | FT_LOAD_NO_BITMAP) != 0) return;
  if (face.face->glyph->format != FT_GLYPH_FORMAT_OUTLINE) return;
  Pen pen{outline, {&place, face.units}};
  FT_Outline_Funcs walk{move_to, line_to, conic_to, cubic_to, 0, 0};
  FT_Outline_Decompose(&face.face->glyph->outline, &walk, &pen);
  outline.close();
}

}  // namespace unicursal::core
