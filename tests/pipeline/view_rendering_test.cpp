#include "pipeline/view_rendering.hpp"

#include <gtest/gtest.h>

#include "tests/reference/view_lighting.hpp"
#include "tests/support/lit_scene.hpp"
#include "tests/support/map_access.hpp"

namespace touchstone {
namespace {

using Rgb = std::array<int, 3>;

/// 150 x 111 pixels: padded, and an odd number of rows.
class ViewRenderingTest : public testing::Test {
  protected:
    void render(const ViewScene& scene, ViewQuality quality = ViewQuality::full) {
        view = rendering.render(volume, T_g_c, scene, quality);
        depth_m = test::cropped(shape, rendering.depth_m().read());
    }
    std::size_t at(int x, int y) const { return static_cast<std::size_t>(y * k.width_px + x); }
    Rgb rgb(int x, int y) const {
        const std::size_t byte = 4 * at(x, y);
        return {view.rgba[byte], view.rgba[byte + 1], view.rgba[byte + 2]};
    }
    Eigen::Vector3f ray_g(int x, int y) const { return T_g_c.linear() * test::pixel_ray(k, x, y); }
    std::optional<test::SceneHit> hit(int x, int y) const {
        return test::hit_scene(T_g_c.translation(), ray_g(x, y));
    }
    /// Whether all pixels at most one away satisfy `holds`.
    template <class Holds>
    static bool around(int x, int y, Holds holds) {
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                if (!holds(x + dx, y + dy)) return false;
            }
        }
        return true;
    }
    auto has_the_colour_of(const test::SceneHit& seen) const {
        return [this, color = seen.color](int x, int y) {
            const auto beside = hit(x, y);
            return beside && beside->color == color;
        };
    }
    template <class F>
    void for_each_pixel(F f) const {
        for (int y = 0; y < k.height_px; ++y) {
            for (int x = 0; x < k.width_px; ++x) f(x, y);
        }
    }

    Device device{DeviceConfig{}};
    Intrinsics k = test::small_camera(150, 111);
    MapShape shape = make_map_shape(k);
    ViewLook look;
    TsdfVolume volume = restore_volume(device, test::lit_scene_snapshot());
    RigidTransform T_g_c = test::looking_at({0.45f, 0.05f, -0.25f}, {0.32f, 0.42f, 0.40f});
    const Eigen::Vector3f light_g_m{0.08f, 0.10f, 0.10f};
    ViewRendering rendering{device, look, k};
    ShadedView view;
    std::vector<float> depth_m;
};

TEST_F(ViewRenderingTest, HasTheSizeOfTheViewAndNoAlpha) {
    render({light_g_m, std::nullopt, nullptr});
    EXPECT_EQ(view.width_px, 150);
    EXPECT_EQ(view.height_px, 111);
    ASSERT_EQ(view.rgba.size(), 4u * 150u * 111u);
    for (std::size_t byte = 3; byte < view.rgba.size(); byte += 4) ASSERT_EQ(view.rgba[byte], 255);
}

TEST_F(ViewRenderingTest, AnEmptyVolumeShowsTheSphereAlone) {
    volume = TsdfVolume(device, test::small_volume());
    const MirrorSphere sphere{{0.32f, 0.42f, 0.40f}, 0.05f};
    render({light_g_m, sphere, nullptr});
    const int x = k.width_px / 2, y = k.height_px / 2;
    EXPECT_NEAR(depth_m[at(x, y)], (sphere.centre_g_m - T_g_c.translation()).norm() - 0.05f, 2e-4f);
    EXPECT_EQ(depth_m[at(0, 0)], 0.0f);
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(rgb(0, 0)[c], 255.0f * look.unknown[static_cast<int>(c)], 1.0f) << "levels of 255";
}

TEST_F(ViewRenderingTest, WithoutColoursSurfacesHaveTheLooksColour) {
    VolumeSnapshot snapshot = test::lit_scene_snapshot();
    snapshot.color_bricks.clear();
    snapshot.colors.clear();
    volume = restore_volume(device, snapshot);
    look.specular = 0.0f;
    ViewRendering dull(device, look, k);
    view = dull.render(volume, T_g_c, {light_g_m, std::nullopt, nullptr});
    const int x = 20, y = 105;  // on the floor, in the light
    ASSERT_EQ(hit(x, y)->normal.y(), -1.0f);
    const auto [r, g, b] = rgb(x, y);
    EXPECT_NEAR(static_cast<float>(r) / static_cast<float>(b), look.surface.x() / look.surface.z(), 0.01f);
    EXPECT_NEAR(static_cast<float>(g) / static_cast<float>(b), look.surface.y() / look.surface.z(), 0.01f);
    EXPECT_GT(b, 100);
}

