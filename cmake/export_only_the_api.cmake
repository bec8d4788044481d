# Lets a shared library export the API and nothing else, where the linker can be told so.
function(export_only_the_api target)
  if(UNIX AND NOT APPLE)
    set(map ${PROJECT_BINARY_DIR}/vorocl.map)
    configure_file(${PROJECT_SOURCE_DIR}/cmake/vorocl.map.in ${map} @ONLY)
    target_link_options(${target} PRIVATE LINKER:--version-script=${map})
    set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS ${map})
  endif()
endfunction()
