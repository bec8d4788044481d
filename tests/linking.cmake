# Tests of the library as others link it (from C, installed, shared, torn down in any order), its documentation, and the
# command's completion, manual page and plots.
enable_language(C)

add_executable(test_c_api test_c_api.c)
target_compile_features(test_c_api PRIVATE c_std_99)
target_compile_options(test_c_api PRIVATE -Wall -Wextra -Wconversion)
target_compile_definitions(test_c_api PRIVATE CL_TARGET_OPENCL_VERSION=120)
target_link_libraries(test_c_api PRIVATE vorocl $<$<NOT:$<PLATFORM_ID:Windows>>:m>)
add_test(NAME c_api COMMAND test_c_api)

if(BUILD_SHARED_LIBS) # test_device looks at what a shared library hides
  target_sources(test_device PRIVATE $<TARGET_OBJECTS:vorocl>)
endif()

# --- teardown ---
add_executable(run_teardown run_teardown.cpp)
target_link_libraries(run_teardown PRIVATE vorocl vorocl_build)
add_test(NAME teardown COMMAND run_teardown)
add_test(NAME teardown_under_valgrind
         COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/run_valgrind.sh $<TARGET_FILE:run_teardown>)
set_tests_properties(teardown_under_valgrind PROPERTIES SKIP_RETURN_CODE 77)

# --- symbols ---
# Whatever this build is: a shared library from its objects, and its sources unoptimised.
add_library(vorocl_exported SHARED $<TARGET_OBJECTS:vorocl>)
target_link_libraries(vorocl_exported PRIVATE OpenCL::OpenCL Threads::Threads)
export_only_the_api(vorocl_exported)
list(TRANSFORM sources PREPEND ${PROJECT_SOURCE_DIR}/ OUTPUT_VARIABLE library_sources)
add_library(vorocl_unoptimised STATIC ${library_sources})
target_compile_options(vorocl_unoptimised PRIVATE -O0 -g0)
target_include_directories(vorocl_unoptimised PRIVATE ${PROJECT_SOURCE_DIR}/src
                           $<TARGET_PROPERTY:vorocl,INTERFACE_INCLUDE_DIRECTORIES>)
target_link_libraries(vorocl_unoptimised PRIVATE OpenCL::OpenCL vorocl_build)
add_test(NAME exported_symbols
         COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/check_symbols.sh exported $<TARGET_FILE:vorocl_exported>)
add_test(NAME bindings_symbols
         COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/check_symbols.sh bindings $<TARGET_FILE:vorocl_unoptimised>)
set_tests_properties(exported_symbols bindings_symbols PROPERTIES SKIP_RETURN_CODE 77)

# --- an installed copy, and projects that use it ---
set(prefix ${CMAKE_CURRENT_BINARY_DIR}/installed)
add_test(NAME install COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/install_copy.sh ${CMAKE_COMMAND} ${PROJECT_BINARY_DIR} ${prefix})
set_tests_properties(install PROPERTIES FIXTURES_SETUP installed_copy)

function(add_consumer name folder)
  add_test(NAME ${name}
    COMMAND ${CMAKE_CTEST_COMMAND} --build-and-test ${folder} ${CMAKE_CURRENT_BINARY_DIR}/${name}
            --build-generator ${CMAKE_GENERATOR} --build-project ${name}
            --build-options -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_BUILD_TYPE=Debug
                            -DVOROCL_EXPECTED_VERSION=${PROJECT_VERSION}
            --test-command ${CMAKE_CTEST_COMMAND} --output-on-failure)
  set_tests_properties(${name} PROPERTIES FIXTURES_REQUIRED installed_copy)
endfunction()
add_consumer(consumer ${CMAKE_CURRENT_SOURCE_DIR}/consumer)
add_consumer(consumer_picture ${CMAKE_CURRENT_SOURCE_DIR}/consumer/picture)

add_test(NAME consumer_pkg_config
         COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/consumer/pkg_config.sh ${prefix}/${CMAKE_INSTALL_LIBDIR} ${PROJECT_VERSION}
                 ${CMAKE_C_COMPILER} ${CMAKE_CURRENT_SOURCE_DIR}/test_c_api.c)
set_tests_properties(consumer_pkg_config PROPERTIES FIXTURES_REQUIRED installed_copy SKIP_RETURN_CODE 77)

# --- documentation ---
add_test(NAME doxygen COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/check_docs.sh ${CMAKE_CURRENT_BINARY_DIR}/docs)
set_tests_properties(doxygen PROPERTIES SKIP_RETURN_CODE 77)

add_test(NAME completion COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/test_completion.sh $<TARGET_FILE:vorocl_tool>)
add_test(NAME manual_page COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/check_man.sh $<TARGET_FILE:vorocl_tool>
                                  ${PROJECT_SOURCE_DIR}/docs/vorocl.1)

add_test(NAME plot_evaluation COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/test_plot_evaluation.sh $<TARGET_FILE:vorocl_tool>)
set_tests_properties(plot_evaluation PROPERTIES SKIP_RETURN_CODE 77)
add_test(NAME evaluation_scripts
         COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/test_evaluation_scripts.sh $<TARGET_FILE:vorocl_tool>)
set_tests_properties(evaluation_scripts PROPERTIES SKIP_RETURN_CODE 77)
