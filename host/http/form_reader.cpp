#include "host/http/form_reader.hpp"

#include <algorithm>
#include <map>

#include "core/text/wording.hpp"
#include "host/http/http_message.hpp"

namespace unicursal::host {
namespace {

constexpr std::string_view line_end = "\r\n", end_of_head = "\r\n\r\n", end_of_form = "--";
constexpr std::size_t longest_boundary = 70;  // RFC 2046, 5.1.1
constexpr std::string_view boundary_signs = "'()+_,-./:=? ";
constexpr std::string_view token_signs = "!#$%&'*+-.^_`|~";  // RFC 9110, 5.6.2

bool is_alphanumeric(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

bool is_token(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return is_alphanumeric(c) || token_signs.find(c) != std::string_view::npos;
  });
}

bool has_controls(std::string_view text) {
  return std::any_of(text.begin(), text.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < ' ' || byte == 0x7f;
  });
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

HttpError bad_form(const std::string& what) {
  return {400, "the form " + what + "; send multipart/form-data as RFC 7578 describes it"};
}

/// A header's value with its parameters: `form-data; name="file"; filename="a.stl"`.
struct Valued {
  std::string value;                              ///< in lower case
  std::map<std::string, std::string> parameters;  ///< names in lower case
};

/// Takes a quoted text from the front. Only quotes and backslashes are escaped: a client of Windows may name
/// a file by its whole path.
std::string take_quoted(std::string_view& rest) {
  std::string text;
  for (std::size_t i = 1; i < rest.size(); ++i) {
    if (rest[i] == '"') {
      rest.remove_prefix(i + 1);
      return text;
    }
    const bool escape = rest[i] == '\\' && i + 1 < rest.size() && (rest[i + 1] == '"' || rest[i + 1] == '\\');
    if (escape) ++i;
    text += rest[i];
  }
  throw bad_form("has a text without its closing quote");
}

Valued read_valued(std::string_view text) {
  Valued read;
  std::size_t end = std::min(text.find(';'), text.size());
  read.value = core::lower(std::string(trimmed(text.substr(0, end))));
  std::string_view rest = text.substr(end);
  while (!rest.empty()) {
    rest = trimmed(rest.substr(1));  // behind the semicolon
    if (rest.empty()) break;
    const std::size_t equals = rest.find('=');
    if (equals == std::string_view::npos) throw bad_form("has a parameter without a value");
    const std::string name = core::lower(std::string(trimmed(rest.substr(0, equals))));
    rest = trimmed(rest.substr(equals + 1));
    std::string value;
    if (!rest.empty() && rest.front() == '"') {
      value = take_quoted(rest);
    } else {
      end = std::min(rest.find(';'), rest.size());
      value = trimmed(rest.substr(0, end));
      rest.remove_prefix(end);
    }
    rest = trimmed(rest);
    if (!is_token(name) || (!rest.empty() && rest.front() != ';'))
      throw bad_form("has a parameter that cannot be read");
    if (!read.parameters.emplace(name, value).second) throw bad_form("has a parameter twice");
  }
  return read;
}

int hexadecimal(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// UTF-8''a%20name (RFC 5987, 3.2.1).
std::string decoded_name(const std::string& text) {
  const std::size_t language = text.find('\'');
  const std::size_t name = language == std::string::npos ? language : text.find('\'', language + 1);
  if (name == std::string::npos || core::lower(text.substr(0, language)) != "utf-8")
    throw bad_form("has a filename* that is not UTF-8");
  std::string decoded;
  for (std::size_t i = name + 1; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += text[i];
      continue;
    }
    const int high = i + 2 < text.size() ? hexadecimal(text[i + 1]) : -1;
    const int low = i + 2 < text.size() ? hexadecimal(text[i + 2]) : -1;
    if (high < 0 || low < 0) throw bad_form("has a filename* that cannot be read");
    decoded += static_cast<char>(high * 16 + low);
    i += 2;
  }
  return decoded;
}

/// `head` has a line's end behind each line.
FormPart read_part_head(std::string_view head) {
  std::map<std::string, std::string> headers;
  while (!head.empty()) {
    const std::size_t end = head.find(line_end);
    const std::string_view line = head.substr(0, end);
    head.remove_prefix(end + line_end.size());
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos || !is_token(line.substr(0, colon)))
      throw bad_form("has a part whose head cannot be read");
    const std::string_view value = trimmed(line.substr(colon + 1));
    if (has_controls(value)) throw bad_form("has control characters in the head of a part");
    if (!headers.emplace(core::lower(std::string(line.substr(0, colon))), value).second)
      throw bad_form("has a part with the same header twice");
  }
  if (const auto encoding = headers.find("content-transfer-encoding"); encoding != headers.end()) {
    const std::string word = core::lower(encoding->second);
    if (word != "binary" && word != "8bit" && word != "7bit") throw bad_form("has an encoded part");
  }
  const Valued disposition = read_valued(headers["content-disposition"]);
  const auto name = disposition.parameters.find("name");
  if (disposition.value != "form-data" || name == disposition.parameters.end())
    throw bad_form("has a part without a name");
  FormPart part{name->second, std::nullopt};
  const auto plain = disposition.parameters.find("filename");
  const auto encoded = disposition.parameters.find("filename*");
  if (plain != disposition.parameters.end()) part.filename = plain->second;
  if (encoded != disposition.parameters.end()) part.filename = decoded_name(encoded->second);
  return part;
}

}  // namespace

