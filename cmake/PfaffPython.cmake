# The Python module `pfaff`: an extension, `_pfaff`, and beside it the files of python/pfaff.
find_program(PFAFF_PYTHON_PROGRAM python3 PATHS /usr/bin NO_DEFAULT_PATH)  # the one that Debian's packages are for
find_program(PFAFF_PYTHON_PROGRAM python3)

# In older build folders the program had this name.
if(IS_ABSOLUTE "${PFAFF_PYTHON}")
  unset(PFAFF_PYTHON CACHE)
endif()
set(PFAFF_PYTHON ${pfaff_python_default} CACHE STRING "Build the Python module: ON, OFF, or AUTO, where what it needs is there")
set_property(CACHE PFAFF_PYTHON PROPERTY STRINGS AUTO ON OFF)
if(PFAFF_PYTHON STREQUAL "OFF")
  return()
elseif(NOT PFAFF_PYTHON MATCHES "^(AUTO|ON)$")
  message(FATAL_ERROR "PFAFF_PYTHON is '${PFAFF_PYTHON}'; expected AUTO, ON or OFF")
endif()

set(missing "")
set(Python_EXECUTABLE ${PFAFF_PYTHON_PROGRAM})
find_package(Python COMPONENTS Interpreter Development.Module QUIET)
if(NOT Python_FOUND)
  list(APPEND missing python3-dev)
endif()
find_package(pybind11 2.10 QUIET)
if(NOT pybind11_FOUND)
  list(APPEND missing pybind11-dev)
endif()
execute_process(COMMAND ${PFAFF_PYTHON_PROGRAM} -c "import numpy" RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
if(NOT failed EQUAL 0)
  list(APPEND missing python3-numpy)
endif()
if(missing)
  list(JOIN missing ", " missing)
  set(message "the Python module is not built: missing are (Debian names) ${missing}")
  if(PFAFF_PYTHON STREQUAL "ON")
    message(FATAL_ERROR "${message}")
  endif()
  message(STATUS "${message}")
  return()
endif()

# Where the package is installed below a prefix such as /usr/local. In a wheel it is the prefix itself.
execute_process(
  COMMAND ${PFAFF_PYTHON_PROGRAM} -c
          "import sysconfig; print(sysconfig.get_path('platlib', vars={'base': '', 'platbase': ''}).replace('/local/', '/', 1)[1:])"
  OUTPUT_VARIABLE packages OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
set(PFAFF_PYTHON_DESTINATION ${packages}/pfaff CACHE STRING "Where the package of Python is installed, below the prefix")

file(GLOB pfaff_python_sources CONFIGURE_DEPENDS python/src/*.cpp)
add_library(pfaff_python MODULE ${pfaff_python_sources})
target_link_libraries(pfaff_python PRIVATE pfaff_studies pybind11::module tomlplusplus::tomlplusplus)
pfaff_target(pfaff_python)
pfaff_cold_target(pfaff_python)
pfaff_joined(pfaff_python 4)
set(pfaff_python_package ${PROJECT_BINARY_DIR}/python/pfaff)
set_target_properties(pfaff_python PROPERTIES
  OUTPUT_NAME _pfaff PREFIX "" SUFFIX ".${Python_SOABI}.so" LIBRARY_OUTPUT_DIRECTORY ${pfaff_python_package}
  # The objects of pybind11 are hidden; two modules of it would otherwise share what each has for itself.
  CXX_VISIBILITY_PRESET hidden)
target_precompile_headers(pfaff_python PRIVATE <pybind11/numpy.h> <pybind11/stl.h> <pfaff/core/system.hpp> <pfaff/core/facets/method_instance.hpp>)

# What is imported before it, and says where the machine lacks instructions that the libraries are compiled for. Loading
# them would end the interpreter.
pfaff_check_machine(python/machine/machine.cpp unused)
add_library(pfaff_python_machine MODULE python/machine/machine.cpp)
target_include_directories(pfaff_python_machine PRIVATE ${pfaff_include})
target_link_libraries(pfaff_python_machine PRIVATE Python::Module)
pfaff_target(pfaff_python_machine)
set_target_properties(pfaff_python_machine PROPERTIES
  OUTPUT_NAME _machine PREFIX "" SUFFIX ".${Python_SOABI}.so" LIBRARY_OUTPUT_DIRECTORY ${pfaff_python_package})

# `lib` beside the extension is the folder of the libraries, in a wheel a folder of its own; installed by
# `cmake --install` they stand where those of the program do.
file(RELATIVE_PATH pfaff_python_libraries /prefix/${PFAFF_PYTHON_DESTINATION} /prefix/${CMAKE_INSTALL_LIBDIR})
string(REGEX REPLACE "/$" "" pfaff_python_libraries "${pfaff_python_libraries}")
set(pfaff_python_run_path "$ORIGIN/lib" "$ORIGIN/${pfaff_python_libraries}")
list(REMOVE_DUPLICATES pfaff_python_run_path)
pfaff_run_path(pfaff_python ${pfaff_python_run_path})

# In the build tree the files are links to those of the source tree, so that an edited one needs no build.
file(GLOB_RECURSE pfaff_python_files RELATIVE ${PROJECT_SOURCE_DIR}/python/pfaff CONFIGURE_DEPENDS
     python/pfaff/*.py python/pfaff/*.pyi python/pfaff/py.typed python/pfaff/*.css python/pfaff/*.mplstyle)
file(GLOB former ${pfaff_python_package}/*.py)  # perhaps of files that are no more
if(former)
  file(REMOVE ${former})
endif()
file(MAKE_DIRECTORY ${pfaff_python_package})
file(CREATE_LINK ${PROJECT_BINARY_DIR} ${pfaff_python_package}/lib SYMBOLIC)
foreach(file ${pfaff_python_files})
  get_filename_component(folder ${file} DIRECTORY)
  file(MAKE_DIRECTORY ${pfaff_python_package}/${folder})
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/python/pfaff/${file} ${pfaff_python_package}/${file} SYMBOLIC)
endforeach()

install(TARGETS pfaff_python pfaff_python_machine LIBRARY DESTINATION ${PFAFF_PYTHON_DESTINATION} COMPONENT python)
install(DIRECTORY python/pfaff/ DESTINATION ${PFAFF_PYTHON_DESTINATION} COMPONENT python PATTERN "__pycache__" EXCLUDE)
