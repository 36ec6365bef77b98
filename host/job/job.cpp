#include "host/job/job.hpp"

namespace unicursal::host {

std::vector<std::filesystem::path> JobInputs::all() const {
  std::vector<std::filesystem::path> files = {profile};
  if (!job.empty()) files.insert(files.begin(), job);
  files.insert(files.end(), models.begin(), models.end());
  for (const std::filesystem::path& field : fields) {
    if (!field.empty()) files.push_back(field);
  }
  return files;
}

JobInputs files_of(const Job& job) {
  JobInputs inputs{job.text.empty() ? job.file : "", job.profile.file, job.source.files, {}};
  for (const PlatePart& part : job.more)
    inputs.models.insert(inputs.models.end(), part.source.files.begin(), part.source.files.end());
  for (const core::Zone& zone : job.source.zones) inputs.fields.push_back(zone.pattern.field);
  return inputs;
}

bool is_plate(const Job& job) {
  return job.copies > 1 || !job.more.empty();
}

std::vector<std::filesystem::path*> model_names(Job& job) {
  std::vector<std::filesystem::path*> names;
  for (std::filesystem::path& file : job.source.files) names.push_back(&file);
  for (PlatePart& part : job.more) {
    for (std::filesystem::path& file : part.source.files) names.push_back(&file);
  }
  return names;
}

}  // namespace unicursal::host
