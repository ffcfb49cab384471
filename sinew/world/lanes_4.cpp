// world/lanes_4.cpp - four lanes, compiled for processors with AVX2 (cmake/lanes.cmake).
#include "sinew/world/lane_nodes.h"

namespace sinew::plant {

template class LaneNodes<2, 4>;

}  // namespace sinew::plant
