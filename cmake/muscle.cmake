# The folders of which a braided muscle with its air and valves is made, and sinew::muscle, which is
# all of them. They need a compiler and nothing else: no library from outside.
#
#   cmake -DSINEW_ONLY=muscle -S . -B build/muscle     builds and installs these alone

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