FormReader::FormReader(const std::string& boundary, FormTaker& taker)
    : delimiter_(std::string(line_end) + "--" + boundary), taker_(taker) {}

void FormReader::add(std::string_view bytes) {
  while (!bytes.empty()) {
    if (state_ == State::content) {
      in_content(bytes);
      continue;
    }
    const char byte = bytes.front();
    bytes.remove_prefix(1);
    switch (state_) {
      case State::delimiter:
        if (byte != delimiter_[matched_]) throw bad_form("does not begin with its boundary");
        if (++matched_ == delimiter_.size()) state_ = State::behind_delimiter;
        break;
      case State::behind_delimiter:
        behind_delimiter(byte);
        break;
      case State::head:
        in_head(byte);
        break;
      case State::behind_form:
        behind_form(byte);
        break;
      case State::content:
        break;
    }
  }
}

/// Takes bytes from the front, at least one or a part of the delimiter.
void FormReader::in_content(std::string_view& bytes) {
  if (matched_ == 0) {
    const std::size_t size = std::min(bytes.find('\r'), bytes.size());
    if (size > 0) taker_.take(bytes.substr(0, size));
    bytes.remove_prefix(size);
    if (bytes.empty()) return;
  }
  while (!bytes.empty() && bytes.front() == delimiter_[matched_]) {
    bytes.remove_prefix(1);
    if (++matched_ < delimiter_.size()) continue;
    taker_.end();
    state_ = State::behind_delimiter;
    return;
  }
  if (bytes.empty()) return;
  taker_.take(std::string_view(delimiter_).substr(0, matched_));
  matched_ = 0;
}

void FormReader::behind_delimiter(char byte) {
  head_ += byte;
  if (head_.size() < line_end.size()) return;
  if (head_ == line_end) {
    if (++parts_ > most_parts) throw HttpError(413, "the form has too many parts; send one file at a time");
    state_ = State::head;  // the line's end stays there, so that an empty head is seen
  } else if (head_ == end_of_form) {
    head_.clear();
    state_ = State::behind_form;
  } else {
    throw bad_form("has text behind a boundary");
  }
}

void FormReader::in_head(char byte) {
  head_ += byte;
  if (head_.size() > longest_part_head + end_of_head.size())
    throw HttpError(431, "the head of a part is too long; shorten the name of the file");
  if (!head_.ends_with(end_of_head)) return;
  head_.erase(head_.size() - line_end.size());
  const FormPart part = read_part_head(std::string_view(head_).substr(line_end.size()));
  head_.clear();
  matched_ = 0;
  state_ = State::content;
  taker_.begin(part);
}

void FormReader::behind_form(char byte) {
  head_ += byte;
  if (!line_end.starts_with(head_)) throw bad_form("has text behind its end");
}

void FormReader::finish() const {
  if (state_ != State::behind_form) throw bad_form("ends too soon");
}

std::string form_boundary(const std::string& content_type) {
  const Valued type = read_valued(content_type);
  if (type.value != "multipart/form-data")
    throw HttpError(415, "send the file in a form, as Content-Type: multipart/form-data");
  const auto found = type.parameters.find("boundary");
  const std::string boundary = found == type.parameters.end() ? "" : found->second;
  const bool sound = std::all_of(boundary.begin(), boundary.end(), [](char c) {
    return is_alphanumeric(c) || boundary_signs.find(c) != std::string_view::npos;
  });
  if (boundary.empty() || boundary.size() > longest_boundary || !sound || boundary.back() == ' ')
    throw bad_form("has no boundary, or one that is not allowed");
  return boundary;
}

}  // namespace unicursal::host
