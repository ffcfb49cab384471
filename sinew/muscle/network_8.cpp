// AirNetwork for at most 8 muscles.
#include "sinew/muscle/network_faults.h"
#include "sinew/muscle/network_flows.h"
#include "sinew/muscle/network_quick.h"
#include "sinew/muscle/network_setup.h"
#include "sinew/muscle/network_steps.h"
#include "sinew/muscle/network_valves.h"

namespace sinew::muscle {

template class AirNetwork<8>;

}  // namespace sinew::muscle
