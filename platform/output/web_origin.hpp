#pragma once

#include <string>

namespace touchstone {

/// Whether a web page may listen to touches, by the Origin that its browser gives (empty: no browser). Pages
/// of this machine may, and those of the one origin that is `allowed`, as https://kiosk.example; "*" is every
/// page.
bool may_listen(const std::string& origin, const std::string& allowed);

}  // namespace touchstone
