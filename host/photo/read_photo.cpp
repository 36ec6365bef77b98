#include "host/photo/read_photo.hpp"

#include <jpeglib.h>
// After jpeglib.h, whose words it needs.
#include <jerror.h>
#include <png.h>

#include <array>
#include <csetjmp>
#include <cstring>
#include <fstream>
#include <memory>
#include <optional>
#include <span>

#include "core/error.hpp"
#include "host/photo/exif.hpp"

namespace unicursal::host {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t most_bytes = 256 << 20, most_pixels = 200'000'000;
constexpr const char* save_again = "save it as JPEG or PNG, or take it again";

Bytes bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file))
    throw core::FileError(file.string(), "", "cannot be read", "check the name and permissions");
  Bytes bytes;
  std::array<char, 65536> part;
  while (stream.read(part.data(), part.size()), stream.gcount() > 0) {
    bytes.insert(bytes.end(), part.begin(), part.begin() + stream.gcount());
    if (bytes.size() > most_bytes)
      throw core::DataError(file.string(), "", "is larger than 256 MiB", "save it as JPEG");
  }
  return bytes;
}

bool begins(std::span<const std::uint8_t> bytes, std::string_view beginning, std::size_t at = 0) {
  return bytes.size() >= at + beginning.size() &&
         std::memcmp(bytes.data() + at, beginning.data(), beginning.size()) == 0;
}

[[noreturn]] void damaged(const std::filesystem::path& file) {
  throw core::DataError(file.string(), "", "is damaged", save_again);
}

void check_size(std::size_t width, std::size_t height, const std::filesystem::path& file) {
  if (width > 0 && height > 0 && width <= most_pixels / height) return;
  throw core::DataError(file.string(), "", "has more than 200 million pixels", "save it smaller");
}

/// libjpeg's own way to report errors ends the program; this one returns to where setjmp was called.
struct JpegErrors {
  jpeg_error_mgr manager;
  std::jmp_buf back;
  bool broken = false;  ///< a part of the picture is missing or damaged
};

void leave(j_common_ptr jpeg) {
  std::longjmp(reinterpret_cast<JpegErrors*>(jpeg->err)->back, 1);
}

void stay_silent(j_common_ptr) {}

/// Not every warning means that something is missing: many cameras leave a few bytes too many.
void note_damage(j_common_ptr jpeg, int level) {
  if (level >= 0) return;
  const int code = jpeg->err->msg_code;
  if (code == JWRN_JPEG_EOF || code == JWRN_HIT_MARKER || code == JWRN_HUFF_BAD_CODE ||
      code == JWRN_ARITH_BAD_CODE)
    reinterpret_cast<JpegErrors*>(jpeg->err)->broken = true;
}

/// Progressive files can hold any number of scans.
constexpr int most_scans = 200;

void count_scans(j_common_ptr jpeg) {
  if (reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number > most_scans) leave(jpeg);
}

/// A file that is being decoded. Between setjmp and a possible longjmp no object with a destructor is made.
class Jpeg {
 public:
  explicit Jpeg(const Bytes& bytes) : bytes_(bytes) {
    jpeg_.err = jpeg_std_error(&errors_.manager);
    errors_.manager.error_exit = leave;
    errors_.manager.output_message = stay_silent;
    errors_.manager.emit_message = note_damage;
    progress_.progress_monitor = count_scans;
  }
  ~Jpeg() { jpeg_destroy_decompress(&jpeg_); }
  Jpeg(const Jpeg&) = delete;
  Jpeg& operator=(const Jpeg&) = delete;

  bool read_header() {
    if (setjmp(errors_.back) != 0) return false;
    jpeg_create_decompress(&jpeg_);
    jpeg_.progress = &progress_;
    jpeg_save_markers(&jpeg_, JPEG_APP0 + 1, 0xFFFF);
    jpeg_mem_src(&jpeg_, bytes_.data(), bytes_.size());
    jpeg_read_header(&jpeg_, TRUE);
    jpeg_.out_color_space = JCS_RGB;
    return true;
  }
  /// Red, green and blue, or grey: not the inks of a printing press.
  bool has_light() const { return jpeg_.num_components == 3 || jpeg_.num_components == 1; }

  std::size_t width() const { return jpeg_.image_width; }
  std::size_t height() const { return jpeg_.image_height; }

  int orientation() const {
    for (const jpeg_marker_struct* marker = jpeg_.marker_list; marker != nullptr; marker = marker->next) {
      const std::span data(marker->data, marker->data_length);
      if (begins(data, {"Exif\0\0", 6})) return orientation_in(data.subspan(6));
    }
    return 1;
  }

  /// Rows of red, green and blue, one byte each.
  bool read_pixels(std::uint8_t* to) {
    if (setjmp(errors_.back) != 0) return false;
    jpeg_start_decompress(&jpeg_);
    while (jpeg_.output_scanline < jpeg_.output_height) {
      JSAMPROW row = to + std::size_t{3} * jpeg_.output_width * jpeg_.output_scanline;
      jpeg_read_scanlines(&jpeg_, &row, 1);
    }
    return !errors_.broken;
  }

 private:
  const Bytes& bytes_;
  JpegErrors errors_{};
  jpeg_progress_mgr progress_{};
  jpeg_decompress_struct jpeg_{};
};

static_assert(sizeof(picture::Colour) == 3);

Photo jpeg_in(const Bytes& bytes, const std::filesystem::path& file) {
  Jpeg jpeg(bytes);
  if (!jpeg.read_header()) damaged(file);
  if (!jpeg.has_light())
    throw core::DataError(file.string(), "", "is a JPEG of printing inks (CMYK)", "save it as RGB");
  check_size(jpeg.width(), jpeg.height(), file);
  Photo photo(jpeg.width(), jpeg.height());
  if (!jpeg.read_pixels(&photo.at(0, 0).r)) damaged(file);
  return upright(std::move(photo), jpeg.orientation());
}

/// Chunks of a PNG file are: length, type, data, check sum.
int orientation_of_png(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t signature = 8, around = 12;
  for (std::size_t at = signature; bytes.size() - at >= around;) {
    const std::size_t length = std::size_t{bytes[at]} << 24 | std::size_t{bytes[at + 1]} << 16 |
                               std::size_t{bytes[at + 2]} << 8 | bytes[at + 3];
    if (length > bytes.size() - at - around) return 1;
    if (begins(bytes, "eXIf", at + 4)) return orientation_in(bytes.subspan(at + 8, length));
    at += around + length;
  }
  return 1;
}

Photo png_in(const Bytes& bytes, const std::filesystem::path& file) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  const std::unique_ptr<png_image, void (*)(png_image*)> freed(&image, png_image_free);
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) damaged(file);
  check_size(image.width, image.height, file);
  image.format = PNG_FORMAT_RGB;
  Photo photo(image.width, image.height);
  const png_color white{255, 255, 255};
  if (png_image_finish_read(&image, &white, &photo.at(0, 0).r, 0, nullptr) == 0) damaged(file);
  return upright(std::move(photo), orientation_of_png(bytes));
}

}  // namespace

Photo read_photo(const std::filesystem::path& file) {
  const Bytes bytes = bytes_of(file);
  if (begins(bytes, "\xFF\xD8")) return jpeg_in(bytes, file);
  if (begins(bytes, "\x89PNG\r\n\x1A\n")) return png_in(bytes, file);
  const bool heic = begins(bytes, "ftyp", 4);
  throw core::DataError(file.string(), "", heic ? "is a HEIC picture" : "is not a JPEG or PNG picture",
                        save_again);
}

}  // namespace unicursal::host
