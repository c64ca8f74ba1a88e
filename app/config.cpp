#include "app/config.hpp"

#include "platform/system/error.hpp"
#include "ui/scene_names.hpp"

namespace touchstone {

namespace {

/// Collects keys under one section after the other.
class KeyList {
  public:
    void section(std::string name) { section_ = std::move(name); }
    void add(const std::string& name, bool& value, const std::string& meaning) {
        push(name, &value, meaning);
    }
    void add(const std::string& name, std::string& value, const std::string& meaning) {
        push(name, &value, meaning);
    }
    void add_path(const std::string& name, std::string& value, const std::string& meaning) {
        push(name, &value, meaning).text = ConfigKey::Text::path;
    }
    void add_sensor_uri(const std::string& name, std::string& value, const std::string& meaning) {
        push(name, &value, meaning).text = ConfigKey::Text::sensor_uri;
    }
    void add_choice(const std::string& name, std::string& value, std::vector<std::string> choices,
                    const std::string& meaning) {
        push(name, &value, meaning).choices = std::move(choices);
    }
    template <class Number>
    void add(const std::string& name, Number& value, double min, double max, const std::string& meaning) {
        ConfigKey& key = push(name, &value, meaning);
        key.min = min;
        key.max = max;
    }
    std::vector<ConfigKey> take() { return std::move(keys_); }

  private:
    ConfigKey& push(const std::string& name, ConfigKey::Value value, const std::string& meaning) {
        ConfigKey& key = keys_.emplace_back();
        key.section = section_;
        key.name = name;
        key.value = value;
        key.meaning = meaning;
        return key;
    }

