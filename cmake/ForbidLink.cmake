# plotscan_forbid_link(TARGET FORBIDDEN): stops the configuration when FORBIDDEN is among the
# libraries that TARGET links, directly or through others. It looks at the end of the top-level
# CMakeLists.txt, when every target is declared.
function(plotscan_forbid_link target forbidden)
  cmake_language(EVAL CODE
    "cmake_language(DEFER DIRECTORY [[${PROJECT_SOURCE_DIR}]] CALL plotscan_check_link ${target} ${forbidden})")
endfunction()

function(plotscan_check_link target forbidden)
  plotscan_link_closure(${target} closure)
  if(forbidden IN_LIST closure)
    message(FATAL_ERROR "${target} links ${forbidden}, directly or through another library; it must not "
      "be able to see it")
  endif()
endfunction()

# The targets that `target` links, directly or through others, whatever the visibility.
function(plotscan_link_closure target result)
  set(closure)
  set(pending ${target})
  while(pending)
    list(POP_FRONT pending current)
    foreach(property LINK_LIBRARIES INTERFACE_LINK_LIBRARIES)
      get_target_property(libraries ${current} ${property})
      if(NOT libraries)
        continue()
      endif()
      foreach(library IN LISTS libraries)
        # A static library's private dependency reads $<LINK_ONLY:name> in its interface.
        string(REGEX REPLACE "^\\$<LINK_ONLY:(.*)>$" "\\1" library "${library}")
        if(TARGET "${library}" AND NOT library IN_LIST closure)
          list(APPEND closure ${library})
          list(APPEND pending ${library})
        endif()
      endforeach()
    endforeach()
  endwhile()
  set(${result} ${closure} PARENT_SCOPE)
endfunction()
