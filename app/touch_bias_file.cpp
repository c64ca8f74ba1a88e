#include "app/touch_bias_file.hpp"

#include <cmath>
#include <fmt/core.h>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "platform/system/checked_file.hpp"
#include "platform/system/error.hpp"

namespace touchstone {

namespace {

constexpr FileFormat format{"bias of touches", {'T', 'S', 'B', 'I', 'A', 'S', 0, 0}, 1, 1 << 16};
constexpr double most_mm = 20.0;

double length_mm(const nlohmann::json& file, const char* key) {
    const double value = file.at(key).get<double>();
    if (!std::isfinite(value) || std::abs(value) > most_mm)
        throw Error(ExitStatus::bad_data, fmt::format("{} must be within {} mm", key, most_mm));
    return value;
}

/// The first versions wrote the JSON by itself.
std::string content_of(const std::filesystem::path& path) {
    std::ifstream file(path);
    if (file.peek() != '{') return read_checked_file(path, format);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

void save_touch_bias(const std::filesystem::path& path, const TouchBiasFit& fit) {
    const auto to_mm = [](float length_m) { return std::round(1e6 * static_cast<double>(length_m)) / 1e3; };
    const nlohmann::json file{{"along_mm", to_mm(fit.bias.along_m)},
                              {"across_mm", to_mm(fit.bias.across_m)},
                              {"sigma_mm", to_mm(fit.sigma_m)},
                              {"rms_mm", to_mm(fit.rms_m)}};
    write_checked_file(path, format, file.dump());
}

TouchBias load_touch_bias(const std::filesystem::path& path) {
    const std::string text = content_of(path);
    try {
        const nlohmann::json content = nlohmann::json::parse(text);
        return {static_cast<float>(0.001 * length_mm(content, "along_mm")),
                static_cast<float>(0.001 * length_mm(content, "across_mm"))};
    } catch (const nlohmann::json::exception&) {
        throw Error(ExitStatus::bad_data, fmt::format("{} does not hold a bias of touches", path.string()));
    } catch (const Error& error) {
        throw Error(ExitStatus::bad_data, fmt::format("{}: {}", path.string(), error.what()));
    }
}

}  // namespace touchstone
