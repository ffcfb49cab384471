// AirNetwork for at most 48 muscles.
#include "sinew/air/network_faults.h"
#include "sinew/air/network_flows.h"
#include "sinew/air/network_quick.h"
#include "sinew/air/network_setup.h"
#include "sinew/air/network_steps.h"
#include "sinew/air/network_valves.h"

namespace sinew::air {

template class AirNetwork<48>;

}  // namespace sinew::air
