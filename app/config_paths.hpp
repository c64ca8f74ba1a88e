#pragma once

#include <string>

namespace touchstone {

/// The whole path of one that stands in the configuration file `config_file`: a relative one lies beside that
/// file, or, under systemd, in the service's folder for what it keeps (STATE_DIRECTORY); "~/" is the user's
/// home. Empty stays empty.
std::string path_in_config(const std::string& config_file, const std::string& path);

/// The same for the path in a sensor URI (FILE.oni, seq:DIR).
std::string sensor_uri_in_config(const std::string& config_file, const std::string& uri);

}  // namespace touchstone
