#include "host/job/profile_edit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>
#include <vector>

#include "core/error.hpp"
#include "host/files/whole_file.hpp"
#include "host/job/job.hpp"
#include "host/job/parse_toml.hpp"

namespace unicursal::host {
namespace {

constexpr const char* section = "transition";
constexpr const char* transition_keys[] = {"dead_volume", "mixing_volume", "tanks"};

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

void erase_keys(toml::table& root, std::size_t count) {
  toml::table* table = root[section].as_table();
  if (table == nullptr) return;
  for (std::size_t i = 0; i < count; ++i) table->erase(transition_keys[i]);
  if (table->empty()) root.erase(section);
}

bool holds(const toml::table& root, const char* key, const std::string& value) {
  const toml::node* node = find(root, key);
  return node != nullptr && node->value<double>() == std::stod(value);
}

/// Whether the edit changed exactly what it should.
bool differs_only_there(const std::string& before, const std::string& after,
                        const std::vector<std::string>& values, const std::filesystem::path& file) {
  try {
    toml::table old_table = parse_toml(before, file), new_table = parse_toml(after, file);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!holds(new_table, transition_keys[i], values[i])) return false;
    }
    erase_keys(old_table, values.size());
    erase_keys(new_table, values.size());
    return old_table == new_table;
  } catch (const JobError&) {
    return false;
  }
}

/// What a person can do instead, as the beginning of a sentence.
std::string by_hand(const MeasuredTransition& found) {
  const std::string volumes = fmt::format("dead_volume = {:.2f}{} mixing_volume = {:.2f}", found.dead_volume,
                                          found.tanks ? "," : " and", found.mixing_volume);
  return "write " + volumes + (found.tanks ? fmt::format(" and tanks = {}", *found.tanks) : "");
}

}  // namespace

std::string with_transition(const std::string& text, const MeasuredTransition& found,
                            const std::filesystem::path& file) {
  std::vector<std::string> values = {fmt::format("{:.2f}", found.dead_volume),
                                     fmt::format("{:.2f}", found.mixing_volume)};
  if (found.tanks) values.push_back(fmt::format("{}", *found.tanks));
  parse_toml(text, file);
  std::string changed = text;
  for (std::size_t i = 0; i < values.size(); ++i)
    set(changed, transition_keys[i], transition_keys[i == 0 ? 1 : 0], values[i], file);
  if (!differs_only_there(text, changed, values, file)) {
    throw JobError(file.string(), section, "is written in a way that cannot be changed here",
                   by_hand(found) + " yourself");
  }
  return changed;
}

ProfileText::ProfileText(std::filesystem::path file) : file_(std::move(file)), text_(read(file_)) {}

void ProfileText::set_transition(const MeasuredTransition& found) const {
  const std::string changed = with_transition(text_, found, file_);
  if (read(file_) != text_) {
    throw core::FileError(file_.string(), "", "has been changed by another program meanwhile",
                          by_hand(found) + " into it yourself");
  }
  write_whole_file(file_, changed, WholeFile::Access::as_before);
}

}  // namespace unicursal::host
