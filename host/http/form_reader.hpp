// Reads multipart/form-data (RFC 7578, with the grammar of RFC 2046, 5.1.1) while it arrives, in pieces of
// any size: nothing but a part's head and the beginning of a boundary is kept. The cost grows with the bytes
// and with nothing else, since a boundary holds no carriage return: a match that fails begins again at the
// byte that ended it.
//
// It is stricter than the RFCs, as http_message.hpp is: text before the first boundary or behind the last
// one, spaces behind a boundary, forms within forms and encodings of parts are refused. Clients send none of
// that. As RFC 5987 and OctoPrint have it, `filename*` (UTF-8 only) goes before `filename`.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace unicursal::host {

inline constexpr std::size_t longest_part_head = 8 * 1024;  ///< bytes; more is refused with 431
inline constexpr std::size_t most_parts = 32;               ///< more are refused with 413

struct FormPart {
  std::string name;
  /// As the client sent it: it may hold anything, also slashes, dots and bytes that are not UTF-8.
  std::optional<std::string> filename;
};

/// Gets the parts in their order. May throw HttpError.
class FormTaker {
 public:
  virtual ~FormTaker() = default;
  virtual void begin(const FormPart& part) = 0;
  virtual void take(std::string_view bytes) = 0;
  virtual void end() = 0;
};

class FormReader {
 public:
  /// `taker` must outlive this object.
  FormReader(const std::string& boundary, FormTaker& taker);

  /// Throws HttpError 400, 413 or 431.
  void add(std::string_view bytes);
  /// Throws HttpError 400 if the form has not come to its end.
  void finish() const;

 private:
  enum class State { delimiter, behind_delimiter, head, content, behind_form };

  void in_content(std::string_view& bytes);
  void behind_delimiter(char byte);
  void in_head(char byte);
  void behind_form(char byte);

  const std::string delimiter_;  ///< the line's end, two dashes and the boundary
  FormTaker& taker_;
  State state_ = State::delimiter;
  std::size_t matched_ = 2;  ///< bytes of the delimiter; the first one needs no line's end before it
  std::string head_;         ///< of a part, or what follows a delimiter or the form
  std::size_t parts_ = 0;
};

/// The boundary in a Content-Type. Throws HttpError 415 if that is not multipart/form-data, or 400.
std::string form_boundary(const std::string& content_type);

}  // namespace unicursal::host