/// As colours: red to the right, green up, blue towards the camera; 0.05 is 6 degrees, of faces between
/// voxels.
TEST_F(ViewRenderingTest, NormalsAreShownAsColours) {
    render({.light_g_m = light_g_m, .style = ViewStyle::normals});
    int compared = 0;
    for_each_pixel([&](int x, int y) {
        const auto seen = hit(x, y);
        if (!seen || seen->to_edge_m < 0.025f || !around(x, y, has_the_colour_of(*seen))) return;
        const Eigen::Vector3f n = T_g_c.linear().transpose() * seen->normal;
        const std::array expected{0.5f + 0.5f * n.x(), 0.5f - 0.5f * n.y(), 0.5f - 0.5f * n.z()};
        for (std::size_t i = 0; i < 3; ++i)
            ASSERT_NEAR(static_cast<float>(rgb(x, y)[i]) / 255.0f, expected[i], 0.05f) << x << ", " << y;
        ++compared;
    });
    EXPECT_GT(compared, 5000);
}

/// Neither light nor shadow: the volume's own, to two of 255.
TEST_F(ViewRenderingTest, ColoursAreShownUnlit) {
    render({.light_g_m = light_g_m, .style = ViewStyle::colors});
    int compared = 0;
    for_each_pixel([&](int x, int y) {
        const auto seen = hit(x, y);
        if (!seen || seen->to_edge_m < 0.025f || !around(x, y, has_the_colour_of(*seen))) return;
        for (std::size_t i = 0; i < 3; ++i)
            ASSERT_NEAR(rgb(x, y)[i], 255.0f * seen->color[static_cast<int>(i)], 2.0f) << x << ", " << y;
        ++compared;
    });
    EXPECT_GT(compared, 5000);
}

TEST_F(ViewRenderingTest, ASphereBehindTheBoxIsHiddenToThePixel) {
    const MirrorSphere sphere{{0.25f, 0.40f, 0.46f}, 0.10f};
    render({light_g_m, sphere, nullptr});
    int hidden = 0, shown = 0, wrong = 0;
    for_each_pixel([&](int x, int y) {
        const auto entry = [&](int u, int v) {
            return reference::sphere_entry(T_g_c.translation(), ray_g(u, v), sphere.centre_g_m,
                                           sphere.radius_m);
        };
        const auto hides = [&](int u, int v) {
            const auto sphere_m = entry(u, v);
            const auto scene = hit(u, v);
            return scene && sphere_m && scene->t < *sphere_m;
        };
        const auto shows = [&](int u, int v) { return entry(u, v) && !hides(u, v); };
        if (around(x, y, hides)) {
            ++hidden;
            wrong += std::abs(depth_m[at(x, y)] - hit(x, y)->t) > 0.01f;  // a voxel, as at the box's edges
        } else if (around(x, y, shows)) {
            ++shown;
            wrong += std::abs(depth_m[at(x, y)] - *entry(x, y)) > 1e-4f;
        }
    });
    EXPECT_GT(hidden, 300);
    EXPECT_GT(shown, 300);
    EXPECT_EQ(wrong, 0) << "pixels more than one away from the edge of what hides the sphere";
}

