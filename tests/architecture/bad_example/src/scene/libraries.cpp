#include <embree3/rtcore.h>
#include <mpi.h>
#include <simgrid/s4u.hpp>

#include "surface.hpp"
#ifdef ENFILADE_SMPI
#endif
