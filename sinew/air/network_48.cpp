// AirNetwork for at most 48 muscles.
#include "sinew/air/network.h"

namespace sinew::air {

template class ValveBank<48>;
template class BodiesOfAir<48>;
template class QuickBodies<48>;
template class AirNetwork<48>;

}  // namespace sinew::air