/// A square of a virtual mesh that faces the camera at one depth.
class MeshInTheView : public ViewRenderingTest {
  protected:
    void draw_mesh(float z_m, int x0, int y0, int x1, int y1) {
        std::vector<float> z(map_pixels(shape), 0.0f), normals(3 * map_pixels(shape), 0.0f);
        std::vector<std::uint32_t> rgba(map_pixels(shape), 0);
        for (int y = y0; y < y1; ++y) {
            for (int x = x0; x < x1; ++x) {
                z[map_index(shape, x, y)] = z_m;
                normals[2 * map_pixels(shape) + map_index(shape, x, y)] = -1.0f;
                rgba[map_index(shape, x, y)] = 240u | 200u << 8 | 40u << 16 | 255u << 24;
            }
        }
        mesh_m.write(z);
        mesh_normals_c.write(normals);
        mesh_rgba.write(rgba);
    }
    /// The mesh's colour at a pixel with this share of the light.
    Eigen::Vector3f shaded(int x, int y, float share, const Eigen::Vector3f& light) const {
        const Eigen::Vector3f p = T_g_c * (depth_m[at(x, y)] * test::pixel_ray(k, x, y));
        return 255.0f * reference::phong({look.ambient, look.diffuse, look.specular},
                                         Eigen::Vector3f(240.0f, 200.0f, 40.0f) / 255.0f,
                                         -T_g_c.linear().col(2), (light - p).normalized(),
                                         ray_g(x, y).normalized(), share);
    }
    float off(int x, int y, const Eigen::Vector3f& expected) const {
        const auto [r, g, b] = rgb(x, y);
        return (Eigen::Vector3i(r, g, b).cast<float>() - expected).cwiseAbs().maxCoeff();
    }

    Buffer<float> mesh_m{device, map_pixels(shape)}, mesh_normals_c{device, 3 * map_pixels(shape)};
    Buffer<std::uint32_t> mesh_rgba{device, map_pixels(shape)};
    const MeshMaps mesh{mesh_m, mesh_normals_c, mesh_rgba};
};

TEST_F(MeshInTheView, RaysEndAtTheMeshWhereItIsNearer) {
    // Through the box: in front of what is behind it, behind its faces.
    draw_mesh(0.68f, 20, 20, 140, 100);
    render({light_g_m, std::nullopt, &mesh});
    int in_front = 0, behind = 0, wrong = 0;
    for_each_pixel([&](int x, int y) {
        const bool drawn = x >= 20 && x < 140 && y >= 20 && y < 100;
        const auto surface = hit(x, y);
        const bool nearer = drawn && (!surface || surface->t > 0.68f);
        // Where the surface is within half a voxel of the mesh, or has an edge in the next pixel, either may
        // be seen.
        const auto clear = [&](int u, int v) {
            const auto beside = hit(u, v);
            if (beside.has_value() != surface.has_value()) return false;
            return !beside || (beside->t > 0.68f) == (surface->t > 0.68f);
        };
        if (surface && (std::abs(surface->t - 0.68f) < 0.005f || surface->to_edge_m < 0.005f)) return;
        if (!around(x, y, clear)) return;
        (nearer ? in_front : behind) += 1;
        if (nearer) wrong += depth_m[at(x, y)] != 0.68f;
        if (!nearer && surface) wrong += std::abs(depth_m[at(x, y)] - surface->t) > 0.01f;
    });
    EXPECT_GT(in_front, 2000);
    EXPECT_GT(behind, 2000);
    EXPECT_EQ(wrong, 0);
}

TEST_F(MeshInTheView, IsShadedWithItsOwnNormalAndColour) {
    draw_mesh(0.30f, 40, 30, 90, 80);
    const Eigen::Vector3f light = T_g_c * Eigen::Vector3f(0.1f, -0.2f, 0.05f);
    render({light, std::nullopt, &mesh});
    for (const auto& [x, y] : {std::pair(41, 31), std::pair(64, 55), std::pair(89, 79)})
        EXPECT_LT(off(x, y, shaded(x, y, 1.0f, light)), 1.5f) << "levels of 255 at " << x << " " << y;
}

TEST_F(MeshInTheView, TakesTheShadowsOfTheVolume) {
    draw_mesh(0.76f, 0, 0, 150, 111);
    // From beside the box: the mesh cuts the space behind it, half in its shadow.
    const Eigen::Vector3f light{0.10f, 0.36f, 0.20f};
    render({light, std::nullopt, &mesh});
    int lit = 0, dark = 0, wrong = 0;
    for_each_pixel([&](int x, int y) {
        if (depth_m[at(x, y)] != 0.76f) return;
        const Eigen::Vector3f p = T_g_c * (0.76f * test::pixel_ray(k, x, y));
        const auto clear = test::distances_m(p);
        const float cosine = -T_g_c.linear().col(2).dot((light - p).normalized());
        if (cosine < 0.2f || clear.minCoeff() < 0.03f || p.minCoeff() < 0.0f || p.maxCoeff() > 0.64f) return;
        const bool surely_dark = test::box_between(p, light, -0.01f);
        if (!surely_dark && test::box_between(p, light, 0.01f)) return;  // within a voxel of the edge
        (surely_dark ? dark : lit) += 1;
        wrong += off(x, y, shaded(x, y, surely_dark ? 0.0f : 1.0f, light)) > 1.5f;
    });
    EXPECT_GT(lit, 200);
    EXPECT_GT(dark, 100);
    EXPECT_EQ(wrong, 0) << "more than one of 255 levels off";
}

