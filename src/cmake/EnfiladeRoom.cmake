include(EnfiladeTogether)

# One static library a room. Rooms come in one order, and a room may use only those before it.
add_library(enfilade_options INTERFACE)
target_compile_features(enfilade_options INTERFACE cxx_std_20)
target_compile_options(enfilade_options INTERFACE
  $<BUILD_INTERFACE:-Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Werror>
  # GCC 12 sees overlap in std::string's operator+ where there is none (its bug 105651).
  $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>>)
if(ENFILADE_SANITIZE)
  target_compile_options(enfilade_options INTERFACE
    $<BUILD_INTERFACE:-fsanitize=${ENFILADE_SANITIZE} -fno-omit-frame-pointer>
    # Instrumented, GCC 12 takes std::regex's moved-from functions for uninitialised ones (its bug 105562).
    $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>>)
  target_link_options(enfilade_options INTERFACE $<BUILD_INTERFACE:-fsanitize=${ENFILADE_SANITIZE}>)
endif()
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

# enfilade_room(NAME SOURCES a.cpp ... [USES room_or_library ...] [PRIVATE library ...]); NAME is the folder below src
# with _ for /.
function(enfilade_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;USES;PRIVATE" ${ARGN})
  enfilade_together(sources enfilade_${name} ${PROJECT_SOURCE_DIR}/src ${ROOM_SOURCES})
  add_library(enfilade_${name} STATIC ${sources})
  add_library(enfilade::${name} ALIAS enfilade_${name})
  target_include_directories(enfilade_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<INSTALL_INTERFACE:include/enfilade>)
  target_link_libraries(enfilade_${name} PUBLIC enfilade_options ${ROOM_USES} PRIVATE ${ROOM_PRIVATE})
  set_target_properties(enfilade_${name} PROPERTIES EXPORT_NAME ${name})
  set_property(GLOBAL APPEND PROPERTY ENFILADE_ROOMS enfilade_${name})
endfunction()
