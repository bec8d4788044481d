# Lets a shared library export the API and nothing else, where the linker can be told so.
function(export_only_the_api target)
  set(map ${PROJECT_SOURCE_DIR}/cmake/vorocl.map)
  if(UNIX AND NOT APPLE)
    target_link_options(${target} PRIVATE LINKER:--version-script=${map})
    set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS ${map})
  endif()
endfunction()
