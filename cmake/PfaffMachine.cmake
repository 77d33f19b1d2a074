# The instructions that everything is compiled for. Built by itself, Pfaff is for the machine that builds it; packages,
# and builds as a part of another project, are for every machine of the architecture (preset `portable`).
include(CheckCXXCompilerFlag)

set(pfaff_default_march "")
if(PROJECT_IS_TOP_LEVEL)
  check_cxx_compiler_flag(-march=native PFAFF_HAS_NATIVE)
  if(PFAFF_HAS_NATIVE)
    set(pfaff_default_march native)
  endif()
endif()
set(PFAFF_MARCH "${pfaff_default_march}" CACHE STRING
    "Value of -march for every target; empty for every machine of the architecture")
set(pfaff_march_option "")
if(PFAFF_MARCH)
  set(pfaff_march_option -march=${PFAFF_MARCH})
endif()

# Compiles `source`, which compares the instructions that the library needs with those of the machine that runs it, for
# every machine of the architecture; elsewhere it would be the first to use an instruction that is missing. `result`
# becomes the options that ask for the same instructions, each by its name.
function(pfaff_check_machine source result)
  set(macros "")
  if(PFAFF_MARCH AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    execute_process(COMMAND ${CMAKE_CXX_COMPILER} ${pfaff_march_option} -dM -E -x c++ /dev/null
                    OUTPUT_VARIABLE macros COMMAND_ERROR_IS_FATAL ANY)
    set_source_files_properties(${source} PROPERTIES COMPILE_OPTIONS -march=x86-64)
  endif()
  set(required "")
  set(options "")
  foreach(set IN ITEMS popcnt bmi bmi2 avx avx2 fma avx512f avx512cd avx512bw avx512dq avx512vl avx512ifma
                       avx512vbmi avx512vbmi2 avx512vnni avx512bitalg avx512vpopcntdq)
    string(TOUPPER ${set} macro)
    if(macros MATCHES "#define __${macro}__ ")
      string(APPEND required "PFAFF_REQUIRE(${set})")
      string(APPEND options " -m${set}")
    endif()
  endforeach()
  set_source_files_properties(${source} PROPERTIES COMPILE_DEFINITIONS "PFAFF_REQUIRED=${required}" SKIP_PRECOMPILE_HEADERS ON)
  set(${result} "${options}" PARENT_SCOPE)
endfunction()
