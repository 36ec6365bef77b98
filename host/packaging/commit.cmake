# Which commit these sources are, and when it was made. The cache variable UNICURSAL_COMMIT decides it, if it is
# set, with a hash and seconds since 1970; otherwise the file `commit` in an archive that git has made; otherwise
# git. Without any of them both are empty.
#
# Run as a script, it fills a template: @UNICURSAL_ORIGIN@ is " (commit HASH, DATE)" or empty, and @UNICURSAL_DATE@ is
# the time of the commit in the form of RFC 5322, or else the present.

function(unicursal_commit sources hash seconds)
  set(${hash} "" PARENT_SCOPE)
  set(${seconds} "" PARENT_SCOPE)
  set(known "${UNICURSAL_COMMIT}")
  if(NOT known)
    file(READ ${sources}/host/packaging/commit known)
  endif()
  if(NOT known MATCHES "^[0-9a-f]+ [0-9]+")
    # An archive that lies in another project's repository is not a part of that.
    execute_process(COMMAND git -C ${sources} rev-parse --show-cdup
      OUTPUT_VARIABLE top OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed ERROR_QUIET)
    if(NOT failed STREQUAL 0 OR NOT top STREQUAL "")
      return()
    endif()
    execute_process(COMMAND git -C ${sources} log -1 --no-show-signature "--format=%H %ct"
      OUTPUT_VARIABLE known ERROR_QUIET)
  endif()
  if(known MATCHES "^([0-9a-f]+) ([0-9]+)")
    set(found_hash ${CMAKE_MATCH_1})
    set(${seconds} ${CMAKE_MATCH_2} PARENT_SCOPE)
    # As many digits as git itself shows depend on what else is in a repository.
    string(SUBSTRING ${found_hash} 0 10 found_hash)
    set(${hash} ${found_hash} PARENT_SCOPE)
  endif()
endfunction()

if(CMAKE_SCRIPT_MODE_FILE STREQUAL CMAKE_CURRENT_LIST_FILE)
  unicursal_commit(${SOURCES} hash seconds)
  set(UNICURSAL_ORIGIN "")
  if(hash)
    set(ENV{SOURCE_DATE_EPOCH} ${seconds})
    string(TIMESTAMP date "%Y-%m-%d" UTC)
    set(UNICURSAL_ORIGIN " (commit ${hash}, ${date})")
  endif()
  string(TIMESTAMP UNICURSAL_DATE "%a, %d %b %Y %H:%M:%S +0000" UTC)
  configure_file(${TEMPLATE} ${OUTPUT} @ONLY)
endif()
