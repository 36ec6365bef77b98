#include "host/job/profile_edit.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

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

std::string with_line_breaks(const std::string& value, const std::string& line_break) {
  std::string result;
  for (const char c : value) result += c == '\n' ? line_break : std::string(1, c);
  return result;
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

/// The table of a change; absent if it is not there, or is something else.
template <class Table>
auto table_of(Table& root, const ProfileChange& change) {
  auto* node = root.get(change.table);
  if (node && change.index) {
    auto* list = node->as_array();
    node = list && *change.index < list->size() ? list->get(*change.index) : nullptr;
  }
  return node ? node->as_table() : nullptr;
}

const toml::node* find(const toml::table& root, const ProfileChange& change, const std::string& key) {
  const toml::table* table = table_of(root, change);
  return table == nullptr ? nullptr : table->get(key);
}

/// Adds the key after another one of its table, in the same form.
void add_beside(std::string& text, const toml::table& root, const ProfileChange& change) {
  const toml::source_region& where = find(root, change, change.beside)->source();
  if (table_of(root, change)->is_inline()) {
    text.insert(offset_of(text, where.end), fmt::format(", {} = {}", change.key, change.value));
    return;
  }
  const std::size_t at = offset_of(text, where.begin);
  const std::size_t start = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
  std::string line = text.substr(start, at - start);
  const std::size_t name = line.rfind(change.beside);
  if (name == std::string::npos) return;  // written with escapes: the final check refuses it
  line.replace(name, change.beside.size(), change.key);
  text.insert(line_end(text, offset_of(text, where.end)), line_break_of(text) + line + change.value);
}

/// Adds the key as the first one below the table's heading; a missing table is added at the end.
void add_to_table(std::string& text, const toml::table& root, const ProfileChange& change) {
  const std::string line_break = line_break_of(text), line = fmt::format("{} = {}", change.key, change.value);
  const toml::table* table = table_of(root, change);
  if (table == nullptr) {
    if (change.index) return;  // the final check refuses it
    if (!text.empty() && text.back() != '\n') text += line_break;
    if (!text.empty()) text += line_break;
    text += fmt::format("[{}]{}{}{}", change.table, line_break, line, line_break);
  } else if (table->is_inline()) {
    text.insert(offset_of(text, table->source().begin) + 1,
                fmt::format(" {}{}", line, table->empty() ? " " : ","));
  } else {
    text.insert(line_end(text, offset_of(text, table->source().begin)), line_break + line);
  }
}

void make(const ProfileChange& change, std::string& text, const std::filesystem::path& file) {
  const toml::table root = parse_toml(text, file);
  if (const toml::node* node = find(root, change, change.key)) {
    replace_value(text, node->source(), change.value);
  } else if (!change.beside.empty() && find(root, change, change.beside) != nullptr) {
    add_beside(text, root, change);
  } else {
    add_to_table(text, root, change);
  }
}

void erase(toml::table& root, const ProfileChange& change) {
  toml::table* table = table_of(root, change);
  if (table == nullptr) return;
  table->erase(change.key);
  if (table->empty() && !change.index) root.erase(change.table);
}

bool holds(const toml::table& root, const ProfileChange& change) {
  const toml::node* node = find(root, change, change.key);
  if (node == nullptr) return false;
  toml::table wanted = toml::parse("value = " + change.value), found;
  found.insert("value", *node);
  return wanted == found;
}

/// Whether the edit changed exactly what it should.
bool differs_only_there(const std::string& before, const std::string& after,
                        std::span<const ProfileChange> changes, const std::filesystem::path& file) {
  try {
    toml::table old_table = parse_toml(before, file), new_table = parse_toml(after, file);
    for (const ProfileChange& change : changes) {
      if (!holds(new_table, change)) return false;
      erase(old_table, change);
      erase(new_table, change);
    }
    return old_table == new_table;
  } catch (const JobError&) {
    return false;
  }
}

std::string changes_in_words(std::span<const ProfileChange> changes) {
  std::vector<std::string> words;
  for (const ProfileChange& change : changes) {
    const std::string table =
        change.index ? fmt::format("{}[{}]", change.table, *change.index) : change.table;
    words.push_back(fmt::format("{}.{} = {}", table, change.key, change.value));
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

std::vector<ProfileChange> transition_changes(const MeasuredTransition& found) {
  std::vector<ProfileChange> changes{
      {"transition", {}, "dead_volume", fmt::format("{:.2f}", found.dead_volume), "mixing_volume"},
      {"transition", {}, "mixing_volume", fmt::format("{:.2f}", found.mixing_volume), "dead_volume"}};
  if (found.tanks)
    changes.push_back({"transition", {}, "tanks", fmt::format("{}", *found.tanks), "dead_volume"});
  return changes;
}

}  // namespace

std::string with_changes(const std::string& text, std::span<const ProfileChange> changes,
                         const std::filesystem::path& file) {
  parse_toml(text, file);
  std::string changed = text;
  for (ProfileChange change : changes) {
    change.value = with_line_breaks(change.value, line_break_of(text));
    make(change, changed, file);
  }
  if (!differs_only_there(text, changed, changes, file)) {
    throw JobError(file.string(), changes.front().table, "is written in a way that cannot be changed here",
                   fmt::format("write {} yourself", changes_in_words(changes)));
  }
  return changed;
}

std::string with_transition(const std::string& text, const MeasuredTransition& found,
                            const std::filesystem::path& file) {
  return with_changes(text, transition_changes(found), file);
}

ProfileText::ProfileText(std::filesystem::path file) : file_(std::move(file)), text_(read(file_)) {}

void ProfileText::set(std::span<const ProfileChange> changes) const {
  const std::string changed = with_changes(text_, changes, file_);
  if (read(file_) != text_) {
    throw core::FileError(file_.string(), "", "has been changed by another program meanwhile",
                          fmt::format("write {} into it yourself", changes_in_words(changes)));
  }
  write_whole_file(file_, changed, WholeFile::Access::as_before);
}

void ProfileText::set_transition(const MeasuredTransition& found) const {
  set(transition_changes(found));
}

}  // namespace unicursal::host
