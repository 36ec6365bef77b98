#include "host/job/profile_edit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>

#include "core/error.hpp"
#include "host/files/whole_file.hpp"
#include "host/job/job.hpp"
#include "host/job/parse_toml.hpp"

namespace unicursal::host {
namespace {

constexpr const char* section = "transition";
constexpr const char* transition_keys[] = {"dead_volume", "mixing_volume"};

std::string read(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) throw core::FileError(file.string(), "", "cannot be read", "check the name and permissions");
  return text.str();
}

/// The offset in the text of the parser's line and column; columns count characters, not bytes.
std::size_t offset_of(const std::string& text, const toml::source_position& position) {
  std::size_t at = 0;
  for (std::size_t line = 1; line < position.line; ++line) at = text.find('\n', at) + 1;
  for (std::size_t column = 1; column < position.column && at < text.size(); ++column) {
    ++at;
    while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80) ++at;
  }
  return at;
}

std::size_t line_end(const std::string& text, std::size_t at) {
  std::size_t end = std::min(text.find('\n', at), text.size());
  if (end > at && text[end - 1] == '\r') --end;
  return end;
}

const char* line_break_of(const std::string& text) {
  return text.find("\r\n") == std::string::npos ? "\n" : "\r\n";
}

/// Replaces a value; a comment behind it keeps its column if there are enough spaces.
void replace_value(std::string& text, const toml::source_region& where, const std::string& value) {
  const std::size_t begin = offset_of(text, where.begin), end = offset_of(text, where.end);
  const std::size_t old = end - begin;
  const std::size_t comment = text.find_first_not_of(' ', end);
  if (comment != std::string::npos && text[comment] == '#') {
    const std::size_t blanks = comment - end;
    const std::size_t room = blanks + old;
    text.replace(end, blanks, std::string(room > value.size() ? room - value.size() : 1, ' '));
  }
  text.replace(begin, old, value);
}

const toml::node* find(const toml::table& root, const char* key) {
  const toml::table* table = root[section].as_table();
  return table == nullptr ? nullptr : table->get(key);
}

/// Adds `key` after the section's other key, in the same form.
void add_beside(std::string& text, const toml::table& root, const char* sister, const std::string& key,
                const std::string& value) {
  const toml::source_region& where = find(root, sister)->source();
  if (root[section].as_table()->is_inline()) {
    text.insert(offset_of(text, where.end), fmt::format(", {} = {}", key, value));
    return;
  }
  const std::size_t at = offset_of(text, where.begin);
  const std::size_t start = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
  std::string line = text.substr(start, at - start);
  const std::size_t name = line.rfind(sister);
  if (name == std::string::npos) return;  // written with escapes: the final check refuses it
  line.replace(name, std::string(sister).size(), key);
  text.insert(line_end(text, at), line_break_of(text) + line + value);
}

/// Adds `key` as the first one below the section's heading; a missing section is added at the end.
void add_to_section(std::string& text, const toml::table& root, const std::string& key,
                    const std::string& value) {
  const std::string line_break = line_break_of(text), line = fmt::format("{} = {}", key, value);
  const toml::table* table = root[section].as_table();
  if (table == nullptr) {
    if (!text.empty() && text.back() != '\n') text += line_break;
    if (!text.empty()) text += line_break;
    text += fmt::format("[{}]{}{}{}", section, line_break, line, line_break);
  } else if (table->is_inline()) {
    text.insert(offset_of(text, table->source().begin) + 1, fmt::format(" {} ", line));
  } else {
    text.insert(line_end(text, offset_of(text, table->source().begin)), line_break + line);
  }
}

void set(std::string& text, const char* key, const char* sister, const std::string& value,
         const std::filesystem::path& file) {
  const toml::table root = parse_toml(text, file);
  if (const toml::node* node = find(root, key)) {
    replace_value(text, node->source(), value);
  } else if (find(root, sister) != nullptr) {
    add_beside(text, root, sister, key, value);
  } else {
    add_to_section(text, root, key, value);
  }
}

void erase_keys(toml::table& root) {
  toml::table* table = root[section].as_table();
  if (table == nullptr) return;
  for (const char* key : transition_keys) table->erase(key);
  if (table->empty()) root.erase(section);
}

bool holds(const toml::table& root, const char* key, const std::string& value) {
  const toml::node* node = find(root, key);
  return node != nullptr && node->value<double>() == std::stod(value);
}

/// Whether the edit changed exactly what it should.
bool differs_only_there(const std::string& before, const std::string& after, const std::string& dead,
                        const std::string& mixing, const std::filesystem::path& file) {
  try {
    toml::table old_table = parse_toml(before, file), new_table = parse_toml(after, file);
    if (!holds(new_table, transition_keys[0], dead) || !holds(new_table, transition_keys[1], mixing))
      return false;
    erase_keys(old_table);
    erase_keys(new_table);
    return old_table == new_table;
  } catch (const JobError&) {
    return false;
  }
}

}  // namespace

std::string with_transition(const std::string& text, double dead_volume, double mixing_volume,
                            const std::filesystem::path& file) {
  const std::string dead = fmt::format("{:.2f}", dead_volume), mixing = fmt::format("{:.2f}", mixing_volume);
  parse_toml(text, file);
  std::string changed = text;
  set(changed, transition_keys[0], transition_keys[1], dead, file);
  set(changed, transition_keys[1], transition_keys[0], mixing, file);
  if (!differs_only_there(text, changed, dead, mixing, file)) {
    throw JobError(file.string(), section, "is written in a way that cannot be changed here",
                   fmt::format("write dead_volume = {} and mixing_volume = {} yourself", dead, mixing));
  }
  return changed;
}

ProfileText::ProfileText(std::filesystem::path file) : file_(std::move(file)), text_(read(file_)) {}

void ProfileText::set_transition(double dead_volume, double mixing_volume) const {
  const std::string changed = with_transition(text_, dead_volume, mixing_volume, file_);
  if (read(file_) != text_) {
    throw core::FileError(
        file_.string(), "", "has been changed by another program meanwhile",
        fmt::format("write dead_volume = {:.2f} and mixing_volume = {:.2f} into it yourself", dead_volume,
                    mixing_volume));
  }
  write_whole_file(file_, changed, WholeFile::Access::as_before);
}

}  // namespace unicursal::host
