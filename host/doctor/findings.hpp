// What an examined printer means for a print, in plain words.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "host/doctor/examine.hpp"
#include "host/job/profile.hpp"

namespace unicursal::host {

struct Finding {
  enum class Weight {
    good,     ///< works
    note,     ///< works, and could work better
    warning,  ///< something may go wrong
    trouble,  ///< a print will not do
  };
  Weight weight = Weight::good;
  std::string text;  ///< a sentence, with the remedy where there is one
};

/// In the order in which a user should read them. `profile`: what the user believes the printer to be, if
/// told.
std::vector<Finding> findings(const Examination& found, unsigned baud, const Profile* profile);

bool has_trouble(const std::vector<Finding>& findings);

/// Who it is, then one finding on each line.
std::string in_words(const Examination& found, const std::vector<Finding>& findings);
nlohmann::json to_json(const Examination& found, const std::vector<Finding>& findings);

}  // namespace unicursal::host
