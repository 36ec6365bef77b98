#include "core/model/zip_archive.hpp"

#include <fmt/format.h>
#include <zip.h>

#include <utility>

#include "core/error.hpp"
#include "core/text/wording.hpp"

namespace unicursal::core {
namespace {

const char* const remedy = "save or download the model again";

}  // namespace

struct ZipArchive::Handle {
  explicit Handle(zip_t* opened) : archive(opened) {}
  ~Handle() { zip_discard(archive); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  zip_t* archive;
};

bool is_zip(std::string_view bytes) {
  return bytes.starts_with("PK\x03\x04") || bytes.starts_with("PK\x05\x06");
}

ZipArchive::ZipArchive(std::string_view bytes, std::string file) : file_(std::move(file)) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  zip_t* archive = source ? zip_open_from_source(source, ZIP_RDONLY, &error) : nullptr;
  if (!archive) {
    const std::string reason = zip_error_strerror(&error);
    zip_source_free(source);
    zip_error_fini(&error);
    throw ModelError(file_, "", "this is not a sound ZIP archive (" + reason + ")", remedy);
  }
  zip_error_fini(&error);
  handle_ = std::make_unique<Handle>(archive);
}

ZipArchive::~ZipArchive() = default;

std::vector<std::string> ZipArchive::names() const {
  std::vector<std::string> result;
  const zip_int64_t count = zip_get_num_entries(handle_->archive, 0);
  for (zip_int64_t i = 0; i < count; ++i) {
    if (const char* name = zip_get_name(handle_->archive, zip_uint64_t(i), ZIP_FL_ENC_RAW))
      result.emplace_back(name);
  }
  return result;
}

std::optional<std::string> ZipArchive::content(const std::string& name) {
  const zip_int64_t index = zip_name_locate(handle_->archive, name.c_str(), ZIP_FL_NOCASE);
  if (index < 0) return std::nullopt;
  zip_file_t* entry = zip_fopen_index(handle_->archive, zip_uint64_t(index), 0);
  if (!entry) throw ModelError(file_, in_quotes(name), "this part of the archive cannot be read", remedy);
  const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> closer(entry, zip_fclose);
  // The size that the archive announces may be a lie, so the bytes are counted as they come.
  std::string bytes;
  constexpr std::size_t piece = 1u << 20;
  while (true) {
    const std::size_t before = bytes.size();
    bytes.resize(before + piece);
    const zip_int64_t got = zip_fread(entry, bytes.data() + before, piece);
    if (got < 0) throw ModelError(file_, in_quotes(name), "this part of the archive is damaged", remedy);
    bytes.resize(before + std::size_t(got));
    if (got == 0) return bytes;
    unpacked_ += std::uint64_t(got);
    if (bytes.size() > largest_unpacked || unpacked_ > most_unpacked) {
      throw ModelError(
          file_, in_quotes(name),
          fmt::format("the archive unpacks to more than {} MiB",
                      (bytes.size() > largest_unpacked ? largest_unpacked : most_unpacked) >> 20),
          "simplify the model, or save it without attachments");
    }
  }
}

}  // namespace unicursal::core
