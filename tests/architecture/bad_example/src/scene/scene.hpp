#include "scene/surface.hpp"

struct Surface {};
