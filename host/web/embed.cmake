# Makes the page's files, and a C++ file that holds them, packed with gzip. Run as a script with
#   SOURCES   this folder
#   FOLDER    where the files go, ready for `unicursal serve --web-folder FOLDER`
#   ESBUILD   the program; empty: the page is left out
#   TEMPLATE  of the C++ file, in this folder
#   OUTPUT    the C++ file
# The same sources give the same bytes: gzip writes neither a name nor a time.

set(scripts page.ts viewer.ts)
set(styles page.css viewer.css)
set(others index.html en.json de.json icon.svg)

function(unicursal_run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE failed ERROR_VARIABLE said)
  if(NOT failed STREQUAL 0)
    message(FATAL_ERROR "${ARGN}: ${said}")
  endif()
endfunction()

set(names "")
set(unicursal_arrays "")
set(unicursal_files "")
if(ESBUILD)
  file(REMOVE_RECURSE ${FOLDER})
  file(MAKE_DIRECTORY ${FOLDER}/packed)
  foreach(entry IN LISTS scripts styles)
    string(REGEX REPLACE "\\.ts$" ".js" name ${entry})
    unicursal_run(${ESBUILD} ${SOURCES}/${entry} --bundle --minify --target=es2020 --charset=utf8
      --legal-comments=none --log-level=warning --outfile=${FOLDER}/${name})
    list(APPEND names ${name})
  endforeach()
  foreach(name IN LISTS others)
    file(COPY ${SOURCES}/${name} DESTINATION ${FOLDER})
    list(APPEND names ${name})
  endforeach()
endif()
foreach(name IN LISTS names)
  execute_process(COMMAND gzip -9 -n -c ${FOLDER}/${name} OUTPUT_FILE ${FOLDER}/packed/${name}
    COMMAND_ERROR_IS_FATAL ANY)
  file(READ ${FOLDER}/packed/${name} bytes HEX)
  file(SHA256 ${FOLDER}/${name} digest)
  string(SUBSTRING ${digest} 0 32 digest)
  string(REGEX REPLACE "(................................)" "\\1\n" bytes "${bytes}")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
  string(MAKE_C_IDENTIFIER ${name} identifier)
  string(APPEND unicursal_arrays "constexpr unsigned char packed_${identifier}[] = {\n${bytes}};\n")
  string(APPEND unicursal_files
    "      {\"${name}\", {reinterpret_cast<const char*>(packed_${identifier}), sizeof packed_${identifier}}, \"${digest}\"},\n")
endforeach()
configure_file(${TEMPLATE} ${OUTPUT} @ONLY)
