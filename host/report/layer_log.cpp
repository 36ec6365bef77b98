#include "host/report/layer_log.hpp"

#include <cassert>
#include <nlohmann/json.hpp>

#include "host/files/whole_file.hpp"

namespace unicursal::host {
namespace {

/// File names come from the user and need not be valid UTF-8; replace what is not.
std::string text_of(const nlohmann::json& value, int indent) {
  return value.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

LayerLog::LayerLog(std::filesystem::path file) : file_(std::move(file)), stream_(open_draft(file_)) {
  stream_ << "{\n\"layers\": [";
}

LayerLog::~LayerLog() {
  if (!finished_) discard_draft(stream_, file_);
}

void LayerLog::add(const nlohmann::json& layer) {
  stream_ << (layers_++ == 0 ? "\n" : ",\n") << text_of(layer, -1);
}

void LayerLog::finish(const nlohmann::json& rest) {
  assert(rest.is_object() && !finished_);
  stream_ << "\n]";
  for (const auto& [key, value] : rest.items())
    stream_ << ",\n" << text_of(key, -1) << ": " << text_of(value, 1);
  stream_ << "\n}\n";
  finished_ = true;
  publish_draft(stream_, file_);
}

void write_json(const std::filesystem::path& file, const nlohmann::json& value) {
  std::ofstream stream = open_draft(file);
  stream << text_of(value, 1) << '\n';
  publish_draft(stream, file);
}

}  // namespace unicursal::host
