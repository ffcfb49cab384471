# Folders for a braided muscle with its air and valves, and sinew::muscle, which links all of them. They need
# only a compiler, no external library.
#
#   cmake -DSINEW_ONLY=muscle -S . -B build/muscle     configures only these

#            folder          may include (tools/layers.sh checks the includes themselves)
sinew_folder(units           )
sinew_folder(signals         )
sinew_folder(gas             units)
sinew_folder(actuator        units)
sinew_folder(air/stiff       gas)
sinew_folder(air             air/stiff gas actuator signals)
sinew_folder(mechanism/driven air signals)
sinew_folder(world/kernel    air signals)
sinew_folder(world/driven    world/kernel mechanism/driven)

# sinew/muscle.h includes what its users need.
add_library(sinew_muscle INTERFACE)
add_library(sinew::muscle ALIAS sinew_muscle)
target_link_libraries(sinew_muscle INTERFACE sinew_world_driven)
set_property(GLOBAL APPEND PROPERTY SINEW_FOLDERS sinew_muscle)
