#include "host/link/port_holder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "core/text/printable.hpp"

namespace unicursal::host {
namespace {

namespace fs = std::filesystem;

bool is_number(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::string name_of(const fs::path& process) {
  std::string name;
  std::ifstream file(process / "comm");
  std::getline(file, name);
  return core::printable(name);
}

/// Calls `found` with the folder of each process until it returns true.
template <class Found>
bool any_process(const Found& found) {
  std::error_code error;
  for (fs::directory_iterator entry("/proc", error), end; !error && entry != end; entry.increment(error)) {
    if (is_number(entry->path().filename().string()) && found(entry->path())) return true;
  }
  return false;
}

bool has_open(const fs::path& process, const fs::path& device) {
  std::error_code error;
  for (fs::directory_iterator entry(process / "fd", error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code gone;
    if (fs::read_symlink(entry->path(), gone) == device && !gone) return true;
  }
  return false;
}

}  // namespace

std::optional<std::string> holder_of(const std::string& path) {
  std::error_code error;
  const fs::path device = fs::canonical(path, error);
  if (error) return std::nullopt;
  const fs::path self = fs::path("/proc") / std::to_string(::getpid());
  std::optional<std::string> holder;
  any_process([&](const fs::path& process) {
    if (process == self || !has_open(process, device)) return false;
    holder = fmt::format("{} (process {})", name_of(process), process.filename().string());
    return true;
  });
  return holder;
}

bool brltty_runs() {
  return any_process([](const fs::path& process) { return name_of(process) == "brltty"; });
}

}  // namespace unicursal::host
