#include "host/job/job.hpp"

namespace unicursal::host {

std::vector<std::filesystem::path> JobInputs::all() const {
  std::vector<std::filesystem::path> files = {job, profile};
  files.insert(files.end(), models.begin(), models.end());
  for (const std::filesystem::path& field : fields) {
    if (!field.empty()) files.push_back(field);
  }
  return files;
}

JobInputs files_of(const Job& job) {
  JobInputs inputs{job.file, job.profile.file, job.source.files, {}};
  for (const core::Zone& zone : job.source.zones) inputs.fields.push_back(zone.pattern.field);
  return inputs;
}

}  // namespace unicursal::host
