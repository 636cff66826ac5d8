#include "scene/surface.hpp"
