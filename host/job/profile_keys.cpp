#include "host/job/profile_keys.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <utility>

#include "host/job/profile_manual.hpp"

namespace unicursal::host {
namespace {

constexpr std::string_view item_head = ".It Ic ";

/// Characters that mdoc writes by name.
std::string with_characters(std::string text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 5> names{
      {{"\\(S2", "²"}, {"\\(S3", "³"}, {"\\(de", "°"}, {"\\-", "-"}, {"\\&", ""}}};
  for (const auto& [name, character] : names) {
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at))
      text.replace(at, name.size(), character);
  }
  return text;
}

bool is_closing(const std::string& word) {
  return word.size() == 1 && std::string_view(".,:;)]?!").find(word) != std::string_view::npos;
}

/// The words of a line of macros as they are printed.
class MacroLine {
 public:
  std::string operator()(const std::string& line) {
    std::istringstream words(line);
    for (std::string word; words >> word;) take(word);
    return std::move(text_);
  }

 private:
  void take(const std::string& word) {
    if (word == "Ns") return void(joined_ = true);
    if (word == "Qo" || word == "Qq") return open("\"", word == "Qq" ? "\"" : "");
    if (word == "Bq" || word == "Bo") return open("[", word == "Bq" ? "]" : "");
    if (word == "Pq") return open("(", ")");
    if (word == "Qc") return close("\"");
    if (word == "Bc") return close("]");
    if (word == "Fl") return void(prefix_ += "-");
    constexpr std::array plain{"Li", "Pa", "Ic", "Ar", "Em", "Dv", "Sx", "No", "Xr"};
    if (std::find(plain.begin(), plain.end(), word) != plain.end()) {
      names_page_ = word == "Xr";
      return;
    }
    const bool section = names_page_ && word.size() == 1 && word[0] >= '1' && word[0] <= '9';
    if (section) {
      text_ += "(" + word + ")";
      names_page_ = false;
      return;
    }
    if (is_closing(word)) {
      text_ += closing_.empty() ? word : closing_ + word;
      closing_.clear();
      return;
    }
    add(prefix_ + with_characters(word));
    prefix_.clear();
    if (!closing_.empty() && closing_ == "\"") close(std::exchange(closing_, ""));
  }
  void open(const std::string& mark, const std::string& end) {
    prefix_ += mark;
    closing_ = end;
  }
  void close(const std::string& mark) { text_ += mark; }
  void add(const std::string& word) {
    if (!text_.empty() && !joined_) text_ += ' ';
    text_ += word;
    joined_ = false;
  }

  std::string text_, prefix_, closing_;
  bool joined_ = false, names_page_ = false;

 public:
  /// What is still open at the end of the line.
  std::string rest() { return std::exchange(closing_, ""); }
};

std::string plain_line(const std::string& line) {
  if (!line.starts_with('.')) return with_characters(line);
  MacroLine macro;
  std::string text = macro(line.substr(1));
  return text + macro.rest();
}

bool is_unit(const std::string& word) {
  constexpr std::array units{"mm", "mm/s",     "mm/s²",  "mm³/s", "mm³",
                             "°C", "steps/mm", "bits/s", "bytes", "g/cm³"};
  return std::find(units.begin(), units.end(), word) != units.end();
}

/// The unit that stands for the value, or that the first sentence names behind "in".
std::string unit_of(const ProfileKey& key) {
  if (is_unit(key.takes)) return key.takes;
  std::istringstream words(key.help);
  std::string before;
  for (std::string word; words >> word; before = word) {
    const bool ends = word.ends_with('.') || word.ends_with(';');
    while (!word.empty() && (word.back() == ',' || word.back() == '.')) word.pop_back();
    if ((before == "in" || before == "many") && is_unit(word)) return word;
    if (ends) break;
  }
  return {};
}

void append_line(std::string& help, const std::string& line) {
  const std::string text = plain_line(line);
  if (text.empty()) return;
  const bool joins = help.empty() || is_closing(text.substr(0, 1));
  help += (joins ? "" : " ") + text;
}

}  // namespace

std::vector<ProfileKey> keys_in_manual(std::string_view page) {
  std::vector<ProfileKey> keys;
  std::istringstream lines{std::string(page)};
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(item_head) && line.find(" No = ") != std::string::npos) {
      ProfileKey& key = keys.emplace_back();
      const std::size_t value = line.find(" No = ");
      key.key = line.substr(item_head.size(), value - item_head.size());
      key.takes = plain_line("." + line.substr(value + 6));
      inside = true;
    } else if (line.starts_with(".El") || line.starts_with(".Sh") || line.starts_with(".It")) {
      inside = false;
    } else if (inside) {
      append_line(keys.back().help, line);
    }
  }
  for (ProfileKey& key : keys) key.unit = unit_of(key);
  return keys;
}

const std::vector<ProfileKey>& profile_keys() {
  static const std::vector<ProfileKey> keys = keys_in_manual(profile_manual());
  return keys;
}

}  // namespace unicursal::host
