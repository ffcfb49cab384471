// world/lanes_8.cpp - eight lanes, compiled for processors with AVX-512 (cmake/lanes.cmake).
#include "sinew/world/lane_nodes.h"

namespace sinew::plant {

template class LaneNodes<2, 8>;

}  // namespace sinew::plant
