#include "scene/scene.hpp"

struct Surface {
  int band;
};
