# SimGrid comes without a CMake package in Debian. Defines:
#   SimGrid::SimGrid  the library and its S4U headers
#   SimGrid::SMPI     the same, with SMPI's mpi.h before any other
# smpirun loads a program as a shared object, so that each rank has its own globals: link it with -shared and
# compile its objects with -fPIC.
find_path(SimGrid_INCLUDE_DIR simgrid/s4u.hpp)
find_path(SimGrid_SMPI_INCLUDE_DIR mpi.h PATH_SUFFIXES smpi HINTS ${SimGrid_INCLUDE_DIR}
          NO_DEFAULT_PATH)
find_library(SimGrid_LIBRARY simgrid)
find_program(SimGrid_SMPIRUN smpirun)
if(SimGrid_INCLUDE_DIR AND EXISTS ${SimGrid_INCLUDE_DIR}/simgrid/version.h)
  file(STRINGS ${SimGrid_INCLUDE_DIR}/simgrid/version.h SimGrid_version_lines
       REGEX "define SIMGRID_VERSION_(MAJOR|MINOR|PATCH)")
  string(REGEX REPLACE ".*MAJOR +([0-9]+).*MINOR +([0-9]+).*PATCH +([0-9]+).*" "\\1.\\2.\\3"
         SimGrid_VERSION "${SimGrid_version_lines}")
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(SimGrid
  REQUIRED_VARS SimGrid_LIBRARY SimGrid_INCLUDE_DIR SimGrid_SMPI_INCLUDE_DIR SimGrid_SMPIRUN
  VERSION_VAR SimGrid_VERSION)
if(SimGrid_FOUND AND NOT TARGET SimGrid::SimGrid)
  add_library(SimGrid::SimGrid UNKNOWN IMPORTED)
  set_target_properties(SimGrid::SimGrid PROPERTIES
    IMPORTED_LOCATION ${SimGrid_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${SimGrid_INCLUDE_DIR})
  add_library(SimGrid::SMPI INTERFACE IMPORTED)
  target_include_directories(SimGrid::SMPI BEFORE INTERFACE ${SimGrid_SMPI_INCLUDE_DIR})
  target_link_libraries(SimGrid::SMPI INTERFACE SimGrid::SimGrid)
endif()
mark_as_advanced(SimGrid_INCLUDE_DIR SimGrid_SMPI_INCLUDE_DIR SimGrid_LIBRARY SimGrid_SMPIRUN)
