// Why a job is refused.
#pragma once

#include <filesystem>
#include <string>

#include "core/error.hpp"
#include "host/engine/prepared_job.hpp"
#include "host/job/load_job.hpp"

namespace unicursal::test {

/// The sentence with which a job is refused when it is read or prepared; empty if it is sound.
inline std::string refusal(const std::filesystem::path& job) {
  try {
    host::prepare(host::load_job(job));
  } catch (const core::DataError& error) {
    return error.what();
  }
  return "";
}

}  // namespace unicursal::test
