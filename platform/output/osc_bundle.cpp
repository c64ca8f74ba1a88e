#include "platform/output/osc_bundle.hpp"

#include <lo/lo.h>

namespace touchstone {

void OscBundleDeleter::operator()(void* bundle) const { lo_bundle_free_recursive(bundle); }

std::string osc_bytes(const OscBundle& bundle) {
    std::string bytes(lo_bundle_length(bundle.get()), '\0');
    std::size_t size = bytes.size();
    lo_bundle_serialise(bundle.get(), bytes.data(), &size);
    return bytes;
}

}  // namespace touchstone
