#include "tests/reference/listing_1.hpp"

#include <gtest/gtest.h>
#include <random>

#include "pipeline/data_association.hpp"
#include "tests/support/analytic_scene.hpp"
#include "tests/support/map_access.hpp"

namespace touchstone {
namespace {

using reference::OrientedPicture;

/// Random depths about 1 m (or as scaled) with holes, and random normals with holes.
OrientedPicture random_picture(const Intrinsics& k, unsigned seed, float scale) {
    std::mt19937 random(seed);
    std::normal_distribution<float> depth_m(1.0f, 0.006f), component(0.0f, 0.25f);
    OrientedPicture picture{k.width_px, k.height_px, {}, {}};
    for (int i = 0; i < k.width_px * k.height_px; ++i) {
        picture.depth_m.push_back(random() % 5 == 0 ? 0.0f : scale * depth_m(random));
        const Eigen::Vector3f n(component(random), component(random), -1.0f);
        picture.normals.push_back(random() % 7 == 0 ? Eigen::Vector3f::Zero() : n.normalized());
    }
    return picture;
}

std::vector<float> normal_planes(const MapShape& shape, const OrientedPicture& picture) {
    std::vector<float> planes(3 * map_pixels(shape), 0.0f);
    for (int y = 0; y < picture.height_px; ++y) {
        for (int x = 0; x < picture.width_px; ++x) {
            for (int plane = 0; plane < 3; ++plane) {
                planes[static_cast<std::size_t>(plane) * map_pixels(shape) + map_index(shape, x, y)] =
                    picture.normals[static_cast<std::size_t>(y * picture.width_px + x)](plane);
            }
        }
    }
    return planes;
}

/// Codes of the kernel, without padding.
std::vector<std::uint8_t> associate(const Intrinsics& k, const DataAssociationConfig& config,
                                    const OrientedPicture& live, const OrientedPicture& model,
                                    const std::vector<float>& fallback_m, const Eigen::Isometry3f& T_p_c) {
    const Device device(DeviceConfig{});
    const MapShape shape = make_map_shape(k);
    LiveMaps live_maps(device, shape);
    SurfacePrediction prediction(device, shape);
    live_maps.filtered_m.write(test::padded<float>(shape, live.depth_m));
    live_maps.normals_c.write(normal_planes(shape, live));
    prediction.depth_m.write(test::padded<float>(shape, model.depth_m));
    prediction.normals_c.write(normal_planes(shape, model));
    const Buffer<float> fallback(device, test::padded<float>(shape, fallback_m));
    Buffer<std::uint8_t> codes(device, map_pixels(shape));
    DataAssociation association(device, config, k);
    association.associate(live_maps, prediction, fallback, T_p_c, codes);
    const std::vector<std::uint8_t> map = codes.read();
    for (int y = 0; y < shape.rows_px; ++y) {
        for (int x = 0; x < shape.pitch_px; ++x) {
            if (x < k.width_px && y < k.height_px) continue;
            EXPECT_EQ(map[map_index(shape, x, y)], ASSOCIATION_NO_LIVE_DEPTH) << x << " " << y;
        }
    }
    return test::cropped(shape, map);
}

/// At most 1 pixel in 2000 may differ: those whose disparity or projection lies on a threshold.
void expect_agreement(const Intrinsics& k, const DataAssociationConfig& config,
                      const Eigen::Isometry3f& T_p_c, float scale) {
    const OrientedPicture live = random_picture(k, 1, scale), model = random_picture(k, 2, scale);
    std::vector<float> fallback_m = random_picture(k, 3, scale).depth_m;
    for (std::size_t i = 0; i < fallback_m.size(); i += 2) fallback_m[i] = 0.0f;
    const std::vector<std::uint8_t> found = associate(k, config, live, model, fallback_m, T_p_c);
    const std::vector<RejectionCode> expected =
        reference::associate(live, model, fallback_m, k, T_p_c, make_association_params(config));
    std::size_t different = 0;
    std::array<int, 7> seen{};
    for (std::size_t i = 0; i < found.size(); ++i) {
        different += found[i] != expected[i];
        ++seen[found[i]];
    }
    EXPECT_LE(different, found.size() / 2000 + 1);
    for (const RejectionCode code : {ASSOCIATION_INLIER, ASSOCIATION_NO_LIVE_DEPTH, ASSOCIATION_NO_MODEL,
                                     ASSOCIATION_IN_FRONT, ASSOCIATION_SLIGHTLY_IN_FRONT, ASSOCIATION_BEHIND})
        EXPECT_GT(seen[static_cast<std::size_t>(code)], 0) << code;
    EXPECT_EQ(seen[ASSOCIATION_NORMAL_DIFFERS] > 0, config.max_normal_angle_deg < 180.0f);
}

TEST(Listing1, AgreesWithTheReferenceInPlace) {
    DataAssociationConfig config;
    expect_agreement(test::small_camera(96, 80), config, Eigen::Isometry3f::Identity(), 1.0f);
    config.max_normal_angle_deg = 20.0f;
    expect_agreement(test::small_camera(101, 67), config, Eigen::Isometry3f::Identity(), 1.0f);
}

TEST(Listing1, AgreesWithTheReferenceUnderMotion) {
    DataAssociationConfig config;
    config.max_normal_angle_deg = 20.0f;
    Eigen::Isometry3f T_p_c = Eigen::Isometry3f::Identity();
    T_p_c.translate(Eigen::Vector3f(0.13f, -0.05f, 0.004f));
    T_p_c.rotate(Eigen::AngleAxisf(0.05f, Eigen::Vector3f(0.2f, 0.5f, 1.0f).normalized()));
    expect_agreement(test::small_camera(96, 80), config, T_p_c, 1.0f);
    expect_agreement(test::small_camera(75, 37), config, T_p_c, 0.7f);
}

/// A step of five disparity units is surely in front at 0.5 m, 1 m and 4 m, though it is 4 mm in the first
/// case and 230 mm in the last; half a unit never is.
TEST(Listing1, TheThresholdFollowsTheSensorFromNearToFar) {
    const Intrinsics k = test::small_camera(32, 16);
    const auto pixels = static_cast<std::size_t>(k.width_px * k.height_px);
    const std::vector<Eigen::Vector3f> facing(pixels, -Eigen::Vector3f::UnitZ());
    for (const float z : {0.8f, 1.0f, 2.0f, 4.0f}) {
        const OrientedPicture model{k.width_px, k.height_px, std::vector<float>(pixels, z), facing};
        for (const auto& [units, code] : {std::pair{5.0f, ASSOCIATION_IN_FRONT},
                                          {0.5f, ASSOCIATION_INLIER},
                                          {-5.0f, ASSOCIATION_BEHIND}}) {
            const float live_m = 1.0f / (1.0f / z + units * 0.0029f);
            const OrientedPicture live{k.width_px, k.height_px, std::vector<float>(pixels, live_m), facing};
            const std::vector<std::uint8_t> codes = associate(
                k, {}, live, model, std::vector<float>(pixels, 0.0f), Eigen::Isometry3f::Identity());
            EXPECT_EQ(std::count(codes.begin(), codes.end(), code), static_cast<long>(pixels))
                << z << " m " << units;
        }
    }
}

}  // namespace
}  // namespace touchstone
