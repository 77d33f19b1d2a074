# Plug-ins outside the library: the templates of CONTRIBUTING.md as they stand, files that must be refused before
# they are loaded, sources that the compiler must refuse, and the examples built against the installed package. One
# more test looks at the citations.

function(pfaff_test_plugin name)
  add_library(${name}_plugin MODULE ${ARGN})
  target_link_libraries(${name}_plugin PRIVATE pfaff)
  set_target_properties(${name}_plugin PROPERTIES PREFIX "" OUTPUT_NAME ${name} DEFINE_SYMBOL ""
                                                  LIBRARY_OUTPUT_DIRECTORY ${pfaff_plugins})
  pfaff_target(${name}_plugin)
  pfaff_cold_target(${name}_plugin)
endfunction()

# The same for plug-ins without flags of their own, after what nearly all of them include. Definitions of their own, which
# the first has none of, are of names that these headers do not mention. The templates are compiled after what they
# include themselves, as their copies are.
function(pfaff_precompiled_plugin name)
  pfaff_test_plugin(${name} ${ARGN})
  if(pfaff_precompiled)
    target_precompile_headers(${name}_plugin REUSE_FROM ${pfaff_precompiled})
  else()
    target_precompile_headers(${name}_plugin PRIVATE <pfaff/core/system.hpp> <pfaff/core/facets/method_instance.hpp>)
    set(pfaff_precompiled ${name}_plugin PARENT_SCOPE)
  endif()
endfunction()

file(GLOB templates CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/examples/templates/*.cpp)
pfaff_test_plugin(templates ${templates})
# The copies are compiled for every dimension that methods are compiled for.
set_property(TARGET templates_plugin PROPERTY COMPILE_DEFINITIONS "")

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

# Flags that change the layout or the meaning of types that plug-ins and library share.
pfaff_test_plugin(short-enums ${witness})
target_compile_options(short-enums_plugin PRIVATE -fshort-enums)
pfaff_test_plugin(unsigned-char ${witness})
target_compile_options(unsigned-char_plugin PRIVATE -funsigned-char)

# Plug-ins that throw while they are loaded, bear names that cannot be written, or are faulty in other ways.
pfaff_test_plugin(throws-error app/plugins/throws_loading.cpp)
target_compile_definitions(throws-error_plugin PRIVATE "THROWN=std::logic_error(\"not today\")")
pfaff_test_plugin(throws-odd app/plugins/throws_loading.cpp)
target_compile_definitions(throws-odd_plugin PRIVATE THROWN=Odd{})
pfaff_test_plugin(ends-by-signal app/plugins/throws_loading.cpp)
target_compile_definitions(ends-by-signal_plugin PRIVATE "WORSE=std::raise(SIGTERM)")
pfaff_test_plugin(ends-by-itself app/plugins/throws_loading.cpp)
target_compile_definitions(ends-by-itself_plugin PRIVATE "WORSE=std::_Exit(0)")
# What may not happen while a plug-in is loaded, on trial or for the second time.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")  # one of them sets the flags of SSE
  foreach(what hang come_back_twice leave_a_process exit_later exit_quickly_later throw_later fork_later change_the_process)
    string(REPLACE _ - name ${what})
    pfaff_test_plugin(${name} app/plugins/misbehaves.cpp)
    target_compile_definitions(${name}_plugin PRIVATE MISBEHAVES=${what})
    add_dependencies(core_tests ${name}_plugin)
    add_dependencies(app_tests ${name}_plugin)
  endforeach()
endif()
pfaff_test_plugin(misnamed-system app/plugins/misnamed.cpp)
target_compile_definitions(misnamed-system_plugin PRIVATE "NAME=\"My System\"" "PARAMETER=\"rate\"")
pfaff_test_plugin(misnamed-parameter app/plugins/misnamed.cpp)
target_compile_definitions(misnamed-parameter_plugin PRIVATE "NAME=\"well-named\"" "PARAMETER=\"rate=1\"")
pfaff_precompiled_plugin(faulty app/plugins/faulty.cpp)
pfaff_precompiled_plugin(throws-late app/plugins/throws_late.cpp)
add_dependencies(app_tests faulty_plugin throws-late_plugin starts-fast_plugin)

# A system whose structure is degenerate.
pfaff_precompiled_plugin(degenerate app/plugins/degenerate.cpp)

# Two builds of one plug-in.
foreach(stiffness 1 2)
  pfaff_precompiled_plugin(spring-${stiffness} app/plugins/spring.cpp)
  target_compile_definitions(spring-${stiffness}_plugin PRIVATE SPRING_STIFFNESS=${stiffness})
endforeach()
add_dependencies(app_tests degenerate_plugin spring-1_plugin spring-2_plugin)

# Methods with false claims, for the search of counterexamples.
pfaff_precompiled_plugin(false-claims app/plugins/false_claims.cpp)
add_dependencies(verify_tests false-claims_plugin)
add_dependencies(app_tests false-claims_plugin)

add_dependencies(core_tests fits_plugin starts-fast_plugin other-version_plugin no-stamp_plugin two-stamps_plugin
                 fast-math_plugin templates_plugin)
add_test(NAME core/refused COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/core/refused_test.sh ${CMAKE_CXX_COMPILER}
                                   ${PROJECT_BINARY_DIR}/include ${PROJECT_SOURCE_DIR})
add_test(NAME app/references COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/app/references_test.sh ${PROJECT_SOURCE_DIR})
add_test(NAME app/plugins COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/app/plugins_test.sh $<TARGET_FILE:pfaff_app> ${pfaff_plugins})
add_test(NAME app/falsify COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/app/falsify_test.sh $<TARGET_FILE:pfaff_app> ${pfaff_plugins}
                                  "${PFAFF_SANITIZE}")
set_tests_properties(app/falsify PROPERTIES TIMEOUT 600)
set(team "")
if(NOT PFAFF_MPI)
  set(team ${PROJECT_SOURCE_DIR}/bench/launched/mpi.cpp ${PROJECT_BINARY_DIR}/include ${CMAKE_CXX_COMPILER})
endif()
if(PFAFF_MPI OR NOT PFAFF_SANITIZE)  # sanitizers refuse what is loaded before them
  add_test(NAME app/mpi COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/app/mpi_test.sh $<TARGET_FILE:pfaff_app> ${team})
  set_tests_properties(app/mpi PROPERTIES SKIP_RETURN_CODE 77)
endif()
add_test(NAME app/run_path COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/app/run_path_test.sh
                                   ${PROJECT_BINARY_DIR} ${CMAKE_COMMAND} $<TARGET_FILE:pfaff_app> ${CMAKE_CXX_COMPILER})
set(flags "")
if(PFAFF_SANITIZE)
  string(APPEND flags " -fsanitize=${PFAFF_SANITIZE}")
endif()
add_test(NAME app/out_of_tree COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/app/out_of_tree_test.sh
                                      ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR} ${CMAKE_COMMAND} "${flags}")
add_test(NAME app/public_headers COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/app/public_headers_test.sh
                                         ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR} ${CMAKE_COMMAND} "${flags}")
set_tests_properties(app/plugins PROPERTIES TIMEOUT 600)
# Compilers take minutes in them: ctest starts them among the first.
set_tests_properties(app/out_of_tree app/public_headers PROPERTIES TIMEOUT 1200 COST 100)
