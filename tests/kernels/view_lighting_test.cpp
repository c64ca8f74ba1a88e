#include "tests/reference/view_lighting.hpp"

#include <gtest/gtest.h>

#include "pipeline/view_rendering.hpp"
#include "tests/support/lit_scene.hpp"
#include "tests/support/map_access.hpp"

namespace touchstone {
namespace {

constexpr float voxel_m = 0.01f;

/// Light, shadow and mirror of the scene of lit_scene.hpp against plain geometry.
class ViewLighting : public testing::Test {
  protected:
    void render(const ViewScene& scene) {
        view = rendering.render(volume, T_g_c, scene);
        depth_m = test::cropped(shape, rendering.depth_m().read());
    }
    Eigen::Vector3f color(int x, int y) const {
        const auto at = static_cast<std::size_t>(4 * (y * k.width_px + x));
        return Eigen::Vector3f(view.rgba[at], view.rgba[at + 1], view.rgba[at + 2]) / 255.0f;
    }
    float depth(int x, int y) const { return depth_m[static_cast<std::size_t>(y * k.width_px + x)]; }
    Eigen::Vector3f ray_g(int x, int y) const { return T_g_c.linear() * test::pixel_ray(k, x, y); }
    Eigen::Vector3f eye() const { return T_g_c.translation(); }

    /// What a pixel shows that is two and a half voxels and two pixels away from all edges.
    std::optional<test::SceneHit> inner_hit(int x, int y) const {
        const auto hit = test::hit_scene(eye(), ray_g(x, y));
        if (!hit || hit->to_edge_m < 2.5f * voxel_m) return std::nullopt;
        for (const auto& [dx, dy] : {std::pair(-2, 0), std::pair(2, 0), std::pair(0, -2), std::pair(0, 2)}) {
            const auto beside = test::hit_scene(eye(), ray_g(x + dx, y + dy));
            if (!beside || beside->color != hit->color) return std::nullopt;
        }
        return hit;
    }

    Eigen::Vector3f phong(const test::SceneHit& hit, const Eigen::Vector3f& direction, float share) const {
        const reference::PhongShares shares{look.ambient, look.diffuse, look.specular};
        return reference::phong(shares, hit.color, hit.normal, (light_g_m - hit.point).normalized(),
                                direction.normalized(), share);
    }
    /// 1 where the light arrives, 0 in the box's shadow, nothing within a voxel of its edge and where the
    /// light falls in too aslant.
    std::optional<float> share(const test::SceneHit& hit) const {
        const Eigen::Vector3f to_light = light_g_m - hit.point;
        const float cosine = hit.normal.dot(to_light.normalized());
        if (cosine <= 0.0f) return 0.0f;
        if (cosine < std::cos(1.3963f)) return std::nullopt;  // 80 degrees
        const Eigen::Vector3f from = hit.point + 0.001f * hit.normal;
        if (hit.normal.y() != -1.0f && hit.color == test::colors_of_parts[2] / 255.0f) return 1.0f;
        const bool surely_dark = test::box_between(from, light_g_m, -voxel_m);
        if (!surely_dark && test::box_between(from, light_g_m, voxel_m)) return std::nullopt;
        return surely_dark ? 0.0f : 1.0f;
    }

