#pragma once

#include <string>
#include <variant>
#include <vector>

#include "app/fault_reports.hpp"
#include "app/health.hpp"
#include "pipeline/interaction_pipeline.hpp"
#include "pipeline/particle_table.hpp"
#include "platform/camera/depth_camera.hpp"
#include "platform/opencl/device.hpp"
#include "platform/output/touch_screen_events.hpp"
#include "platform/output/web_socket_channel.hpp"
#include "platform/system/log.hpp"

namespace touchstone {

struct DisplayConfig {
    int width_px = 1280;
    int height_px = 720;
    std::string output;  ///< of the projector, as find_output; empty: the last one
    std::string mode;    ///< of the projector, as choose_mode; empty: its own
    std::string scene = "paint";
    bool menu = true;
    float attract_after_s = 60.0f;  ///< 0: never
    std::string painting_file;      ///< empty: the painting is not kept
    std::string model;              ///< mesh file of the scene mirror; empty: a vase of the program's own
    std::string photos;             ///< folder; empty: pictures of the program's own
};

/// The picture is drawn through its model where there is one.
struct ProjectorMappingConfig {
    std::string file;                ///< of `touchstone calibrate`; empty: none
    bool moves_with_camera = false;  ///< both hang on one mount: a knock moves both
    bool spares_hands = true;        ///< nothing is drawn on what moves over the table
    float check_mm = 5.0f;           ///< light that falls farther off is told of at the start; 0: no check
};

struct TuioConfig {
    bool enabled = true;
    std::string host = "127.0.0.1";
    int port = 3333;
    int hover_port = 0;             ///< 0: hovers are not sent
    float hover_height_mm = 150.f;  ///< over the surface, where z is 1
    std::string source;
};

/// Everything that can be configured; each member's default is the program's.
struct Config {
    std::string sensor_uri;
    std::string sensor_named_in;  ///< FILE:LINE of a configuration file that sensor_uri is from; empty: from
                                  ///< elsewhere
    std::string sensor_mode;      ///< of its depth picture, as parse_depth_mode reads it; empty: the model's
    bool sensor_color = false;    ///< its colours, too, where it has some: the scan keeps them
    std::string sensor_models;    ///< file of camera models before the built-in ones; empty: none
    DeviceConfig compute;
    InteractionConfig interaction;
    std::string scan_file;    ///< empty: the surroundings are scanned at every start
    std::string object_file;  ///< scan of an object that is followed in hands; empty: none
    std::string areas_file;   ///< named parts of the table; empty: it is one
    std::string bias_file;    ///< of touches; empty: none is taken off
    TuioConfig tuio;
    bool web_socket_enabled = false;
    WebSocketConfig web_socket;
    bool touch_screen_enabled = false;
    TouchScreenConfig touch_screen;
    DisplayConfig display;
    ProjectorMappingConfig projector;
    ParticleTableConfig particles;
    HealthConfig health;
    FaultReportsConfig fault_reports;
    std::string log_level = "info";
};

/// The compute device of the configuration, with the kernel cache in its place.
DeviceConfig device_config(const Config& config);

/// Whether a table needs the camera's colour picture.
bool wants_color(const Config& config);

/// What the configuration says of the camera. Throws Error{configuration} for a mode that is none.
CameraSetup camera_setup(const Config& config);

/// The pipeline's configuration for a camera: its model's noise, unless [noise] was changed. `model` may be
/// null.
InteractionConfig interaction_config(const Config& config, const SensorModel* model);

/// Throws Error{configuration} for a word that is no level.
LogLevel log_level(const Config& config);

/// One key of the configuration file: where its value lies, what it may be, what it is for.
struct ConfigKey {
    enum class Text { any, path, sensor_uri };
    using Value = std::variant<bool*, int*, float*, std::string*>;

    std::string section, name;
    Value value;
    double min = 0.0, max = 0.0;  ///< of numbers, both allowed
    std::string meaning;
    Text text = Text::any;             ///< paths are taken as path_in_config() says
    std::vector<std::string> choices;  ///< of texts; empty: any
};

/// Every key, in the order in which `--print-config` shows them. The values point into `config`.
std::vector<ConfigKey> config_keys(Config& config);

/// Takes over a TOML text, relative paths as path_in_config(). Throws Error{configuration} naming `file`, the
/// line and what is allowed.
void parse_config(const std::string& text, const std::string& file, Config& config);

/// Reads a file. Throws Error{no_input} where it is missing, else as parse_config.
void load_config(const std::string& file, Config& config);

/// The whole configuration as TOML that parse_config reads back.
std::string print_config(Config config);

}  // namespace touchstone
