// world/lanes_2.cpp - two lanes, which every processor has.
#include "sinew/world/lane_nodes.h"

namespace sinew::plant {

template class LaneNodes<2, 2>;

}  // namespace sinew::plant
