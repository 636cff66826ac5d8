# Finds stb's single-header libraries; makes Stb::Stb (the headers) and Stb::Library (with what they declare, compiled).
find_path(STB_INCLUDE_DIR stb_easy_font.h PATH_SUFFIXES stb)
find_library(STB_LIBRARY stb)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Stb REQUIRED_VARS STB_INCLUDE_DIR STB_LIBRARY)
if(Stb_FOUND AND NOT TARGET Stb::Stb)
  add_library(Stb::Stb INTERFACE IMPORTED)
  set_target_properties(Stb::Stb PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${STB_INCLUDE_DIR}")
  add_library(Stb::Library UNKNOWN IMPORTED)
  set_target_properties(Stb::Library PROPERTIES
    IMPORTED_LOCATION "${STB_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${STB_INCLUDE_DIR}")
endif()
mark_as_advanced(STB_INCLUDE_DIR STB_LIBRARY)
