# The labels of a scan are the truth. The estimator reads clouds through record::read_positions, which hands
# on nothing else: no file of it includes another header of lidarsim, but for `inspect`, which tells what a
# cloud's file says of itself (scan/cloud_facts.h).
file(GLOB_RECURSE files ${SOURCES}/*.h ${SOURCES}/*.cpp)
if(NOT files)
  message(FATAL_ERROR "no files in ${SOURCES}")
endif()
foreach(file IN LISTS files)
  file(STRINGS ${file} includes REGEX "#include \"(flight|lidar|record|scan|scanpage|sensor)/")
  list(FILTER includes EXCLUDE REGEX "\"record/positions\\.h\"")
  if(file MATCHES "/inspect/")
    list(FILTER includes EXCLUDE REGEX "\"scan/cloud_facts\\.h\"")
  endif()
  if(includes)
    message(FATAL_ERROR "${file}: ${includes}: record/positions.h is the estimator's only door to clouds")
  endif()
endforeach()
