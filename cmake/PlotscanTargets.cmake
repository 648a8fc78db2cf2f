# How every library, program and test of Plotscan is declared.

# The files of a library, or a test, are compiled together: templates and headers that they share once for all of them. Not by Clang, nor
# without optimisation, where small rebuilds count.
set(unity OFF)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_BUILD_TYPE STREQUAL Release)
  set(unity ON)
endif()
option(PLOTSCAN_UNITY "Compile the files of each library and test together" ${unity})
option(PLOTSCAN_UNITY_COMMANDS "Compile the files of each program together" ON)

function(plotscan_compile_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
    # GCC 12 sees overlapping copies in std::string where there are none (GCC bug 105651).
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
    # Its file is the one that includes all others.
    $<$<AND:$<BOOL:${PLOTSCAN_UNITY}>,$<CXX_COMPILER_ID:GNU>>:-Wno-subobject-linkage>
    # Embedded texts are long.
    $<$<CXX_COMPILER_ID:Clang>:-Wno-overlength-strings>
    $<$<BOOL:${PLOTSCAN_WERROR}>:-Werror>)
  if(PLOTSCAN_SANITIZE)
    # GCC warns of uninitialised values where there are none (in its own <regex>) once a sanitizer is on, as its manual says.
    target_compile_options(${target} PRIVATE -fsanitize=${PLOTSCAN_SANITIZE} -fno-omit-frame-pointer
      $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
    # As Debian's PCL was built, whose vectors we free: Eigen changes how it allocates under the address sanitizer.
    target_compile_definitions(${target} PRIVATE EIGEN_MALLOC_ALREADY_ALIGNED=1)
    target_link_options(${target} PRIVATE -fsanitize=${PLOTSCAN_SANITIZE})
  endif()
endfunction()

# plotscan_library(NAME ROOT dir SOURCES ... PUBLIC ... PRIVATE ...)
# ROOT is the folder from which headers are included: "NAME/header.h" lies in ROOT/NAME/.
function(plotscan_library name)
  cmake_parse_arguments(ARG "" "ROOT" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_include_directories(${name} PUBLIC ${ARG_ROOT})
  target_link_libraries(${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  # The rooms are linked into the shared libraries of library/, which show their own functions only.
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON)
  set_target_properties(${name} PROPERTIES UNITY_BUILD ${PLOTSCAN_UNITY} UNITY_BUILD_BATCH_SIZE 0)
  plotscan_compile_options(${name})
endfunction()

# For what is compiled in two thirds of the time at -O1, and where that does not matter to users. GCC sees uninitialised values
# where there are none (in Eigen) when it optimises so little.
function(plotscan_optimise_less target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>
    $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU>>:-Wno-maybe-uninitialized>)
endfunction()

# Files that declare commands: CLI11 costs each of them more than all else, and less when it is compiled at -O1, once for
# all files of a target. They hand numbers on and compute none.
function(plotscan_command_files target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${PLOTSCAN_UNITY_COMMANDS} UNITY_BUILD_BATCH_SIZE 0)
  plotscan_optimise_less(${target})
endfunction()

# plotscan_program(NAME SOURCES ... LIBRARIES ...)
function(plotscan_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} program)
  if(NOT PLOTSCAN_SANITIZE)  # sanitizers have an operator new of their own
    target_sources(${name} PRIVATE $<TARGET_OBJECTS:huge_pages>)
  endif()
  plotscan_compile_options(${name})
  plotscan_command_files(${name})
endfunction()

# plotscan_test_program(NAME SOURCES ... LIBRARIES ...): one GoogleTest program, not yet a test.
function(plotscan_test_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} GTest::gmock GTest::gtest GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE
    PLOTSCAN_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    PLOTSCAN_SHARED_DATA_DIR="${PROJECT_SOURCE_DIR}/../shared/data")
  set_target_properties(${name} PROPERTIES UNITY_BUILD ${PLOTSCAN_UNITY} UNITY_BUILD_BATCH_SIZE 0)
  plotscan_compile_options(${name})
  plotscan_optimise_less(${name})
endfunction()

# Sets the variable to a test's time limit: under a sanitizer programs take up to ten times as long.
function(plotscan_time_limit variable seconds)
  if(PLOTSCAN_SANITIZE)
    math(EXPR seconds "10 * ${seconds}")
  endif()
  set(${variable} ${seconds} PARENT_SCOPE)
endfunction()

# plotscan_test(NAME SOURCES ... LIBRARIES ... TOGETHER ...): the same, its cases found by CTest, each a test and a process of its
# own; a suite of TOGETHER, whose cases share what takes long to make, is one.
function(plotscan_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES;TOGETHER" ${ARGN})
  plotscan_test_program(${name} SOURCES ${ARG_SOURCES} LIBRARIES ${ARG_LIBRARIES})
  plotscan_time_limit(seconds 300)
  set(alone)
  if(ARG_TOGETHER)
    list(TRANSFORM ARG_TOGETHER APPEND ".*" OUTPUT_VARIABLE alone)
    list(JOIN alone ":" alone)
    set(alone TEST_FILTER "-${alone}")
  endif()
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 ${alone} PROPERTIES TIMEOUT ${seconds})
  foreach(suite IN LISTS ARG_TOGETHER)
    add_test(NAME ${suite} COMMAND ${name} --gtest_filter=${suite}.*)
    set_tests_properties(${suite} PROPERTIES TIMEOUT ${seconds} COST 20)  # begun early
  endforeach()
endfunction()
include(GoogleTest)
# plotscan_embed_texts(SOURCE NAMESPACE FUNCTION HEADER name=file...): makes SOURCE, whose function
# returns the text of the file of a name, so that a program needs no path to it.
function(plotscan_embed_texts source EMBED_NAMESPACE EMBED_FUNCTION EMBED_HEADER)
  set(EMBED_TEXTS)
  foreach(entry IN LISTS ARGN)
    string(REPLACE "=" ";" entry "${entry}")
    list(GET entry 0 name)
    list(GET entry 1 file)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    file(READ ${file} text)
    string(APPEND EMBED_TEXTS "  if (name == \"${name}\") return R\"text(${text})text\";\n")
  endforeach()
  configure_file(${PROJECT_SOURCE_DIR}/cmake/embedded_texts.cpp.in ${source} @ONLY)
endfunction()
