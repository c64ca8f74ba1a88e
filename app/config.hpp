#pragma once

#include <string>
#include <variant>
#include <vector>

#include "app/fault_reports.hpp"
#include "pipeline/interaction_pipeline.hpp"
#include "platform/opencl/device.hpp"
#include "platform/output/tuio_sink.hpp"
#include "platform/system/log.hpp"

namespace touchstone {

struct DisplayConfig {
    int width_px = 1280;
    int height_px = 720;
    std::string scene = "paint";
};

/// Everything that can be configured; each member's default is the program's.
struct Config {
    std::string sensor_uri;
    DeviceConfig compute;
    InteractionConfig interaction;
    std::string scan_file;    ///< empty: the surroundings are scanned at every start
    std::string object_file;  ///< scan of an object that is followed in hands; empty: none
    std::string bias_file;    ///< of touches; empty: none is taken off
    FaultReportsConfig fault_reports;
    bool tuio_enabled = true;
    TuioConfig tuio;
    DisplayConfig display;
    std::string log_level = "info";
};

/// The compute device of the configuration, with the kernel cache in its place.
DeviceConfig device_config(const Config& config);

/// Throws Error{configuration} for a word that is no level.
LogLevel log_level(const Config& config);

/// One key of the configuration file: where its value lies, what it may be, what it is for.
struct ConfigKey {
    using Value = std::variant<bool*, int*, float*, std::string*>;

    std::string section, name;
    Value value;
    double min = 0.0, max = 0.0;  ///< of numbers, both allowed
    std::string meaning;
};

/// Every key, in the order in which `--print-config` shows them. The values point into `config`.
std::vector<ConfigKey> config_keys(Config& config);

/// Takes over a TOML text. Throws Error{configuration} naming `file`, the line and what is allowed.
void parse_config(const std::string& text, const std::string& file, Config& config);

/// Reads a file. Throws Error{no_input} where it is missing, else as parse_config.
void load_config(const std::string& file, Config& config);

/// The whole configuration as TOML that parse_config reads back.
std::string print_config(Config config);

}  // namespace touchstone
