// What can stand next on an unfinished command line, found in the command line's own table. The scripts in
// host/packaging/completion ask for it at each Tab: `unicursal complete WORD…`, where the last word is the
// one in which the cursor stands. Nothing but the name of an option, a command or an argument is set down
// twice: the placeholder of an option in the help says what its values are.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace unicursal::host {

/// Names of files that the shell shall look up by itself.
enum class WantedFiles { none, folders, some, all };

struct Completion {
  struct Offer {
    std::string word;         ///< the whole word, which begins with what was typed
    std::string description;  ///< may be empty
  };
  std::vector<Offer> offers;
  WantedFiles files = WantedFiles::none;
  std::vector<std::string> endings;  ///< of WantedFiles::some: ".toml"
};

/// `words`: those after the program's name, the unfinished one included.
Completion completion_of(const CLI::App& program, const std::vector<std::string>& words);

/// The answer to the scripts. The first line is "words", "folders", "files", or "files .toml .svg"; each line
/// that follows is an offer: the word, a tab and the first sentence of its description.
std::string answer_of(const Completion& completion);

/// Whether the placeholder of an option or an argument is one whose values are known, or known to be free.
bool is_known_placeholder(const std::string& placeholder);

}  // namespace unicursal::host
