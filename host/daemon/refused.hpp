// Why the daemon does not do what a client asks for.
#pragma once

#include <stdexcept>
#include <string>

namespace unicursal::host {

/// The message is a sentence for the client.
class Refused : public std::runtime_error {
 public:
  enum class Why {
    bad_name,   ///< not a name that a job or an upload can have
    not_found,  ///< there is no such job or upload
    conflict,   ///< not now: something else waits, or what it takes is missing
    printing,   ///< not while a print goes on
    absent,     ///< the printer is not there
    bad_value,  ///< a number beyond its limits
    bad_job,    ///< the job's text has a mistake
    bad_kind,   ///< a file of a sort that is not printed
    no_room,    ///< a limit or the disk is full
    busy        ///< too many ask
  };

  Refused(Why why, const std::string& sentence) : Refused(why, nullptr, sentence) {}
  /// `code`: a literal for programs and for translations, as those of HttpError; null: that of `why`.
  Refused(Why why, const char* code, const std::string& sentence)
      : std::runtime_error(sentence), why_(why), code_(code) {}
  Why why() const { return why_; }
  const char* code() const { return code_; }

 private:
  Why why_;
  const char* code_;
};

using Why = Refused::Why;

}  // namespace unicursal::host
