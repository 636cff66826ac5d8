# Installs the executables, every room's library and headers, and a package that find_package(enfilade) finds.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(ENFILADE_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/enfilade)
get_property(enfilade_rooms GLOBAL PROPERTY ENFILADE_ROOMS)

install(TARGETS enfilade_options ${enfilade_rooms} EXPORT enfilade_targets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT enfilade_targets NAMESPACE enfilade:: FILE enfiladeTargets.cmake
        DESTINATION ${ENFILADE_PACKAGE_DIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/enfilade
        FILES_MATCHING PATTERN "*.hpp" PATTERN cmake EXCLUDE)

# The packages that the rooms' libraries link; the tests' own are looked for later.
get_property(enfilade_packages GLOBAL PROPERTY PACKAGES_FOUND)
list(REMOVE_ITEM enfilade_packages SimGrid GTest benchmark)
list(REMOVE_DUPLICATES enfilade_packages)
list(JOIN enfilade_packages " " ENFILADE_PACKAGES)

file(GLOB enfilade_find_modules ${CMAKE_CURRENT_LIST_DIR}/Find*.cmake)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/enfiladeConfig.cmake.in
  ${PROJECT_BINARY_DIR}/enfiladeConfig.cmake INSTALL_DESTINATION ${ENFILADE_PACKAGE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/enfiladeConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/enfiladeConfig.cmake
              ${PROJECT_BINARY_DIR}/enfiladeConfigVersion.cmake
              ${enfilade_find_modules}
        DESTINATION ${ENFILADE_PACKAGE_DIR})

install(TARGETS enfilade enfilade-mpi RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(TARGET enfilade-smpi)
  install(PROGRAMS $<TARGET_FILE:enfilade-smpi> DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
foreach(folder platforms scenes)
  if(IS_DIRECTORY ${PROJECT_SOURCE_DIR}/${folder})
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} DESTINATION ${CMAKE_INSTALL_DATADIR}/enfilade)
  endif()
endforeach()
