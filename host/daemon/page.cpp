#include "host/daemon/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "core/text/wording.hpp"
#include "host/daemon/plain_name.hpp"
#include "host/files/web_files.hpp"

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest_page_file = 4 * 1024 * 1024;  ///< bytes, in a folder
constexpr std::string_view page_name = "index.html";
constexpr const char* page_policy =
    "default-src 'self'; img-src 'self' data: blob:; connect-src 'self'; frame-ancestors 'none'; "
    "base-uri 'none'; form-action 'self'";

const char* page_type(std::string_view name) {
  constexpr std::pair<std::string_view, const char*> known[] = {{".html", "text/html; charset=utf-8"},
                                                                {".js", "text/javascript; charset=utf-8"},
                                                                {".css", "text/css; charset=utf-8"},
                                                                {".json", "application/json"},
                                                                {".svg", "image/svg+xml"},
                                                                {".png", "image/png"}};
  for (const auto& [ending, type] : known) {
    if (name.ends_with(ending)) return type;
  }
  return "application/octet-stream";
}

HttpError no_such_file() {
  return {404, web_files().empty()
                   ? "this program was built without its page (UNICURSAL_WEB=OFF); its API is "
                     "described in API.md"
                   : "the page has no such file"};
}

/// Whether the client reads gzip (RFC 9110, 12.5.3): named, and without a weight of zero.
bool reads_gzip(const RequestHead& head) {
  const auto offered = head.list("accept-encoding");
  return std::any_of(offered.begin(), offered.end(), [](const std::string& one) {
    const std::size_t end = std::min(one.find_first_of("; \t"), one.size());
    const std::string coding = core::lower(one.substr(0, end)), weight = one.substr(end);
    const bool refused = !weight.empty() && weight.find_first_of("123456789") == std::string::npos;
    return (coding == "gzip" || coding == "*") && !refused;
  });
}

/// RFC 9110, 13.1.2: compared weakly.
bool client_has(const RequestHead& head, const std::string& tag) {
  const auto known = head.list("if-none-match");
  return std::any_of(known.begin(), known.end(), [&](const std::string& one) {
    return one == "*" || one == tag || (one.starts_with("W/") && one.substr(2) == tag);
  });
}

std::string text_of_file(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error) || fs::file_size(file, error) > largest_page_file || error)
    throw HttpError(404, "the folder of --web-folder has no such file, or it is too large");
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

Response Page::answer(const RequestHead& head) const {
  const std::string name = head.path == "/" ? std::string(page_name) : head.path.substr(assets_path.size());
  if (!is_plain_name(name)) throw no_such_file();
  Response response;
  response.type = page_type(name);
  response.headers = {{"Cache-Control", "no-cache"}, {"Vary", "Accept-Encoding"}};
  if (name == page_name) {
    response.headers.emplace_back("Content-Security-Policy", page_policy);
    response.headers.emplace_back("Referrer-Policy", "no-referrer");
  }
  if (folder_) {
    response.body = text_of_file(*folder_ / name);
    return response;
  }
  const WebFile* file = web_file(name);
  if (!file) throw no_such_file();
  const bool packed = reads_gzip(head);
  const std::string tag = fmt::format("\"{}{}\"", file->digest, packed ? "-gzip" : "");
  response.headers.emplace_back("ETag", tag);
  if (client_has(head, tag)) {
    response.status = 304;
    return response;
  }
  if (packed) response.headers.emplace_back("Content-Encoding", "gzip");
  response.body = packed ? std::string(file->packed) : unpacked(*file);
  return response;
}

}  // namespace unicursal::host
