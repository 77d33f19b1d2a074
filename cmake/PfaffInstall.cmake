# Installation and the package that find_package(Pfaff) finds. The components `libraries` and `data`, with `python`, are
# what a wheel holds.
include(CMakePackageConfigHelpers)

install(TARGETS pfaff pfaff_plugins pfaff_bench pfaff_studies EXPORT PfaffTargets
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT libraries NAMELINK_COMPONENT development)
install(TARGETS pfaff_trial_load RUNTIME DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT libraries)  # beside the library, which starts it
install(TARGETS pfaff_app RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
# The list of public headers is read here too, so that a false one is refused before anything is built.
include(cmake/PfaffHeaders.cmake)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS cmake/public_headers.txt)
pfaff_public_headers(pfaff_listed ${PROJECT_SOURCE_DIR})
install(CODE "
  include(\"${PROJECT_SOURCE_DIR}/cmake/PfaffHeaders.cmake\")
  pfaff_install_headers(\"${PROJECT_SOURCE_DIR}\" \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}\")")
install(DIRECTORY bench/report DESTINATION ${CMAKE_INSTALL_DATADIR}/pfaff COMPONENT data
        PATTERN "__pycache__" EXCLUDE)
# Experiments name tables and models by their paths in the source tree; installed, the examples stand beside them.
file(GLOB experiments CONFIGURE_DEPENDS bench/experiments/*.toml)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${experiments})
foreach(experiment ${experiments})
  file(READ ${experiment} text)
  string(REPLACE "../../examples/" "../examples/" text "${text}")
  get_filename_component(name ${experiment} NAME)
  file(WRITE ${PROJECT_BINARY_DIR}/installed/experiments/${name} "${text}")
endforeach()
install(DIRECTORY ${PROJECT_BINARY_DIR}/installed/experiments DESTINATION ${CMAKE_INSTALL_DATADIR}/pfaff
        COMPONENT data)
# Which items of papers have rows, and models and tables that rows of `pfaff reproduce others` run.
install(DIRECTORY papers/coverage DESTINATION ${CMAKE_INSTALL_DATADIR}/pfaff/papers COMPONENT data
        FILES_MATCHING PATTERN "*.toml")
install(DIRECTORY examples/models examples/tables examples/templates examples/plugin DESTINATION ${CMAKE_INSTALL_DATADIR}/pfaff/examples COMPONENT data)
install(FILES ${pfaff_written}/pfaff.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${pfaff_written}/pfaff DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${pfaff_written}/_pfaff DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
install(FILES references.bib DESTINATION ${CMAKE_INSTALL_DATADIR}/pfaff COMPONENT data)
install(EXPORT PfaffTargets NAMESPACE Pfaff:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Pfaff)
configure_package_config_file(cmake/PfaffConfig.cmake.in ${PROJECT_BINARY_DIR}/PfaffConfig.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Pfaff)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/PfaffConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/PfaffConfig.cmake ${PROJECT_BINARY_DIR}/PfaffConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Pfaff)
