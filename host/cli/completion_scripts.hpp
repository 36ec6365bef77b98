// The files of host/packaging/completion, which the build puts into the program.
#pragma once

namespace unicursal::host {

extern const char* const bash_completion;
extern const char* const zsh_completion;
extern const char* const fish_completion;

}  // namespace unicursal::host
