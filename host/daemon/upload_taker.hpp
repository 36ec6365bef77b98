// Takes a form with one file, as slicers send it, and writes the file to the disk while it arrives. Of the
// fields it knows `print` and `select` (OctoPrint's documentation, docs/api/files.rst); `path`, the folder
// that the client would like, and all others are read and left aside: uploads have no folders here.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "host/daemon/daemon.hpp"
#include "host/http/form_reader.hpp"
#include "host/http/http_server.hpp"

namespace unicursal::host {

class UploadTaker final : public BodyTaker, private FormTaker {
 public:
  /// `length`: bytes of the form. `daemon` must outlive the use of this object, not the object.
  UploadTaker(Daemon& daemon, const std::string& boundary, std::uint64_t length)
      : daemon_(daemon), reader_(boundary, *this), length_(length) {}

  asio::awaitable<void> take(std::string bytes) override;

  struct Upload {
    std::shared_ptr<UploadDraft> draft;
    std::string file;  ///< a plain name
    bool select = false, print = false;
  };
  /// Once everything has been taken. Throws HttpError or Refused.
  asio::awaitable<Upload> finish();

 private:
  void begin(const FormPart& part) override;
  void take(std::string_view bytes) override;
  void end() override;
  asio::awaitable<void> write();

  Daemon& daemon_;
  FormReader reader_;
  const std::uint64_t length_;
  std::shared_ptr<UploadDraft> draft_;
  std::optional<std::string> file_;  ///< its name, once its part has begun
  std::string pending_;              ///< bytes of the file that are not written yet
  std::string field_, value_;        ///< the part that is being read, unless it is the file
  bool in_file_ = false, select_ = false, print_ = false;
};

}  // namespace unicursal::host
