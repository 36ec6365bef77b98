#include "host/daemon/job_sketch.hpp"

#include <nlohmann/json.hpp>

#include "host/files/whole_file.hpp"
#include "host/report/estimate.hpp"
#include "host/report/small_picture.hpp"

namespace unicursal::host {
namespace {

template <class Prepared>
void write_both(const std::filesystem::path& folder, const Prepared& prepared) {
  picture::write_png(folder / sketch_picture, small_picture(prepared));
  const std::string text =
      to_json(estimate_of(prepared)).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  write_whole_file(folder / sketch_estimate, text, WholeFile::Access::owner_only);
}

}  // namespace

void write_sketch(const std::filesystem::path& folder, const PreparedJob& prepared) {
  write_both(folder, prepared);
}

void write_sketch(const std::filesystem::path& folder, const PreparedSliced& prepared) {
  write_both(folder, prepared);
}

}  // namespace unicursal::host
