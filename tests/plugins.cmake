# Plug-ins outside the library: the templates of CONTRIBUTING.md as they stand, files that must be refused before
# they are loaded, sources that the compiler must refuse, and the examples built against the installed package. One
# more test looks at the citations.
set(pfaff_plugins ${CMAKE_CURRENT_BINARY_DIR}/plugins)

function(pfaff_test_plugin name)
  add_library(${name}_plugin MODULE ${ARGN})
  target_link_libraries(${name}_plugin PRIVATE pfaff)
  set_target_properties(${name}_plugin PROPERTIES PREFIX "" OUTPUT_NAME ${name}
                                                  LIBRARY_OUTPUT_DIRECTORY ${pfaff_plugins})
  pfaff_target(${name}_plugin)
endfunction()

file(GLOB templates CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/examples/templates/*.cpp)
pfaff_test_plugin(templates ${templates})

# `fits` is the control that does load; `starts-fast` fits too, but links start-up code that flushes subnormals.
set(witness app/plugins/witness.cpp)
pfaff_test_plugin(fits ${witness})
pfaff_test_plugin(starts-fast ${witness})
target_link_options(starts-fast_plugin PRIVATE -ffast-math)
pfaff_test_plugin(other-version ${witness})
target_compile_definitions(other-version_plugin PRIVATE OTHER_VERSION)
pfaff_test_plugin(no-stamp ${witness})
target_compile_definitions(no-stamp_plugin PRIVATE NO_STAMP)
pfaff_test_plugin(two-stamps ${witness} app/plugins/stale.cpp)
pfaff_test_plugin(fast-math ${witness})
target_compile_options(fast-math_plugin PRIVATE -ffast-math)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  pfaff_test_plugin(other-alignment ${witness})
  target_compile_options(other-alignment_plugin PRIVATE $<IF:$<BOOL:${PFAFF_MARCH}>,-mno-avx,-mavx512f>)
endif()

# A system whose structure is degenerate.
pfaff_test_plugin(degenerate app/plugins/degenerate.cpp)
target_compile_definitions(app_tests PRIVATE PFAFF_TEST_PLUGINS="${pfaff_plugins}")
add_dependencies(app_tests degenerate_plugin)

target_compile_definitions(core_tests PRIVATE PFAFF_TEST_PLUGINS="${pfaff_plugins}")
add_dependencies(core_tests fits_plugin starts-fast_plugin other-version_plugin no-stamp_plugin two-stamps_plugin
                 fast-math_plugin templates_plugin)
add_test(NAME core/refused COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/core/refused_test.sh ${CMAKE_CXX_COMPILER}
                                   ${PROJECT_BINARY_DIR}/include ${PROJECT_SOURCE_DIR})
add_test(NAME app/references COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/app/references_test.sh ${PROJECT_SOURCE_DIR})
add_test(NAME app/plugins COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/app/plugins_test.sh $<TARGET_FILE:pfaff_app> ${pfaff_plugins})
set(flags "")
if(PFAFF_MARCH)
  string(APPEND flags " -march=${PFAFF_MARCH}")
endif()
if(PFAFF_SANITIZE)
  string(APPEND flags " -fsanitize=${PFAFF_SANITIZE}")
endif()
add_test(NAME app/out_of_tree COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/app/out_of_tree_test.sh
                                      ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR} ${CMAKE_COMMAND} "${flags}")
set_tests_properties(app/plugins app/out_of_tree PROPERTIES TIMEOUT 600)
