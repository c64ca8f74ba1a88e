#include "app/projector_file.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <vector>

#include "platform/system/checked_file.hpp"
#include "platform/system/error.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

constexpr FileFormat format{"calibration of a projector", {'T', 'S', 'P', 'R', 'O', 'J', 0, 0}, 1, 1 << 16};
constexpr int most_px = 16384;

template <class Matrix>
json to_json(const Matrix& matrix) {
    json rows = json::array();
    for (Eigen::Index row = 0; row < matrix.rows(); ++row)
        for (Eigen::Index column = 0; column < matrix.cols(); ++column) rows.push_back(matrix(row, column));
    return rows;
}

template <class Matrix>
Matrix from_json(const json& rows) {
    const auto values = rows.get<std::vector<float>>();
    Matrix matrix;
    if (values.size() != static_cast<std::size_t>(matrix.size()) ||
        !std::ranges::all_of(values, [](float value) { return std::isfinite(value); }))
        throw Error(ExitStatus::bad_data, "a matrix is not whole");
    for (Eigen::Index i = 0; i < matrix.size(); ++i)
        matrix(i / matrix.cols(), i % matrix.cols()) = values[static_cast<std::size_t>(i)];
    return matrix;
}

json model_to_json(const ProjectorModel& model) {
    json file{{"width_px", model.width_px}, {"height_px", model.height_px}};
    if (model.kind == ProjectorModelKind::homography) {
        file["model"] = "homography";
        file["H_px_uv"] = to_json(model.H_px_uv);
        file["origin_c_m"] = to_json(model.plane_g.origin_c_m);
        file["axis_u_c_m"] = to_json(model.plane_g.axis_u_c_m);
        file["axis_v_c_m"] = to_json(model.plane_g.axis_v_c_m);
        return file;
    }
    file["model"] = "pinhole";
    file["focal_px"] = to_json(model.focal_px);
    file["center_px"] = to_json(model.center_px);
    file["distortion"] = model.distortion;
    file["T_p_c"] = to_json(model.T_p_g.matrix());
    return file;
}

ProjectorModel model_from_json(const json& file) {
    ProjectorModel model;
    model.width_px = file.at("width_px").get<int>();
    model.height_px = file.at("height_px").get<int>();
    if (std::min(model.width_px, model.height_px) < 1 || std::max(model.width_px, model.height_px) > most_px)
        throw Error(ExitStatus::bad_data, "its picture has no size");
    if (file.at("model") == "homography") {
        model.kind = ProjectorModelKind::homography;
        model.H_px_uv = from_json<Eigen::Matrix3f>(file.at("H_px_uv"));
        model.plane_g = {from_json<Eigen::Vector3f>(file.at("origin_c_m")),
                         from_json<Eigen::Vector3f>(file.at("axis_u_c_m")),
                         from_json<Eigen::Vector3f>(file.at("axis_v_c_m"))};
        return model;
    }
    model.focal_px = from_json<Eigen::Vector2f>(file.at("focal_px"));
    model.center_px = from_json<Eigen::Vector2f>(file.at("center_px"));
    model.distortion = file.at("distortion").get<std::array<float, 4>>();
    model.T_p_g.matrix() = from_json<Eigen::Matrix4f>(file.at("T_p_c"));
    if (std::abs(model.T_p_g.linear().determinant() - 1.0f) > 0.01f)
        throw Error(ExitStatus::bad_data, "its pose is none");
    return model;
}

}  // namespace

void save_projector(const std::filesystem::path& path, const SavedProjector& projector) {
    json file = model_to_json(projector.model);
    file["method"] = projector.method;
    file["rms_px"] = projector.rms_px;
    file["rms_mm"] = projector.rms_mm;
    file["points"] = projector.points;
    file["written_s"] = projector.written_s;
    write_checked_file(path, format, file.dump());
}

SavedProjector load_projector(const std::filesystem::path& path) {
    const std::string text = read_checked_file(path, format);
    try {
        const json file = json::parse(text);
        return {model_from_json(file),          file.at("method").get<std::string>(),
                file.at("rms_px").get<float>(), file.at("rms_mm").get<float>(),
                file.at("points").get<int>(),   file.value("written_s", std::int64_t{0})};
    } catch (const json::exception&) {
        throw Error(ExitStatus::bad_data,
                    fmt::format("{} does not hold the calibration of a projector", path.string()));
    } catch (const Error& error) {
        throw Error(ExitStatus::bad_data, fmt::format("{}: {}", path.string(), error.what()));
    }
}

std::string day_of(const SavedProjector& projector) {
    if (projector.written_s <= 0) return "a day that its file does not tell";
    return fmt::format("{:%Y-%m-%d}", fmt::localtime(static_cast<std::time_t>(projector.written_s)));
}

}  // namespace touchstone
