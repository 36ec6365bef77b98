// Serves the page: `/`, and its parts below `/assets/`. Anybody may read them, since they hold no secret;
// what the page shows and does, it asks the API for, with the visitor's token.
//
// A browser asks each time whether its copy is still the present one (Cache-Control: no-cache, and a strong
// ETag for each encoding, RFC 9110, 8.8.3), so that a new program and an old page never meet.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "host/http/http_message.hpp"

namespace unicursal::host {

class Page {
 public:
  static constexpr std::string_view assets_path = "/assets/";

  /// Reads the files from this folder whenever they are asked for; absent: takes those of the program.
  explicit Page(std::optional<std::filesystem::path> folder = {}) : folder_(std::move(folder)) {}
  /// For GET and HEAD of `/` or `/assets/NAME`. Throws HttpError 404.
  Response answer(const RequestHead& head) const;

 private:
  std::optional<std::filesystem::path> folder_;
};

}  // namespace unicursal::host
