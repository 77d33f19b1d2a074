# What every target of Pfaff has in common. No global flags: each target says what it needs.
function(pfaff_target target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF CXX_VISIBILITY_PRESET default
                                             LINKER_LANGUAGE CXX)  # some have objects alone
  # Contraction changes results between machines, so it is set explicitly; runs record it.
  # GCC's note about 32-byte aligned arguments compares with an ABI of 2010; its 12th version sees overflows in
  # concatenations of strings where there are none (its bug 105651).
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-psabi
                                           -ffp-contract=off
                                           $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow;-Wno-restrict;-Wno-array-bounds>
                                           # GCC joins neighbouring results into vector loads; behind a call
                                           # those wait for scalar stores to leave the store buffer.
                                           $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>
                                           # GCC collects garbage from 128 megabytes on, again and again, which is
                                           # a seventh of the time of most tests; no source needs more than 1.2
                                           # gigabytes when it begins at one.
                                           $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=1000000>)
  # The build ID names the build in the identity of a run (bench/runner/origins.hpp).
  target_link_options(${target} PRIVATE -Wl,--build-id)
  if(PFAFF_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  target_compile_options(${target} PRIVATE ${pfaff_march_option})
  if(PFAFF_SANITIZE)
    # What is left out takes half of the time in which sources compile and finds what is found otherwise: following a
    # null pointer, loading a pack from where it is not aligned and calling through a pointer to no object stop the
    # program by themselves, the address sanitizer knows the sizes of objects and the ends of arrays better, and of
    # locals that are used after their block GCC warns (-Wdangling-pointer).
    target_compile_options(${target} PRIVATE -fsanitize=${PFAFF_SANITIZE} -fno-omit-frame-pointer
                                             -fno-sanitize-recover=all
                                             -fno-sanitize=null,alignment,object-size,pointer-overflow,vptr
                                             -fno-sanitize-address-use-after-scope
                                             # GCC takes parts of variants for uninitialised where it inlines less.
                                             -Wno-maybe-uninitialized)
    target_link_options(${target} PRIVATE -fsanitize=${PFAFF_SANITIZE})
  endif()
endfunction()

# What runs once, prints or is a test is compiled in half the time with few optimisations; what is measured is not.
# With so few of them GCC's 12th version takes parts of std::regex for uninitialised. PFAFF_COLD tells headers so, which
# then leave out what is there for speed alone: inlining that they ask for (core/facets/compiled_series.hpp), and methods
# for dimensions that the compiler knows (core/integrator.hpp).
set(pfaff_cold_options "$<$<CONFIG:Release>:-Og;-Wno-maybe-uninitialized>")
function(pfaff_cold_target target)
  target_compile_options(${target} PRIVATE ${pfaff_cold_options})
  target_compile_definitions(${target} PRIVATE PFAFF_COLD)
endfunction()

# Writes the names of a target's objects to a file, for tests and for builds that take them.
function(pfaff_list_objects target)
  if(PFAFF_TESTS AND NOT CMAKE_CONFIGURATION_TYPES)
    file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/objects/${target} CONTENT "$<JOIN:$<TARGET_OBJECTS:${target}>,\n>\n")
  endif()
endfunction()

# What a target is made of: sources or, where another build has compiled them, its objects (PFAFF_OBJECTS_FROM).
function(pfaff_compiled result target)
  set(made_of ${ARGN})
  pfaff_list_objects(${target})
  if(PFAFF_OBJECTS_FROM)
    file(STRINGS ${PFAFF_OBJECTS_FROM}/objects/${target} made_of)
  endif()
  set(${result} ${made_of} PARENT_SCOPE)
endfunction()

# Those of the sources in which a line matches the pattern.
function(pfaff_sources_with result pattern)
  set(found "")
  foreach(source ${ARGN})
    file(STRINGS ${source} lines REGEX "${pattern}")
    if(lines)
      list(APPEND found ${source})
    endif()
  endforeach()
  set(${result} ${found} PARENT_SCOPE)
endfunction()

# Sources that are compiled together parse headers, instantiate templates and compile inline functions once for all of
# them, `batch` at a time. Plug-ins are not: each has to be compiled again in seconds.
function(pfaff_joined target batch)
  if(PFAFF_JOINED)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${batch}
      UNITY_BUILD_CODE_BEFORE_INCLUDE "// NOLINTNEXTLINE(bugprone-suspicious-include)")
    # A local variable may have the name of what only another source declares, and what is joined is no header,
    # whose types must not depend on unnamed namespaces.
    target_compile_options(${target} PRIVATE
      $<$<CXX_COMPILER_ID:GNU>:-Wno-shadow;-Wshadow=local;-Wno-subobject-linkage>)
  endif()
endfunction()

# Libraries are looked for beside the file that needs them, never in the current directory. CMake pads the run path
# of what is to be installed with colons, so that the installed one fits in its place, and the loader takes an empty
# entry for the current directory; what is installed therefore has its final run path from the beginning.
set(CMAKE_BUILD_RPATH_USE_ORIGIN ON)
function(pfaff_run_path target)
  set_target_properties(${target} PROPERTIES BUILD_WITH_INSTALL_RPATH ON INSTALL_RPATH "${ARGN}")
endfunction()

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
string(TOUPPER ${CMAKE_BUILD_TYPE} pfaff_build_type)
