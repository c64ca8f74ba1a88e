#pragma once

namespace touchstone {

/// While it lives, SIGINT and SIGTERM are noted instead of ending the process. Make it before other threads,
/// which inherit the mask. One at a time.
class TerminationSignals {
  public:
    TerminationSignals();
    ~TerminationSignals();
    TerminationSignals(const TerminationSignals&) = delete;
    TerminationSignals& operator=(const TerminationSignals&) = delete;

    /// True from the first of them on.
    bool arrived();

  private:
    int descriptor_ = -1;
    bool arrived_ = false;
};

}  // namespace touchstone
