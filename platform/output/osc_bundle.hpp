#pragma once

#include <memory>
#include <string>

namespace touchstone {

struct OscBundleDeleter {
    void operator()(void* bundle) const;
};
/// liblo's lo_bundle with all that is in it.
using OscBundle = std::unique_ptr<void, OscBundleDeleter>;

/// The bundle as it is sent.
std::string osc_bytes(const OscBundle& bundle);

/// A way on which bundles go out. One that gets lost is no error: what is said is said again.
class OscChannel {
  public:
    virtual ~OscChannel() = default;
    /// Bytes of the largest bundle that it takes.
    virtual std::size_t largest_bundle() const = 0;
    /// Never waits for whoever listens.
    virtual void send(const OscBundle& bundle) = 0;
};

}  // namespace touchstone
