// AirNetwork for at most 8 muscles.
#include "sinew/air/network.h"

namespace sinew::air {

template class ValveBank<8>;
template class BodiesOfAir<8>;
template class QuickBodies<8>;
template class AirNetwork<8>;

}  // namespace sinew::air
