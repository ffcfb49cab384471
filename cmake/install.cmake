# cmake --install gives find_package(sinew) and one target, sinew::sinew.
