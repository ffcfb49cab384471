// AirNetwork for at most 4 muscles.
#include "sinew/air/network.h"

namespace sinew::air {

template class ValveBank<4>;
template class BodiesOfAir<4>;
template class QuickBodies<4>;
template class AirNetwork<4>;

}  // namespace sinew::air
