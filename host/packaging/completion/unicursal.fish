# Completes unicursal's command line in fish. The program itself knows what can stand where
# (host/cli/completing.hpp); fish finds the files.

function __unicursal_complete
    set -l before (commandline -opc)
    set -l word (commandline -ct)
    set -l lines (command $before[1] complete $before[2..-1] "$word" 2>/dev/null)
    set -l kind (string split ' ' -- $lines[1])
    if test (count $lines) -gt 1
        printf '%s\n' $lines[2..-1]
    end
    # What stands before the value in --option=value is not a part of the file's name.
    set -l option (string match -r -- '^--[^=]*=' $word)
    set -l path (string replace -r -- '^--[^=]*=' '' $word)
    switch $kind[1]
        case folders
            printf '%s\n' "$option"(__fish_complete_directories "$path" '')
        case files
            for file in (complete -C"'' $path")
                set -l name (string split \t -- $file)[1]
                if test (count $kind) -eq 1
                    or string match -q -- '*/' $name
                    or contains -- (string lower -- (path extension $name)) $kind[2..-1]
                    printf '%s\n' "$option$file"
                end
            end
    end
end

complete -c unicursal -f -a '(__unicursal_complete)'
