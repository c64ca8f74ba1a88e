#include "platform/camera/sensor_models.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <fmt/core.h>
#include <fstream>
#include <sstream>

#include "platform/system/error.hpp"
#include "platform/system/toml_text.hpp"
#include "sensor_model_files.hpp"

namespace touchstone {

namespace {

/// The whole text as a number.
template <class Number>
std::optional<Number> number_in(std::string_view text, int base = 10) {
    Number value{};
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value, base);
    if (code != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

/// "045e:02ae" or "1d27:*".
std::optional<UsbId> parse_usb_id(std::string_view text) {
    const std::size_t colon = text.find(':');
    if (colon == std::string_view::npos) return std::nullopt;
    const auto vendor = number_in<std::uint16_t>(text.substr(0, colon), 16);
    if (!vendor) return std::nullopt;
    if (text.substr(colon + 1) == "*") return UsbId{*vendor, std::nullopt};
    const auto product = number_in<std::uint16_t>(text.substr(colon + 1), 16);
    if (!product) return std::nullopt;
    return UsbId{*vendor, product};
}

/// One [[sensor]], with errors that say where.
class ModelReader {
  public:
    ModelReader(const toml::table& table, const std::string& file) : table_(table), file_(file) {}

    SensorModel read() const {
        refuse_unknown(table_, {"name", "usb", "mode", "noise", "intrinsics", "source"});
        SensorModel model;
        model.name = text(table_, "name");
        model.source = table_["source"].value_or(std::string());
        const auto mode = parse_depth_mode(text(table_, "mode"));
        if (!mode) refuse(table_, "mode is WIDTHxHEIGHT@HERTZ, e.g. 640x480@30");
        model.mode = *mode;
        read_usb(model);
        read_noise(model);
        read_intrinsics(model);
        return model;
    }

  private:
    [[noreturn]] void refuse(const toml::node& at, const std::string& what) const {
        refuse_toml(file_, at.source(), what);
    }
    void refuse_unknown(const toml::table& table, std::initializer_list<std::string_view> known) const {
        for (const auto& [name, node] : table)
            if (std::ranges::find(known, name.str()) == known.end())
                refuse(node, fmt::format("unknown key {}", name.str()));
    }
    std::string text(const toml::table& table, std::string_view name) const {
        const auto value = table[name].value_exact<std::string>();
        if (!value || value->empty()) refuse(table, fmt::format("{} is a text in quotes", name));
        return *value;
    }
    float number(const toml::table& table, std::string_view name, double least, double most) const {
        const toml::node* node = table.get(name);
        const auto value = node != nullptr && node->is_number() ? node->value<double>() : std::nullopt;
        if (!value || !(*value >= least && *value <= most))
            refuse(table, fmt::format("{} is a number from {} to {}", name, least, most));
        return static_cast<float>(*value);
    }
    void read_usb(SensorModel& model) const {
        const toml::array* ids = table_["usb"].as_array();
        if (ids == nullptr || ids->empty()) refuse(table_, "usb is a list of \"VENDOR:PRODUCT\"");
        for (const toml::node& node : *ids) {
            const auto id = parse_usb_id(node.value_or(std::string()));
            if (!id) refuse(node, "usb is a list of \"VENDOR:PRODUCT\", hexadecimal, PRODUCT * for any");
            model.usb.push_back(*id);
        }
    }
    void read_noise(SensorModel& model) const {
        const toml::table* noise = table_["noise"].as_table();
        if (noise == nullptr) refuse(table_, "noise has constant_m, quadratic, offset_m and grazing");
        refuse_unknown(*noise, {"constant_m", "quadratic", "offset_m", "grazing"});
        model.noise = {number(*noise, "constant_m", 1e-5, 0.1), number(*noise, "quadratic", 0.0, 0.1),
                       number(*noise, "offset_m", 0.0, 5.0), number(*noise, "grazing", 0.0, 0.1)};
    }
    void read_intrinsics(SensorModel& model) const {
        if (!table_.contains("intrinsics")) return;
        const toml::array* all = table_["intrinsics"].as_array();
        if (all == nullptr) refuse(table_, "intrinsics is a list");
        for (const toml::node& node : *all) {
            const toml::table* one = node.as_table();
            if (one == nullptr) refuse(node, "intrinsics is a list of tables");
            refuse_unknown(*one, {"width_px", "height_px", "fx_px", "fy_px", "cx_px", "cy_px"});
            Intrinsics k{};
            k.width_px = static_cast<int>(number(*one, "width_px", 16, 10000));
            k.height_px = static_cast<int>(number(*one, "height_px", 16, 10000));
            k.fx_px = number(*one, "fx_px", 1, 100000), k.fy_px = number(*one, "fy_px", 1, 100000);
            k.cx_px = number(*one, "cx_px", 0, 10000), k.cy_px = number(*one, "cy_px", 0, 10000);
            model.intrinsics.push_back(k);
        }
    }

    const toml::table& table_;
    const std::string& file_;
};

}  // namespace

std::optional<DepthMode> parse_depth_mode(std::string_view text) {
    const std::size_t cross = text.find('x'), at = text.find('@');
    if (cross == std::string_view::npos || at == std::string_view::npos || at < cross) return std::nullopt;
    const auto width = number_in<int>(text.substr(0, cross));
    const auto height = number_in<int>(text.substr(cross + 1, at - cross - 1));
    const auto rate = number_in<int>(text.substr(at + 1));
    if (!width || !height || !rate || *width < 16 || *height < 16 || *rate < 1) return std::nullopt;
    return DepthMode{*width, *height, *rate};
}

std::string to_text(const DepthMode& mode) {
    return fmt::format("{}x{}@{}", mode.width_px, mode.height_px, mode.rate_hz);
}

std::vector<SensorModel> parse_sensor_models(const std::string& text, const std::string& file) {
    const toml::table all = parse_toml(text, file);
    const toml::array* sensors = all["sensor"].as_array();
    if (sensors == nullptr || all.size() != 1)
        throw Error(ExitStatus::configuration,
                    fmt::format("{}: holds [[sensor]] tables and nothing else", file));
    std::vector<SensorModel> models;
    for (const toml::node& sensor : *sensors) {
        if (const toml::table* table = sensor.as_table()) models.push_back(ModelReader(*table, file).read());
    }
    return models;
}

std::vector<SensorModel> load_sensor_models(const std::string& file) {
    std::vector<SensorModel> models;
    if (!file.empty()) {
        std::ifstream input(file);
        if (!input) throw Error(ExitStatus::no_input, fmt::format("sensor.models: {} cannot be read", file));
        std::ostringstream text;
        text << input.rdbuf();
        models = parse_sensor_models(text.str(), file);
    }
    for (const auto& built_in : sensor_model_files()) {
        const auto known = parse_sensor_models(std::string(built_in.text), std::string(built_in.name));
        models.insert(models.end(), known.begin(), known.end());
    }
    return models;
}

const SensorModel* find_sensor_model(const std::vector<SensorModel>& models, std::uint16_t vendor,
                                     std::uint16_t product) {
    const auto found = std::ranges::find_if(models, [&](const SensorModel& model) {
        return std::ranges::any_of(model.usb, [&](const UsbId& id) {
            return id.vendor == vendor && (!id.product || *id.product == product);
        });
    });
    return found == models.end() ? nullptr : &*found;
}

}  // namespace touchstone
