# What `cmake --install` installs, in five components: programs, data, library, development, python. Programs and libraries
# find their data in share/plotscan above them (foundation/core/data_folder.h), wherever the tree is installed or moved.
include(GNUInstallDirs)
set(PLOTSCAN_DATA_DIR ${CMAKE_INSTALL_DATADIR}/plotscan)

set(programs farmgen lidarsim estimator farmbench plotview)
install(TARGETS ${programs} COMPONENT programs)
# Each program makes its manual page and its completion from its own declarations. The folders are where Debian's shells look.
find_program(GZIP gzip REQUIRED)
set(pages ${PROJECT_BINARY_DIR}/pages)
file(MAKE_DIRECTORY ${pages}/bash ${pages}/zsh ${pages}/fish ${pages}/man)
foreach(program IN LISTS programs)
  set(manual ${pages}/man/${program}.1.gz)
  set(bash ${pages}/bash/${program})
  set(zsh ${pages}/zsh/_${program})
  set(fish ${pages}/fish/${program}.fish)
  add_custom_command(OUTPUT ${manual} ${bash} ${zsh} ${fish}
    COMMAND ${program} --print-manual | ${GZIP} -9n > ${manual}
    COMMAND ${program} --print-bash-completion > ${bash}
    COMMAND ${program} --print-zsh-completion > ${zsh}
    COMMAND ${program} --print-fish-completion > ${fish}
    DEPENDS ${program} VERBATIM)
  list(APPEND made_pages ${manual} ${bash} ${zsh} ${fish})
  install(FILES ${manual} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT programs)
  install(FILES ${bash} DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT programs)
  install(FILES ${zsh} DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT programs)
  install(FILES ${fish} DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT programs)
endforeach()
add_custom_target(pages ALL DEPENDS ${made_pages})
# Paths between the files of the data are relative: it keeps the folders of the sources.
install(DIRECTORY worlds models DESTINATION ${PLOTSCAN_DATA_DIR} COMPONENT data USE_SOURCE_PERMISSIONS)
install(DIRECTORY workflow DESTINATION ${PLOTSCAN_DATA_DIR} COMPONENT data USE_SOURCE_PERMISSIONS)
install(DIRECTORY benchmarks/suites DESTINATION ${PLOTSCAN_DATA_DIR}/benchmarks COMPONENT data)
install(FILES report/template.html DESTINATION ${PLOTSCAN_DATA_DIR}/report COMPONENT data)

install(TARGETS plotscan_estimate plotscan_simulate EXPORT plotscan
  LIBRARY COMPONENT library NAMELINK_COMPONENT development
  FILE_SET HEADERS COMPONENT development)
install(EXPORT plotscan NAMESPACE plotscan:: FILE plotscanTargets.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/plotscan COMPONENT development)
include(CMakePackageConfigHelpers)
configure_package_config_file(cmake/plotscanConfig.cmake.in plotscanConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/plotscan NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(plotscanConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/plotscanConfig.cmake ${PROJECT_BINARY_DIR}/plotscanConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/plotscan COMPONENT development)

# The build tree's programs and libraries find the sources' data in the same way.
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/share)
file(CREATE_LINK ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/share/plotscan SYMBOLIC)
