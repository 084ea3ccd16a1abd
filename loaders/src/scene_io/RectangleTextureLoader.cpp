#include "weft/scene_io/RectangleTextureLoader.h"