TEST_F(MeshInTheView, IsHiddenByTheSphereBeforeItAndNotSeenInIt) {
    const MirrorSphere sphere{{0.20f, 0.40f, 0.22f}, 0.08f};
    render({light_g_m, sphere, nullptr});
    const ShadedView without = view;
    draw_mesh(0.80f, 0, 0, 150, 111);
    render({light_g_m, sphere, &mesh});
    int compared = 0, other = 0;
    for_each_pixel([&](int x, int y) {
        const auto entry =
            reference::sphere_entry(T_g_c.translation(), ray_g(x, y), sphere.centre_g_m, sphere.radius_m);
        if (!entry || std::abs(depth_m[at(x, y)] - *entry) > 1e-4f) return;
        ++compared;
        for (std::size_t c = 0; c < 3; ++c)
            other += view.rgba[4 * at(x, y) + c] != without.rgba[4 * at(x, y) + c];
    });
    EXPECT_GT(compared, 800);
    EXPECT_EQ(other, 0);
}

TEST_F(MeshInTheView, HalfQualityRepeatsEverySecondPixelOfTheFullView) {
    draw_mesh(0.68f, 21, 21, 140, 100);
    const ViewScene scene{light_g_m, MirrorSphere{{0.20f, 0.40f, 0.22f}, 0.08f}, &mesh};
    render(scene);
    const ShadedView full = view;
    const std::vector<float> full_m = depth_m;
    render(scene, ViewQuality::half);
    ASSERT_EQ(view.rgba.size(), full.rgba.size());
    int other_depth = 0, other_colour = 0;
    for_each_pixel([&](int x, int y) {
        const std::size_t from = at(x & ~1, y & ~1);
        ASSERT_EQ(depth_m[at(x, y)], depth_m[from]);
        ASSERT_EQ(rgb(x, y), rgb(x & ~1, y & ~1));
        if (x % 2 == 1 || y % 2 == 1) return;
        other_depth += std::abs(depth_m[from] - full_m[from]) > 0.001f;
        int most = 0;
        for (std::size_t c = 0; c < 3; ++c)
            most = std::max(most, std::abs(view.rgba[4 * from + c] - full.rgba[4 * from + c]));
        other_colour += most > 2;
    });
    // Rays of other tiles start elsewhere: at edges they may pass a corner or meet it.
    EXPECT_LT(other_depth, 75 * 56 / 100) << "a millimetre";
    EXPECT_LT(other_colour, 75 * 56 / 50) << "two of 255 levels";
}

TEST_F(ViewRenderingTest, AbsentBricksArePassedAsFreeSpace) {
    const ViewScene scene{light_g_m, std::nullopt, nullptr};
    render(scene);
    const ShadedView whole = view;
    const VolumeSnapshot sparse = test::without_free_bricks(test::lit_scene_snapshot());
    ASSERT_LT(sparse.bricks.size(), volume.brick_count() * 7 / 10);
    volume = restore_volume(device, sparse);
    render(scene);
    int compared = 0, other = 0;
    for_each_pixel([&](int x, int y) {
        const auto surface = hit(x, y);
        const auto same = [&](int u, int v) { return hit(u, v) && hit(u, v)->color == surface->color; };
        if (!surface || surface->to_edge_m < 0.025f || !around(x, y, same)) return;
        ++compared;
        int most = 0;
        for (std::size_t c = 0; c < 3; ++c)
            most = std::max(most, std::abs(view.rgba[4 * at(x, y) + c] - whole.rgba[4 * at(x, y) + c]));
        other += most > 2;
    });
    EXPECT_GT(compared, 4000);
    // Steps that begin elsewhere meet the box's corners, and with them the edge of its shadow, a little
    // elsewhere.
    EXPECT_LT(other, compared / 100) << "more than two of 255 levels off";
}

}  // namespace
}  // namespace touchstone
