#include "app/scan_command.hpp"

namespace touchstone {

ExitStatus scan_command(const ScanOptions& options) {
    throw Error(ExitStatus::unavailable,
                options.scan_file + " is not written: scan is not in this version; take a newer one");
}

}  // namespace touchstone