    std::string section_;
    std::vector<ConfigKey> keys_;
};

void add_volume_keys(KeyList& keys, Config& config) {
    InteractionConfig& interaction = config.interaction;
    BackgroundConfig& background = interaction.background;
    keys.section("volume");
    keys.add("size_vox", background.volume.size_vox, 64, 1024,
             "voxels along a side of the cube, a multiple of 8");
    keys.add("fit_side", background.fit_side, "side and place from what the first frame sees, 1 to 5 m");
    keys.add("side_m", background.volume.side_m, 0.2, 10, "side of the cube where it is not fitted");
    keys.add("max_depth_m", background.max_volume_depth_m, 0.5, 8,
             "what is farther away does not widen the fitted cube");
    keys.add("max_weight", background.volume.max_weight, 1, 255, "frames that the running average remembers");
    keys.add("max_bricks", background.volume.max_bricks, 64, 1048576, "limit of the pool, 2 KiB each");
    keys.section("scan");
    keys.add("frames", interaction.scan_frames, 1, 1000, "frames until a still scene is live");
    keys.add("wait_frames", interaction.stillness.wait_frames, 0, 100000,
             "at most so long the scan waits for a view in which nothing moves");
    keys.add_path(
        "file", config.scan_file,
        "a start goes on with this scan where it fits the view, else it is written anew; empty: none");
}

void add_object_keys(KeyList& keys, Config& config) {
    ObjectsConfig& objects = config.interaction.background.objects;
    keys.section("objects");
    keys.add("settle_s", objects.settle_s, 0.2, 3600,
             "what is put down and left becomes background after so long");
    keys.add("max_side_m", objects.max_side_m, 0.02, 5, "larger things are people and furniture: never");
    keys.add_path("export_dir", objects.export_dir,
                  "folder for meshes and scans of what is lifted out of the scanned scene; empty: none");
    keys.add_path("model", config.object_file,
                  "scan of one object (track --scan): it is found in a hand and followed; empty: none");
    keys.add("follow_lifted", config.interaction.follow_lifted,
             "what is lifted out of the scanned scene is followed so, too");
}

void add_foreground_keys(KeyList& keys, Config& config) {
    ForegroundModelConfig& foreground = config.interaction.foreground;
    keys.section("foreground");
    keys.add_choice(
        "reconstruct", foreground.reconstruct, {"on", "off", "auto"},
        "what moves gets a model of its own, else it is shown as measured: on, off, or auto, which is on "
        "with a GPU");
    keys.add("most_volumes", foreground.most_volumes, 1, 8, "things that have one at a time");
    keys.section("rendering");
    keys.add_choice(
        "view", config.interaction.rendering.view, {"shaded", "normals", "camera"},
        "of the table: shaded, normals as colours, or camera: its own picture, with what is virtual and its "
        "shadows in it");
}

void add_sensor_keys(KeyList& keys, Config& config) {
    DepthMapConversionConfig& conversion = config.interaction.conversion;
    keys.section("sensor");
    keys.add_sensor_uri("uri", config.sensor_uri, "sensor URI; empty: the attached camera");
    keys.add("mode", config.sensor_mode,
             "WIDTHxHEIGHT@HERTZ of a device's depth picture, e.g. 320x240@60; empty: its model's");
    keys.add(
        "color", config.sensor_color,
        "its colour picture, too, where it has one: the scan keeps colours, which mirror and inspect show");
    keys.add_path(
        "models", config.sensor_models,
        "file of camera models (platform/camera/sensor_models.toml shows the form) before the built-in ones");
    keys.add("min_depth_m", conversion.min_depth_m, 0.1, 5, "nearer readings are invalid");
    keys.add("max_depth_m", conversion.max_depth_m, 0.5, 10, "farther readings are invalid");
    keys.section("noise");
    keys.add("constant_m", config.interaction.noise.constant_m, 0, 0.1,
             "sigma_z = constant + quadratic (z - offset)^2 + ...; the camera model's where all four are "
             "left as they are");
    keys.add("quadratic", config.interaction.noise.quadratic, 0, 0.1, "1/m");
    keys.add("offset_m", config.interaction.noise.offset_m, 0, 5, "");
    keys.add("grazing", config.interaction.noise.grazing, 0, 0.1,
             "grazing / sqrt(z) (theta / (pi/2 - theta))^2");
}

void add_output_keys(KeyList& keys, Config& config) {
    keys.section("areas");
    keys.add_path("file", config.areas_file,
                  "of named areas with scenes and TUIO sources of their own; empty: the table is one");
    keys.section("tuio");
    keys.add("enabled", config.tuio.enabled, "TUIO 1.1 2Dcur over UDP");
    keys.add("host", config.tuio.host, "receiver");
    keys.add("port", config.tuio.port, 1, 65535, "receiver");
    keys.add("hover_port", config.tuio.hover_port, 0, 65535,
             "receiver of 25Dcur, which has hovering fingers as well; 0: none");
    keys.add("hover_height_mm", config.tuio.hover_height_mm, 10, 1000, "over the surface, where z is 1");
    keys.add("source", config.tuio.source, "name of this table; empty: touchstone@host");
    keys.section("websocket");
    keys.add("enabled", config.web_socket_enabled, "TUIO 1.1 2Dcur for web pages");
    keys.add("host", config.web_socket.host,
             "address of this machine where it is served; 0.0.0.0: all of them");
    keys.add("port", config.web_socket.port, 1, 65535, "where it is served");
    keys.add("origin", config.web_socket.origin,
             "of pages that may listen beside those of this machine, as https://kiosk.example; *: all pages");
    keys.section("uinput");
    keys.add("enabled", config.touch_screen_enabled,
             "touches as those of a touch screen of this machine, which is the interactive area");
    keys.add("slots", config.touch_screen.slots, 1, 32, "touches at one time; more are left out");
    keys.add("width_mm", config.touch_screen.width_mm, 0, 10000, "of the interactive area; 0: not known");
    keys.add("height_mm", config.touch_screen.height_mm, 0, 10000, "of the interactive area; 0: not known");
}

}  // namespace

DeviceConfig device_config(const Config& config) {
    DeviceConfig device = config.compute;
    device.cache_dir = default_cache_dir();
    return device;
}

bool wants_color(const Config& config) {
    return config.sensor_color || shows_camera(config.interaction.rendering);
}

CameraSetup camera_setup(const Config& config) {
    if (config.sensor_mode.empty()) return {std::nullopt, config.sensor_models};
    const std::optional<DepthMode> mode = parse_depth_mode(config.sensor_mode);
    if (!mode) {
        throw Error(ExitStatus::configuration,
                    "sensor.mode \"" + config.sensor_mode + "\" is no WIDTHxHEIGHT@HERTZ, e.g. 640x480@30");
    }
    return {mode, config.sensor_models};
}

InteractionConfig interaction_config(const Config& config, const SensorModel* model) {
    InteractionConfig result = config.interaction;
    const SensorNoise &set = config.interaction.noise, untouched = InteractionConfig{}.noise;
    const bool is_set = set.constant_m != untouched.constant_m || set.quadratic != untouched.quadratic ||
                        set.offset_m != untouched.offset_m || set.grazing != untouched.grazing;
    if (model != nullptr && !is_set) result.noise = model->noise;
    return result;
}

LogLevel log_level(const Config& config) {
    const std::optional<LogLevel> level = parse_log_level(config.log_level);
    if (!level) throw Error(ExitStatus::configuration, "log.level is debug, info, warning or error");
    return *level;
}

std::vector<ConfigKey> config_keys(Config& config) {
    KeyList keys;
    add_sensor_keys(keys, config);
    keys.section("compute");
    keys.add("device", config.compute.choice, "auto, gpu, cpu, or a part of the OpenCL device's name");
    add_volume_keys(keys, config);
    add_object_keys(keys, config);
    add_foreground_keys(keys, config);
    keys.section("touch");
    keys.add("hidden_s", config.interaction.touch.tracking.hidden_s, 0, 2,
             "a touch that something covers is kept for so long");
    keys.add_path(
        "bias_file", config.bias_file,
        "what the touched crosses told; where it is not there yet, the table asks to touch them; empty: "
        "neither");
    add_output_keys(keys, config);
    keys.section("display");
    keys.add("width_px", config.display.width_px, 160, 7680, "of a window or a picture without a screen");
    keys.add("height_px", config.display.height_px, 120, 4320, "");
    keys.add_choice("scene", config.display.scene, {all_scene_names.begin(), all_scene_names.end()},
                    "what the table shows");
    keys.add("output", config.display.output,
             "screen of --display projector, by its name or part of it (touchstone check lists them); empty: "
             "the last that is not the primary one");
    keys.add("mode", config.display.mode, "WIDTHxHEIGHT@HERTZ of that screen; empty: its own");
    keys.add("menu", config.display.menu, "scenes are changed by touch");
    keys.add("attract_after_s", config.display.attract_after_s, 0, 86400,
             "without touch or hover, until the table asks to be touched; 0: never");
    keys.add_path("painting_file", config.display.painting_file, "keeps what is painted; empty: it is lost");
    keys.add_path("model", config.display.model,
                  "OBJ, glTF or PLY that stands in the scene mirror; empty: a vase");
    keys.add_path("photos", config.display.photos, "folder of PNG and JPEG for the scene photos");
    keys.section("projector");
    keys.add_path("file", config.projector.file,
                  "of touchstone calibrate: where the picture lies; empty: unknown");
    keys.add("moves_with_camera", config.projector.moves_with_camera,
             "both hang on one mount: a knock moves both");
    keys.add("spares_hands", config.projector.spares_hands, "nothing is drawn on hands");
    keys.add(
        "check_mm", config.projector.check_mm, 0, 1000,
        "at the start the colour camera looks where light falls, and says if it is farther off; 0: it does "
        "not look");
    keys.section("particles");
    ParticleTableConfig& particles = config.particles;
    keys.add("most", particles.simulation.capacity, 1, 131072, "more push out the oldest");
    keys.add("radius_m", particles.simulation.radius_m, 0.002, 0.03, "of each");
    keys.add("pour_per_s", particles.pour_per_s, 0, 10000, "from each finger in contact");
    keys.section("health");
    keys.add("port", config.health.port, 0, 65535,
             "figures of the running table at http://127.0.0.1:PORT/metrics, for Prometheus; 0: none");
    keys.add_path("fault_dir", config.fault_reports.dir,
                  "folder for what the camera gave in the 10 s before it failed, to replay; empty: none");
    keys.add("fault_reports", config.fault_reports.most, 1, 1000, "older ones are deleted");
    keys.section("log");
    keys.add_choice("level", config.log_level, {"debug", "info", "warning", "error"},
                    "debug, info, warning or error");
    return keys.take();
}

}  // namespace touchstone
