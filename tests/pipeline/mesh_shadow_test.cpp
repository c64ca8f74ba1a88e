// A square that the lamp sees 0.15 m before it, in the scene of lit_scene.hpp: its shadow falls where
// geometry says.
#include <gtest/gtest.h>

#include "pipeline/view_rendering.hpp"
#include "tests/support/lit_scene.hpp"
#include "tests/support/map_access.hpp"

namespace touchstone {
namespace {

constexpr float square_m = 0.15f;

class MeshShadowTest : public testing::Test {
  protected:
    /// Pixels 30 to 69 of 100 each way.
    MeshShadowTest() {
        std::vector<float> seen_m(100 * 100, 0.0f);
        for (int y = 30; y < 70; ++y)
            for (int x = 30; x < 70; ++x) seen_m[static_cast<std::size_t>(100 * y + x)] = square_m;
        lamp_m.write(test::padded<float>(make_map_shape(lamp_k), seen_m));
    }
    ShadedView render(const MeshShadow* of_mesh) {
        ViewScene scene{.light_g_m = T_g_l.translation()};
        scene.mesh_shadow = of_mesh;
        return rendering.render(volume, T_g_c, scene);
    }

    std::optional<test::SceneHit> hit(int x, int y) const {
        return test::hit_scene(T_g_c.translation(), T_g_c.linear() * test::pixel_ray(k, x, y));
    }
    /// Of a surface away from its edges and from the outlines of what is before it.
    std::optional<test::SceneHit> inner_hit(int x, int y) const {
        const auto seen = hit(x, y);
        if (!seen || seen->to_edge_m < 0.03f) return std::nullopt;
        for (const auto& [dx, dy] : {std::pair(-2, 0), std::pair(2, 0), std::pair(0, -2), std::pair(0, 2)}) {
            const auto beside = hit(x + dx, y + dy);
            if (!beside || beside->color != seen->color) return std::nullopt;
        }
        return seen;
    }

    Device device{DeviceConfig{}};
    Intrinsics k = test::small_camera(150, 111);
    Intrinsics lamp_k{90.0f, 90.0f, 49.5f, 49.5f, 100, 100, {0, 0}};
    TsdfVolume volume = restore_volume(device, test::lit_scene_snapshot());
    RigidTransform T_g_c = test::looking_at({0.45f, 0.05f, -0.25f}, {0.32f, 0.42f, 0.40f});
    RigidTransform T_g_l = test::looking_at({0.30f, 0.05f, 0.10f}, {0.30f, 0.50f, 0.25f});
    ViewLook look;
    ViewRendering rendering{device, look, k};
    Buffer<float> lamp_m{device, map_pixels(make_map_shape(lamp_k))};
    const MeshShadow shadow{lamp_m, lamp_k, T_g_l.inverse()};
};

/// In it, the ambient share of the colour is left, to two of 255; outside it, nothing changes; the edge,
/// which is a pixel of the lamp's picture wide, is left out with half a pixel to spare.
TEST_F(MeshShadowTest, FallsWhereGeometrySays) {
    const ShadedView without = render(nullptr), with = render(&shadow);
    int dark = 0, lit = 0;
    for (int y = 0; y < k.height_px; ++y) {
        for (int x = 0; x < k.width_px; ++x) {
            const auto seen = inner_hit(x, y);
            if (!seen) continue;
            const Eigen::Vector3f p = T_g_l.inverse() * seen->point;
            const Eigen::Vector2f at(90.0f * p.x() / p.z() + 49.5f, 90.0f * p.y() / p.z() + 49.5f);
            const float inside = std::min((at.array() - 29.5f).minCoeff(), (69.5f - at.array()).minCoeff());
            if (p.z() < square_m + 0.02f || std::abs(inside) < 1.5f) continue;
            const auto byte = static_cast<std::size_t>(4 * (y * k.width_px + x));
            for (std::size_t c = 0; c < 3; ++c) {
                if (inside > 0.0f)
                    ASSERT_NEAR(with.rgba[byte + c],
                                255.0f * look.ambient * seen->color[static_cast<Eigen::Index>(c)], 2.0f)
                        << x << ", " << y;
                else
                    ASSERT_EQ(with.rgba[byte + c], without.rgba[byte + c]) << x << ", " << y;
            }
            (inside > 0.0f ? dark : lit) += 1;
        }
    }
    EXPECT_GT(dark, 300);
    EXPECT_GT(lit, 300);
}

/// What is nearer to the lamp than the square is before it.
TEST_F(MeshShadowTest, DarkensNothingBeforeTheMesh) {
    std::vector<float> far_m(100 * 100, 3.0f);
    lamp_m.write(test::padded<float>(make_map_shape(lamp_k), far_m));
    EXPECT_EQ(render(&shadow).rgba, render(nullptr).rgba);
}

}  // namespace
}  // namespace touchstone