    Device device{DeviceConfig{}};
    Intrinsics k = test::small_camera(200, 150);
    MapShape shape = make_map_shape(k);
    ViewLook look;
    TsdfVolume volume = restore_volume(device, test::without_free_bricks(test::lit_scene_snapshot()));
    RigidTransform T_g_c = test::looking_at({0.45f, 0.05f, -0.25f}, {0.32f, 0.42f, 0.40f});
    Eigen::Vector3f light_g_m{0.08f, 0.10f, 0.10f};
    ViewRendering rendering{device, look, k};
    ShadedView view;
    std::vector<float> depth_m;
};

TEST_F(ViewLighting, ColoursAreThoseOfPhong) {
    render({light_g_m, std::nullopt, nullptr});
    int compared = 0, off = 0;
    for (int y = 0; y < k.height_px; ++y) {
        for (int x = 0; x < k.width_px; ++x) {
            const auto hit = inner_hit(x, y);
            if (!hit) continue;
            const auto arrives = share(*hit);
            if (!arrives) continue;
            ++compared;
            const Eigen::Vector3f expected = phong(*hit, ray_g(x, y), *arrives);
            off += (color(x, y) - expected).cwiseAbs().maxCoeff() > 2.5f / 255.0f;
        }
    }
    EXPECT_GT(compared, 8000);
    // The corners of boxes are round by a voxel, which shadows of their far ends show.
    EXPECT_LE(off, compared / 500) << "more than two of 255 levels off";
}

TEST_F(ViewLighting, ShadowsOfTheBoxEndWhereGeometrySays) {
    render({light_g_m, std::nullopt, nullptr});
    int lit = 0, dark = 0, wrong = 0;
    for (int y = 0; y < k.height_px; ++y) {
        for (int x = 0; x < k.width_px; ++x) {
            const auto hit = inner_hit(x, y);
            if (!hit || hit->color.z() > 0.5f) continue;
            const auto arrives = share(*hit);
            if (!arrives) continue;
            const float of_dark = phong(*hit, ray_g(x, y), 0.0f).norm();
            const float of_lit = phong(*hit, ray_g(x, y), 1.0f).norm();
            const bool is_lit = color(x, y).norm() > 0.5f * (of_dark + of_lit);
            (*arrives > 0.5f ? lit : dark) += 1;
            wrong += is_lit != (*arrives > 0.5f);
        }
    }
    EXPECT_GT(lit, 5000);
    EXPECT_GT(dark, 800);
    EXPECT_EQ(wrong, 0) << "the edge is more than a voxel off, measured at the box";
}

TEST_F(ViewLighting, SmoothSurfacesThrowNoShadowOnThemselves) {
    look.specular = 0.0f;
    ViewRendering plain(device, look, k);
    // Lights from overhead to 5 degrees above the floor, over a corner of it that the box does not shade.
    for (const float height_m : {0.4f, 0.1f, 0.03f, 0.015f}) {
        light_g_m = {0.10f, test::floor_y_m - height_m, 0.12f};
        view = plain.render(volume, T_g_c, {light_g_m, std::nullopt, nullptr});
        int compared = 0;
        for (int y = 0; y < k.height_px; ++y) {
            for (int x = 0; x < k.width_px; ++x) {
                const auto hit = inner_hit(x, y);
                if (!hit || hit->point.z() > 0.25f) continue;
                const float cosine = hit->normal.dot((light_g_m - hit->point).normalized());
                const float c = std::clamp(cosine / std::cos(1.3963f), 0.0f, 1.0f);
                const Eigen::Vector3f expected =
                    hit->color * (look.ambient + look.diffuse * cosine * c * c * (3.0f - 2.0f * c));
                ASSERT_LT((color(x, y) - expected).cwiseAbs().maxCoeff(), 2.5f / 255.0f)
                    << "two of 255 levels off at " << x << " " << y << ", light " << height_m << " m high";
                ++compared;
            }
        }
        EXPECT_GT(compared, 1000);
    }
}

TEST_F(ViewLighting, TheMirrorShowsWhatTheReflectedRayMeets) {
    const MirrorSphere sphere{{0.20f, 0.40f, 0.22f}, 0.08f};
    render({light_g_m, sphere, nullptr});
    std::array<int, 4> compared{};  // floor, wall, box, sky
    int off = 0;
    for (int y = 0; y < k.height_px; ++y) {
        for (int x = 0; x < k.width_px; ++x) {
            const auto entry =
                reference::sphere_entry(eye(), ray_g(x, y), sphere.centre_g_m, sphere.radius_m);
            const auto behind = test::hit_scene(eye(), ray_g(x, y));
            if (!entry || (behind && behind->t < *entry)) continue;
            ASSERT_NEAR(depth(x, y), *entry, 1e-4f) << "metres";
            const Eigen::Vector3f p = eye() + *entry * ray_g(x, y);
            const Eigen::Vector3f direction =
                reference::mirrored(ray_g(x, y).normalized(), (p - sphere.centre_g_m) / sphere.radius_m);
            const auto seen = test::hit_scene(p, direction);
            Eigen::Vector3f expected;
            if (seen) {
                if (seen->to_edge_m < 2.5f * voxel_m) continue;
                const auto arrives = share(*seen);
                const auto shaded = reference::sphere_entry(seen->point, light_g_m - seen->point,
                                                            sphere.centre_g_m, sphere.radius_m + voxel_m);
                if (!arrives || shaded) continue;
                expected = phong(*seen, direction, *arrives);
                ++compared[seen->color.y() > 0.5f ? 0 : seen->color.x() > 0.5f ? 1 : 2];
            } else {
                const Eigen::Vector3f end = p + 0.8f * direction;
                if (end.y() > test::floor_y_m || end.z() > test::wall_z_m) continue;  // near the cube's end
                expected =
                    look.sky_low + (look.sky_high - look.sky_low) * (0.5f + 0.5f * direction.dot(look.up_g));
                ++compared[3];
            }
            off += (color(x, y) - look.mirror * expected).cwiseAbs().maxCoeff() > 4.0f / 255.0f;
        }
    }
    EXPECT_GT(compared[0], 60);
    EXPECT_GT(compared[1], 60);
    EXPECT_GT(compared[2], 15);
    EXPECT_GT(compared[3], 60);
    EXPECT_LE(off, 3) << "pixels that are four of 255 levels off";
}

TEST_F(ViewLighting, TheSphereThrowsAShadow) {
    const MirrorSphere sphere{{0.20f, 0.30f, 0.22f}, 0.06f};
    render({light_g_m, sphere, nullptr});
    int lit = 0, dark = 0, wrong = 0;
    for (int y = 0; y < k.height_px; ++y) {
        for (int x = 0; x < k.width_px; ++x) {
            if (reference::sphere_entry(eye(), ray_g(x, y), sphere.centre_g_m, sphere.radius_m)) continue;
            const auto hit = inner_hit(x, y);
            if (!hit || hit->color.y() < 0.5f || share(*hit) != 1.0f) continue;
            const auto shaded = [&](float by_m) {
                const Eigen::Vector3f to_light = light_g_m - hit->point;
                const auto t =
                    reference::sphere_entry(hit->point, to_light, sphere.centre_g_m, sphere.radius_m + by_m);
                return t && *t < 1.0f;
            };
            // The shadow's edge is a voxel wide, half of it outside: by a quarter of a voxel it is decided.
            if (shaded(-0.25f * voxel_m) != shaded(0.25f * voxel_m)) continue;
            const float of_dark = phong(*hit, ray_g(x, y), 0.0f).norm();
            const float of_lit = phong(*hit, ray_g(x, y), 1.0f).norm();
            const bool is_lit = color(x, y).norm() > 0.5f * (of_dark + of_lit);
            (shaded(0.0f) ? dark : lit) += 1;
            wrong += is_lit == shaded(0.0f);
        }
    }
    EXPECT_GT(lit, 1500);
    EXPECT_GT(dark, 200);
    EXPECT_EQ(wrong, 0) << "the edge is more than a quarter of a voxel off, measured at the sphere";
}

/// Over the camera's picture: the sphere as it is, its shadow as black with alpha, and nothing else; not the
/// shadow of the box, which is real.
TEST_F(ViewLighting, OverTheCamerasPictureOnlyWhatIsVirtualDarkens) {
    const MirrorSphere sphere{{0.20f, 0.30f, 0.22f}, 0.06f};
    render({light_g_m, sphere, nullptr});
    const ShadedView whole = view;
    render({.light_g_m = light_g_m, .sphere = sphere, .style = ViewStyle::over_camera});
    int of_sphere = 0, dark = 0, in_box_shadow = 0, wrong = 0;
    for (int y = 0; y < k.height_px; ++y) {
        for (int x = 0; x < k.width_px; ++x) {
            const auto at = static_cast<std::size_t>(4 * (y * k.width_px + x));
            const auto entry =
                reference::sphere_entry(eye(), ray_g(x, y), sphere.centre_g_m, sphere.radius_m);
            const auto behind = test::hit_scene(eye(), ray_g(x, y));
            if (entry && std::abs(depth(x, y) - *entry) < 1e-4f) {
                ++of_sphere;
                wrong += !std::equal(&view.rgba[at], &view.rgba[at] + 4, &whole.rgba[at]);
                continue;
            }
            const auto hit = inner_hit(x, y);
            if (!hit || !behind || hit->normal.y() != -1.0f) continue;
            const auto shaded = [&](float by_m) {
                const auto t = reference::sphere_entry(hit->point, light_g_m - hit->point, sphere.centre_g_m,
                                                       sphere.radius_m + by_m);
                return t && *t < 1.0f;
            };
            if (shaded(-0.5f * voxel_m) != shaded(0.5f * voxel_m)) continue;
            const float cosine = hit->normal.dot((light_g_m - hit->point).normalized());
            const float full = look.diffuse * cosine / (look.ambient + look.diffuse * cosine);
            (shaded(0.0f) ? dark : in_box_shadow) += shaded(0.0f) || share(*hit) == 0.0f;
            wrong += view.rgba[at] != 0 || view.rgba[at + 1] != 0 || view.rgba[at + 2] != 0;
            const float expected = shaded(0.0f) ? 255.0f * full : 0.0f;
            wrong += std::abs(static_cast<float>(view.rgba[at + 3]) - expected) > 2.5f;
        }
    }
    EXPECT_GT(of_sphere, 200);
    EXPECT_GT(dark, 200);
    EXPECT_GT(in_box_shadow, 200);
    EXPECT_EQ(wrong, 0) << "pixels that are more than two of 255 levels off";
}

}  // namespace
}  // namespace touchstone
