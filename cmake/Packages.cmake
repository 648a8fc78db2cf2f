# Debian packages by CPack (scripts/package): plotscan (the programs), plotscan-data, libplotscan0.1, libplotscan-dev,
# python3-plotscan.
set(PLOTSCAN_PACKAGER "The Plotscan authors <nobody@invalid>" CACHE STRING "Who makes the Debian packages: name <address>")
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME plotscan)
set(CPACK_PACKAGE_CONTACT ${PLOTSCAN_PACKAGER})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "phenotyping farms, LiDAR flights, crop heights")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL programs data library development python)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/library)

# What Debian's policy wants in every package.
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)  # of SOURCE_DATE_EPOCH, where that is set
configure_file(cmake/changelog.in package/changelog @ONLY)
configure_file(cmake/copyright.in package/copyright @ONLY)
execute_process(COMMAND ${GZIP} -9nkf ${PROJECT_BINARY_DIR}/package/changelog COMMAND_ERROR_IS_FATAL ANY)

# plotscan_package(COMPONENT NAME SECTION DEPENDS HOLDS): HOLDS is what the package has of Plotscan.
function(plotscan_package component name section depends holds)
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${depends}" PARENT_SCOPE)
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "Plotscan makes virtual farms with exact ground truth, flies a simulated
LiDAR drone over them, finds every plot and its crop height in the scans
or in those of real fields, and scores the result.
.
This package has the ${holds}." PARENT_SCOPE)
  install(FILES ${PROJECT_BINARY_DIR}/package/copyright ${PROJECT_BINARY_DIR}/package/changelog.gz
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} COMPONENT ${component} EXCLUDE_FROM_ALL)
endfunction()

set(abi ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(library libplotscan${abi})
set(same "(= ${PROJECT_VERSION})")
set(python "python3, python3-numpy")
if(TARGET plotscan_python)
  math(EXPR next "${PLOTSCAN_PYTHON_MINOR} + 1")
  set(python "python3 (>= 3.${PLOTSCAN_PYTHON_MINOR}), python3 (<< 3.${next}), python3-numpy")
else()
  list(REMOVE_ITEM CPACK_COMPONENTS_ALL python)
endif()
plotscan_package(programs plotscan science "plotscan-data ${same}" "programs")
plotscan_package(data plotscan-data science "" "worlds, plant models, suites and the template of reports")
plotscan_package(library ${library} libs "" "shared libraries")
plotscan_package(development libplotscan-dev libdevel "${library} ${same}" "C++ headers")
plotscan_package(python python3-plotscan python "${library} ${same}, plotscan-data ${same}, ${python}" "Python module")
# Who links the libraries depends on their package; the linker's cache is made again once for all packages.
file(WRITE ${PROJECT_BINARY_DIR}/package/triggers "activate-noawait ldconfig\n")
set(shlibs "")
foreach(component estimate simulate)
  string(APPEND shlibs "libplotscan_${component} ${abi} ${library} (>= ${PROJECT_VERSION})\n")
endforeach()
file(WRITE ${PROJECT_BINARY_DIR}/package/shlibs "${shlibs}")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/package/shlibs ${PROJECT_BINARY_DIR}/package/triggers)
# GDAL is loaded when it is needed, so that CPack sees no dependency.
set(recommended "plotscan-data ${same}")
if(TARGET GDAL::GDAL)
  string(REGEX REPLACE "\\.so\\." "" gdal ${PLOTSCAN_GDAL_LIBRARY})
  set(CPACK_DEBIAN_PROGRAMS_PACKAGE_RECOMMENDS ${gdal})
  string(APPEND recommended ", ${gdal}")
endif()
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS ${recommended})
# Python's compiled files come with the package and go with it.
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/debian/python/postinst
  ${PROJECT_SOURCE_DIR}/cmake/debian/python/prerm)
set(CPACK_DEBIAN_DATA_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DATA_PACKAGE_SHLIBDEPS OFF)
include(CPack)
