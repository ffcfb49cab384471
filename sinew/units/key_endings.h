// units/key_endings.h - endings of keys, such as those of a summary, that state the unit of the
// number.
#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace sinew::units {

// Ending and SI unit; the longest first: "_m_per_s" ends with "_s" too.
inline constexpr std::array<std::pair<std::string_view, std::string_view>, 19> key_endings = {{
    {"_Nm_per_rad", "N m/rad"},
    {"_N_s_per_m", "N s/m"},
    {"_rad_per_s", "rad/s"},
    {"_m_per_s", "m/s"},
    {"_kg_per_m", "kg/m"},
    {"_s_per_m", "s/m"},
    {"_J_per_m", "J/m"},
    {"_per_m", "1/m"},
    {"_rad", "rad"},
    {"_Nm", "N m"},
    {"_kg", "kg"},
    {"_count", "count"},
    {"_diff_Pa", "Pa diff"},
    {"_Pa", "Pa abs"},
    {"_Hz", "Hz"},
    {"_N", "N"},
    {"_J", "J"},
    {"_m", "m"},
    {"_s", "s"},
}};

}  // namespace sinew::units
