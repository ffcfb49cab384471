// report/figures/channel_figures.h - figures of channels that somebody chose, in place of the
// page's panels.
#pragma once

#include <vector>

#include "sinew/report/figures/run_maker.h"

namespace sinew::report {

// A figure for each choice, a plot for each of its parts, or several where a part has channels of
// several units. Beside a channel stands what it was to be, where the run has that. `panels` know
// what the channels are called and what they are measured in; a channel that no panel has is called
// as its topic. A choice that the run has nothing of leaves its plot out.
std::vector<Figure> channel_figures(Maker& make, const Channels& channels,
                                    const std::vector<Panel>& panels,
                                    const std::vector<ChosenFigure>& chosen);

}  // namespace sinew::report
