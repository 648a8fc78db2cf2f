# The labels of a scan are the truth. The estimator reads clouds through read_positions, which hands
# on nothing else: no file of it includes another header of the room `scan`.
file(GLOB files ${SOURCES}/*.h ${SOURCES}/*.cpp)
if(NOT files)
  message(FATAL_ERROR "no files in ${SOURCES}")
endif()
foreach(file IN LISTS files)
  file(STRINGS ${file} includes REGEX "#include \"(scan|sensor|record|lidar)/")
  list(FILTER includes EXCLUDE REGEX "\"scan/cloud_reader\\.h\"")
  if(includes)
    message(FATAL_ERROR "${file}: ${includes}: scan/cloud_reader.h is the estimator's only door to clouds")
  endif()
endforeach()
