// The consequences of an examination for a print, in words.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "host/doctor/examine.hpp"
#include "host/job/profile.hpp"

namespace unicursal::host {

struct Finding {
  enum class Weight {
    good,     ///< It works.
    note,     ///< It works, but could work better.
    warning,  ///< Something may go wrong.
    trouble,  ///< A print will fail.
  };
  Weight weight = Weight::good;
  std::string text;  ///< A sentence, with the remedy if there is one.
};

/// Returns the findings, the most important first. `profile` is compared with the printer, unless it is null.
std::vector<Finding> findings(const Examination& found, unsigned baud, const Profile* profile);

bool has_trouble(const std::vector<Finding>& findings);

/// The printer's name, then one finding on each line.
std::string in_words(const Examination& found, const std::vector<Finding>& findings);
nlohmann::json to_json(const Examination& found, const std::vector<Finding>& findings);

}  // namespace unicursal::host
