#pragma once

#include "app/command_line.hpp"
#include "platform/system/error.hpp"

namespace touchstone {

/// `touchstone record`: writes what the camera gives to an .oni file, until the wanted frames, the source or
/// a signal asks to end. Throws Error; frames that came before a failure of the camera are kept, and without
/// one frame there is no file.
ExitStatus record_command(const RecordOptions& options);

}  // namespace touchstone
