#include "platform/openni2_drivers/simulator/geometry.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <gtest/gtest.h>

#include "platform/openni2_drivers/simulator/random.hpp"

namespace touchstone::sim {
namespace {

/// Written the slow way: the ball, of all balls along the axis, that the point is deepest in.
float distance_by_search(const RoundCone& cone, const Vec3& p) {
    float nearest = 1e9F;
    for (int i = 0; i <= 4000; ++i) {
        const float share = static_cast<float>(i) / 4000.0F;
        const Vec3 middle = cone.a + share * (cone.b - cone.a);
        nearest =
            std::min(nearest, (p - middle).norm() - cone.radius_a - share * (cone.radius_b - cone.radius_a));
    }
    return nearest;
}

RoundCone any_cone(Random& random) {
    const auto around = [&](float z) {
        return Vec3(random.uniform(-0.05F, 0.05F), random.uniform(-0.05F, 0.05F),
                    z + random.uniform(-0.05F, 0.05F));
    };
    return {around(1.0F), around(1.05F), random.uniform(0.006F, 0.012F), random.uniform(0.006F, 0.012F)};
}

TEST(RoundCone, RaysEndOnItsSkinWithAnOutwardNormal) {
    Random random(1, 0);
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
        const RoundCone cone = any_cone(random);
        const Vec3 direction =
            Vec3(random.uniform(-0.08F, 0.08F), random.uniform(-0.08F, 0.08F), 1.0F).normalized();
        const float t = ConeTracer(cone)(direction);
        if (t < 0.0F) continue;
        ++hits;
        const Vec3 point = t * direction;
        EXPECT_NEAR(distance_by_search(cone, point), 0.0F, 2e-5F);
        EXPECT_LT(normal_at(cone, point).dot(direction), 0.02F);
        EXPECT_NEAR(distance_by_search(cone, point + 1e-3F * normal_at(cone, point)), 1e-3F, 3e-5F);
    }
    EXPECT_GT(hits, 60);
}

TEST(RoundCone, RaysThatMissPassAllOfIt) {
    Random random(2, 0);
    for (int i = 0; i < 300; ++i) {
        const RoundCone cone = any_cone(random);
        const Vec3 direction =
            Vec3(random.uniform(-0.08F, 0.08F), random.uniform(-0.08F, 0.08F), 1.0F).normalized();
        if (ConeTracer(cone)(direction) > 0.0F) continue;
        for (float t = 0.9F; t < 1.2F; t += 0.001F)
            EXPECT_GT(distance_by_search(cone, t * direction), -2e-5F);
    }
}

}  // namespace
}  // namespace touchstone::sim
