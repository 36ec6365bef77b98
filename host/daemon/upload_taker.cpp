#include "host/daemon/upload_taker.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/text/wording.hpp"
#include "host/daemon/api_body.hpp"
#include "host/daemon/log.hpp"
#include "host/daemon/refused.hpp"
#include "host/daemon/upload_kind.hpp"

namespace unicursal::host {
namespace {

constexpr std::size_t written_at_once = 256 * 1024;  ///< bytes
constexpr std::size_t longest_value = 4 * 1024;      ///< bytes of a field

/// What OctoPrint takes for yes (octoprint.settings, valid_boolean_trues).
bool means_yes(const std::string& value) {
  constexpr std::array words{"true", "yes", "y", "1"};
  return std::find(words.begin(), words.end(), core::lower(value)) != words.end();
}

}  // namespace

asio::awaitable<void> UploadTaker::take(std::string bytes) {
  std::optional<HttpError> refusal;
  try {
    reader_.add(bytes);
    if (pending_.size() >= written_at_once) co_await write();
  } catch (const Refused& refused) {
    refusal = http_error(refused);
  } catch (const HttpError& refused) {
    refusal = refused;
  }
  if (!refusal) co_return;
  log_line(std::string("an upload: refused: ") + refusal->what());
  throw HttpError(*refusal);
}

asio::awaitable<void> UploadTaker::write() {
  if (!draft_) draft_ = co_await daemon_.draft_upload(length_);
  co_await daemon_.write_upload(draft_, std::exchange(pending_, {}));
}

asio::awaitable<UploadTaker::Upload> UploadTaker::finish() {
  reader_.finish();
  if (!file_) throw HttpError(400, "the form holds no file; send it as the part \"file\", with its name");
  co_await write();
  if (draft_->size() == 0) throw HttpError(400, "the file is empty; save it again and send it");
  co_return Upload{draft_, *file_, select_, print_};
}

void UploadTaker::begin(const FormPart& part) {
  field_ = part.name;
  value_.clear();
  in_file_ = part.filename.has_value();
  if (!in_file_) return;
  if (part.name != "file") throw HttpError(400, "a file is sent as the part \"file\"");
  if (file_) throw HttpError(400, "the form holds more than one file; send one at a time");
  file_ = kept_name(*part.filename);
  upload_kind(*file_);
}

void UploadTaker::take(std::string_view bytes) {
  if (in_file_) {
    pending_ += bytes;
    return;
  }
  if (value_.size() + bytes.size() > longest_value)
    throw HttpError(413,
                    "a field of the form is too long; send the file as the part \"file\", with its name");
  value_ += bytes;
}

void UploadTaker::end() {
  if (!in_file_ && field_ == "print") print_ = means_yes(value_);
  if (!in_file_ && field_ == "select") select_ = means_yes(value_);
  in_file_ = false;
}

}  // namespace unicursal::host
