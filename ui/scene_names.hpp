#pragma once

#include <array>
#include <string_view>

namespace touchstone {

/// Of every scene, in the order of the menu; scene_list.hpp makes them.
inline constexpr std::array<std::string_view, 6> all_scene_names{"paint",  "particles", "mirror",
                                                                 "photos", "inspect",   "attract"};

}  // namespace touchstone
