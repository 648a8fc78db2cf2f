# Everything Plotscan builds on, found once. packages.txt names the Debian packages.
# CGAL's and PCL's configs leave open what newer CMake asks of them.
set(CMAKE_POLICY_DEFAULT_CMP0144 NEW)
set(CMAKE_POLICY_DEFAULT_CMP0167 NEW)

find_package(Threads REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(nlohmann_json REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(tinyxml2 REQUIRED)
find_package(CLI11 REQUIRED)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(TBB REQUIRED)
find_package(assimp REQUIRED)
find_package(meshoptimizer REQUIRED)
find_package(CGAL REQUIRED)
# Debian 13 has no libsdformat: farms are exported all the same.
find_package(sdformat12 QUIET)
if(sdformat12_FOUND)
  find_package(console_bridge REQUIRED)
else()
  message(STATUS "SDF worlds are not read, and their tests are left out: both need libsdformat-dev, which Debian 12 has")
endif()
find_package(PNG REQUIRED)
find_package(JPEG REQUIRED)
find_package(ZLIB REQUIRED)
# Programs build without what only tests need (packages.txt, section tests).
find_package(benchmark QUIET)
if(NOT benchmark_FOUND)
  message(STATUS "benchmarks/speed is left out: it needs libbenchmark-dev")
endif()
if(BUILD_TESTING)
  find_package(GTest QUIET)
  if(NOT GTest_FOUND)
    message(STATUS "The tests are left out: scripts/setup installs what they need")
    set(BUILD_TESTING OFF)
  endif()
  # Gazebo's mesh loader, and the elements of each version of SDF, as libsdformat ships them.
  find_package(ignition-common4 QUIET COMPONENTS graphics)
  find_path(SDF_SPECIFICATIONS 1.6/root.sdf PATH_SUFFIXES share/sdformat12)
  if(sdformat12_FOUND AND ignition-common4_FOUND AND SDF_SPECIFICATIONS)
    set(PLOTSCAN_GAZEBO_TESTS ON)
  else()
    message(STATUS "Exported worlds are not tested by Gazebo's own libraries: that needs libsdformat-dev and "
      "libignition-common-graphics-dev, which Debian 12 has")
  endif()
endif()

# Embree 4 where the system has it (Debian 13, Ubuntu 24.04), else Embree 3 (Debian 12).
find_package(embree 4 QUIET)
if(NOT embree_FOUND)
  find_package(embree 3 REQUIRED)
endif()

find_package(PkgConfig REQUIRED)
pkg_check_modules(geographiclib REQUIRED IMPORTED_TARGET geographiclib)
pkg_check_modules(xxhash REQUIRED IMPORTED_TARGET libxxhash)
pkg_check_modules(libcrypto REQUIRED IMPORTED_TARGET libcrypto)
# Without it lidarsim neither writes nor reads Velodyne's recordings.
pkg_check_modules(pcap QUIET IMPORTED_TARGET libpcap)
# Without it LAZ and COPC are refused. Debian 13 and Ubuntu 24.04 have it (liblaszip-dev), Debian 12 has not.
find_path(LASZIP_INCLUDE_DIR laszip/laszip_api.h)
find_library(LASZIP_LIBRARY laszip)
if(LASZIP_INCLUDE_DIR AND LASZIP_LIBRARY)
  add_library(laszip UNKNOWN IMPORTED)
  set_target_properties(laszip PROPERTIES IMPORTED_LOCATION ${LASZIP_LIBRARY})
  target_include_directories(laszip SYSTEM INTERFACE ${LASZIP_INCLUDE_DIR})
endif()
# Without it maps of plots are GeoJSON only.
find_package(GDAL 3 QUIET)
if(TARGET GDAL::GDAL)  # loaded when it is needed, by the name that Debian's package of it has, too: libgdal.so.32, libgdal32
  get_target_property(library GDAL::GDAL LOCATION)
  execute_process(COMMAND ${CMAKE_READELF} -d ${library} OUTPUT_VARIABLE facts COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCH "SONAME[^[]*\\[([^]]+)" facts "${facts}")
  set(PLOTSCAN_GDAL_LIBRARY ${CMAKE_MATCH_1})
endif()
pkg_check_modules(lzf REQUIRED IMPORTED_TARGET liblzf)
pkg_check_modules(lz4 REQUIRED IMPORTED_TARGET liblz4)
pkg_check_modules(zstd REQUIRED IMPORTED_TARGET libzstd)

# Random123 is headers without a package config.
find_path(RANDOM123_INCLUDE_DIR Random123/philox.h REQUIRED)
add_library(random123 INTERFACE IMPORTED)
target_include_directories(random123 SYSTEM INTERFACE ${RANDOM123_INCLUDE_DIR})

# PCL's config hands out variables; behind targets its flags reach only what links them. Its files are apart, for tests: they need VTK,
# which takes a tenth of a second to load, and whose config warns about packages that PCL does not need (hence QUIET).
find_package(PCL 1.12 QUIET REQUIRED COMPONENTS common io filters ml sample_consensus segmentation)
add_library(pcl INTERFACE IMPORTED)
target_include_directories(pcl SYSTEM INTERFACE ${PCL_INCLUDE_DIRS})
target_link_libraries(pcl INTERFACE ${PCL_COMMON_LIBRARIES} ${PCL_FILTERS_LIBRARIES} ${PCL_SAMPLE_CONSENSUS_LIBRARIES}
  ${PCL_SEGMENTATION_LIBRARIES})
target_compile_definitions(pcl INTERFACE ${PCL_DEFINITIONS})
add_library(pcl_files INTERFACE)
target_link_libraries(pcl_files INTERFACE pcl ${PCL_IO_LIBRARIES})
