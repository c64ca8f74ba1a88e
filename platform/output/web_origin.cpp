#include "platform/output/web_origin.hpp"

#include <string_view>

namespace touchstone {
namespace {

/// The host of scheme://host:port; an address of IP 6 with its brackets.
std::string_view host_of(std::string_view origin) {
    const std::size_t scheme = origin.find("://");
    if (scheme == std::string_view::npos) return {};
    const std::string_view rest = origin.substr(scheme + 3);
    const std::size_t brackets = rest.starts_with('[') ? rest.find(']') : 0;
    return rest.substr(0, rest.find(':', brackets));
}

}  // namespace

bool may_listen(const std::string& origin, const std::string& allowed) {
    if (origin.empty() || allowed == "*" || origin == allowed) return true;
    const std::string_view host = host_of(origin);
    return host == "localhost" || host == "127.0.0.1" || host == "[::1]";
}

}  // namespace touchstone
