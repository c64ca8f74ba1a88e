#pragma once

#include <vector>

#include "platform/display/picture.hpp"

namespace touchstone {

/// Landscapes to look at where there are no pictures yet: hills at dusk, a lake by moonlight, an aurora, the
/// sea.
std::vector<Picture> sample_pictures();

}  // namespace touchstone
