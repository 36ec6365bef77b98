# The Debian package (`cmake --workflow --preset package`): what it holds besides what every installation has, and
# what CPack writes into it. Two builds of one commit give the same bytes: all times are the commit's, and the preset
# keeps the folder of the sources out of the program.
set(packaging ${CMAKE_CURRENT_SOURCE_DIR}/packaging)
set(packed ${CMAKE_CURRENT_BINARY_DIR}/packed)
file(MAKE_DIRECTORY ${packed})

add_custom_command(OUTPUT ${packed}/changelog.Debian
  COMMAND ${CMAKE_COMMAND} -D SOURCES=${CMAKE_SOURCE_DIR} -D PROJECT_VERSION=${PROJECT_VERSION}
    -D "UNICURSAL_COMMIT=${UNICURSAL_COMMIT}" -D TEMPLATE=${packaging}/debian/changelog.in
    -D OUTPUT=${packed}/changelog.Debian -P ${packaging}/commit.cmake
  DEPENDS ${packaging}/commit ${packaging}/commit.cmake ${packaging}/debian/changelog.in ${head_log}
  VERBATIM)

# Debian's policy wants manuals and changes compressed, without the time of compressing.
set(compressed)
function(unicursal_install_compressed file name folder)
  add_custom_command(OUTPUT ${packed}/${name}.gz
    COMMAND gzip -9nc ${file} > ${packed}/${name}.gz DEPENDS ${file} VERBATIM)
  install(FILES ${packed}/${name}.gz DESTINATION ${folder})
  set(compressed ${compressed} ${packed}/${name}.gz PARENT_SCOPE)
endfunction()
foreach(page unicursal.1 unicursal-job.5 unicursal-profile.5)
  string(REGEX MATCH "[0-9]$" section ${page})
  unicursal_install_compressed(${packaging}/${page} ${page} ${CMAKE_INSTALL_MANDIR}/man${section})
endforeach()
unicursal_install_compressed(${packaging}/CHANGELOG.md changelog ${CMAKE_INSTALL_DOCDIR})
unicursal_install_compressed(${packed}/changelog.Debian changelog.Debian ${CMAKE_INSTALL_DOCDIR})
add_custom_target(packed ALL DEPENDS ${compressed})
install(FILES ${packaging}/debian/copyright TYPE DOC)
install(FILES ${packaging}/debian/lintian-overrides DESTINATION share/lintian/overrides RENAME unicursal)

set(CPACK_PACKAGE_NAME unicursal)
set(CPACK_PACKAGE_CONTACT "unicursal maintainers <maintainers@users.noreply.h-seed-3d5add8f.example>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "host of 3D printers with a mixing nozzle, one curve per layer")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"unicursal fills each layer of a part with one closed, space-filling curve and
prints it over USB while it computes the next layers. It is made for printers
with two to eight feeders and one mixing nozzle, with Marlin, Repetier or
RepRapFirmware. It changes mixtures ahead of the borders of colours, simulates
a print before it is made, resumes interrupted prints, and runs as a daemon.")
set(CPACK_GENERATOR DEB)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION utils)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "systemd | systemd-standalone-sysusers | systemd-sysusers")
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA
  ${packaging}/debian/postinst ${packaging}/debian/prerm ${packaging}/debian/postrm)
if(CMAKE_CROSSCOMPILING)
  set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE arm64)
endif()
# CPack asks here, when it packs, for the time of the commit.
configure_file(${packaging}/packing.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/packing.cmake @ONLY)
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_BINARY_DIR}/packing.cmake)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
include(CPack)
