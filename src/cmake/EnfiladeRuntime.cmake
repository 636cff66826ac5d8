# The two runtimes: mpi (Open MPI, the real machine) and smpi (SimGrid's SMPI, a simulated one).

# enfilade_runtime_room(NAME): the room's interface target, which links <NAME>_mpi or <NAME>_smpi according to
# the ENFILADE_RUNTIME property of the executable at the end of the line (mpi unless told).
function(enfilade_runtime_room name)
  add_library(enfilade_${name} INTERFACE)
  add_library(enfilade::${name} ALIAS enfilade_${name})
  if(ENFILADE_SMPI)
    target_link_libraries(enfilade_${name} INTERFACE
      $<IF:$<STREQUAL:$<TARGET_PROPERTY:ENFILADE_RUNTIME>,smpi>,$<TARGET_NAME:enfilade_${name}_smpi>,$<TARGET_NAME:enfilade_${name}_mpi>>)
  else()
    target_link_libraries(enfilade_${name} INTERFACE enfilade_${name}_mpi)
  endif()
  set_target_properties(enfilade_${name} PROPERTIES EXPORT_NAME ${name})
  set_property(GLOBAL APPEND PROPERTY ENFILADE_ROOMS enfilade_${name})
endfunction()

# enfilade_executable(NAME RUNTIME mpi|smpi SOURCES main.cpp ... USES enfilade::app ...)
# What smpirun runs is a shared object with a main(); that is all the difference.
function(enfilade_executable name)
  cmake_parse_arguments(E "" "RUNTIME" "SOURCES;USES" ${ARGN})
  add_executable(${name} ${E_SOURCES})
  target_link_libraries(${name} PRIVATE ${E_USES})
  set_target_properties(${name} PROPERTIES ENFILADE_RUNTIME ${E_RUNTIME})
  if(E_RUNTIME STREQUAL smpi)
    target_compile_options(${name} PRIVATE -fPIC)
    target_link_options(${name} PRIVATE -shared -Wl,-z,defs)
  endif()
endfunction()
