#include "ui/painting_file.hpp"

#include <cmath>

#include "platform/system/byte_stream.hpp"
#include "platform/system/checked_file.hpp"
#include "platform/system/error.hpp"

namespace touchstone {

namespace {

constexpr FileFormat format{"painting", {'T', 'S', 'P', 'A', 'I', 'N', 'T', '\n'}, 1, 16U << 20};
constexpr float rigid_tolerance = 1e-3f;

RigidTransform get_pose(ByteReader& reader) {
    RigidTransform T = RigidTransform::Identity();
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column) T(row, column) = reader.get<float>();
    const Eigen::Matrix3f RtR = T.linear().transpose() * T.linear();
    if (!T.matrix().allFinite() || !RtR.isIdentity(rigid_tolerance))
        throw Error(ExitStatus::bad_data, "its camera pose is damaged");
    return T;
}

}  // namespace

void save_painting(const std::filesystem::path& path, const Painting& painting, const RigidTransform& T_g_c) {
    ByteWriter writer;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column) writer.put(T_g_c(row, column));
    write_checked_file(path, format, writer.take() + painting.bytes());
}

std::optional<StoredPainting> load_painting(const std::filesystem::path& path) {
    std::error_code none;
    if (!std::filesystem::exists(path, none)) return std::nullopt;
    const std::string content = read_checked_file(path, format);
    try {
        ByteReader reader(content);
        StoredPainting stored;
        stored.T_g_c = get_pose(reader);
        stored.painting =
            Painting::from_bytes(std::string_view(content).substr(content.size() - reader.remaining()));
        return stored;
    } catch (const Error& error) {
        throw Error(ExitStatus::bad_data, "the painting " + path.string() + " is damaged: " + error.what());
    }
}

}  // namespace touchstone
