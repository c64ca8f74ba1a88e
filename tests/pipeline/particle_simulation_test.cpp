// Particles against a scalar simulation of each with each, and what must hold for any time: energy, walls,
// the table, the hand.
#include "pipeline/particle_simulation.hpp"

#include <gtest/gtest.h>
#include <random>

#include "tests/reference/particles.hpp"
#include "tests/support/distance_snapshot.hpp"
#include "tests/support/small_volume.hpp"

namespace touchstone {
namespace {

const Eigen::Vector3f down(0.0f, 0.0f, -9.81f);

std::vector<Particle> random_cloud(int count, const Eigen::Vector3f& low_m, const Eigen::Vector3f& high_m,
                                   float speed, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> share(0.0f, 1.0f);
    const auto unit = [&] { return Eigen::Vector3f(share(random), share(random), share(random)); };
    std::vector<Particle> cloud(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < cloud.size(); ++i)
        cloud[i] = {low_m + unit().cwiseProduct(high_m - low_m),
                    speed * (2.0f * unit() - Eigen::Vector3f::Ones()), static_cast<int>(i)};
    return cloud;
}

/// Of moving and of touching: kinetic, of gravity, of springs between particles and at the walls.
double energy(const ParticleConfig& c, const std::vector<Particle>& particles) {
    double sum = 0.0;
    const auto spring = [&](float depth_m) {
        return depth_m > 0.0f ? 0.5 * static_cast<double>(c.stiffness * depth_m * depth_m) : 0.0;
    };
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const Particle& p = particles[i];
        sum += 0.5 * static_cast<double>(p.velocity.squaredNorm() - 2.0f * down.dot(p.position_m));
        for (int axis = 0; axis < 3; ++axis)
            sum += spring(c.radius_m - (p.position_m[axis] - c.low_m[axis])) +
                   spring(c.radius_m - (c.high_m[axis] - p.position_m[axis]));
        for (std::size_t j = 0; j < i; ++j)
            sum += spring(2.0f * c.radius_m - (p.position_m - particles[j].position_m).norm());
    }
    return sum;
}

class ParticleSimulationTest : public testing::Test {
  protected:
    static ParticleConfig box(float side_m) {
        ParticleConfig config;
        config.low_m = Eigen::Vector3f::Zero();
        config.high_m = Eigen::Vector3f::Constant(side_m);
        return config;
    }
    const Device device_{DeviceConfig{}};
};

/// 500 in a cube of 8 cm, most of them in touch, beside 200 still ones, over twelve sub-steps: the sums
/// differ by their order, at stiffness 10,000 some micrometres.
TEST_F(ParticleSimulationTest, IsTheScalarOne) {
    const ParticleConfig config = box(0.08f);
    std::vector<Particle> expected =
        random_cloud(500, Eigen::Vector3f::Constant(0.005f), Eigen::Vector3f::Constant(0.075f), 0.3f, 5);
    const std::vector<Particle> still =
        random_cloud(200, Eigen::Vector3f(-0.03f, 0.0f, 0.0f), Eigen::Vector3f(0.0f, 0.08f, 0.08f), 0.2f, 6);
    ParticleSimulation simulation(device_, config);
    simulation.set_gravity(down);
    simulation.set_still(still);
    simulation.add(expected);
    for (int step = 0; step < 12; ++step) {
        expected = reference::substep(config, expected, still, down);
        simulation.advance(config.substep_s * 1.0001f, nullptr);
        const std::vector<Particle> found = simulation.particles();
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
            EXPECT_EQ(found[i].id, static_cast<int>(i));
            EXPECT_LT((found[i].position_m - expected[i].position_m).norm(), 5e-6f) << step << " " << i;
            EXPECT_LT((found[i].velocity - expected[i].velocity).norm(), 2e-3f) << step << " " << i;
        }
    }
}

/// Cells repeat every 128 (z: 8) cells: across those borders particles meet all the same, and those that
/// share a key from afar do not.
TEST_F(ParticleSimulationTest, CellsMeetAcrossTheirRepetition) {
    ParticleConfig config;
    const float cell_m = 2.0f * config.radius_m;
    const float pushed = config.stiffness * 0.002f * config.substep_s;  // 8 mm apart instead of 10
    for (int axis = 0; axis < 3; ++axis) {
        for (const float border : {-128.0f, 0.0f, 8.0f, 128.0f}) {
            std::vector<Particle> pair(3);
            pair[0].position_m = Eigen::Vector3f::Constant(0.5f * cell_m);
            pair[0].position_m[axis] = border * cell_m - 0.004f;
            pair[1].position_m = pair[0].position_m;
            pair[1].position_m[axis] += 0.008f;
            pair[2].position_m = pair[0].position_m;
            pair[2].position_m[axis] += 128.0f * cell_m;
            ParticleSimulation simulation(device_, config);
            simulation.add(pair);
            simulation.advance(config.substep_s * 1.01f, nullptr);
            const std::vector<Particle> found = simulation.particles();
            EXPECT_NEAR(found[0].velocity[axis], -pushed, 0.001f) << axis << " " << border;
            EXPECT_NEAR(found[1].velocity[axis], pushed, 0.001f) << axis << " " << border;
            EXPECT_EQ(found[2].velocity, Eigen::Vector3f::Zero()) << axis << " " << border;
        }
    }
}

/// No momentum is made by two of equal mass that hit each other, and some energy is lost.
TEST_F(ParticleSimulationTest, AHitKeepsMomentumAndLosesEnergy) {
    ParticleConfig config;
    std::vector<Particle> pair(2);
    pair[0] = {{0.0f, 0.0f, 0.0f}, {0.5f, 0.1f, 0.0f}};
    pair[1] = {{0.03f, 0.003f, 0.0f}, {-0.4f, 0.0f, 0.05f}};
    ParticleSimulation simulation(device_, config);
    simulation.add(pair);
    for (int i = 0; i < 48; ++i) simulation.advance(config.substep_s * 1.0001f, nullptr);
    const std::vector<Particle> after = simulation.particles();
    const Eigen::Vector3f before = pair[0].velocity + pair[1].velocity;
    EXPECT_LT((after[0].velocity + after[1].velocity - before).norm(), 1e-5f);
    EXPECT_LT(after[0].velocity.x(), after[1].velocity.x()) << "they have parted";
    EXPECT_LT(after[0].velocity.squaredNorm() + after[1].velocity.squaredNorm(), 0.5f * 0.42f);
}

/// 800 fall into a heap in a closed box for 10 s. Energy is that of a moment, of which semi-implicit steps
/// conserve a near one: it swings by less than half a hundredth of what there was at first, and by less than
/// a thousandth in the second half, never above what it has been by more.
TEST_F(ParticleSimulationTest, EnergyNeverGrowsInAClosedBox) {
    const ParticleConfig config = box(0.12f);
    ParticleSimulation simulation(device_, config);
    simulation.set_gravity(down);
    std::vector<Particle> grid;
    for (int i = 0; i < 800; ++i)
        grid.push_back({Eigen::Vector3f(
            0.006f + 0.0105f * static_cast<float>(i % 10) + 0.0001f * static_cast<float>(i % 7),
            0.006f + 0.0105f * static_cast<float>(i / 10 % 10),
            0.006f + 0.0105f * static_cast<float>(i / 100))});
    simulation.add(grid);
    const double at_start = energy(config, simulation.particles());
    double least = at_start;
    for (int i = 0; i < 100; ++i) {
        simulation.advance(0.05f, nullptr);
        simulation.advance(0.05f, nullptr);
        const double now = energy(config, simulation.particles());
        EXPECT_LT(now, least + (i < 50 ? 5e-3 : 1e-3) * at_start) << i;
        if (i == 50) least = now;
        least = std::min(least, now);
    }
    float fastest = 0.0f;
    for (const Particle& p : simulation.particles()) {
        fastest = std::max(fastest, p.velocity.norm());
        const float inside_m = std::min(p.position_m.minCoeff(), (config.high_m - p.position_m).minCoeff());
        EXPECT_GT(inside_m, -config.radius_m) << "the lowest of eight sinks in by 8 mm";
    }
    EXPECT_LT(fastest, 0.05f) << "at rest, but for a tremor";
}

/// On a table of a TSDF: a particle's middle rests a radius above it, less g / stiffness = 1 mm, and stays
/// where it is on a slope of 15 degrees, whose friction of 0.5 holds 26 degrees.
TEST_F(ParticleSimulationTest, RestsOnTheSurfaceOfAVolume) {
    const VolumeConfig volume_config = test::small_volume();
    const Eigen::Vector3f normal = Eigen::Vector3f(std::sin(0.26f), 0.0f, std::cos(0.26f));
    for (const Eigen::Vector3f& n : {Eigen::Vector3f(0.0f, 0.0f, 1.0f), normal}) {
        const auto plane = [&](const Eigen::Vector3f& p) {
            return n.dot(p - Eigen::Vector3f(0.32f, 0.32f, 0.302f));
        };
        const TsdfVolume volume = restore_volume(device_, test::snapshot_of(volume_config, plane));
        ParticleConfig config;
        ParticleSimulation simulation(device_, config);
        simulation.set_gravity(down);
        std::vector<Particle> apart;
        for (int i = 0; i < 25; ++i)
            apart.push_back({Eigen::Vector3f(0.25f + 0.03f * static_cast<float>(i % 5),
                                             0.25f + 0.03f * static_cast<float>(i / 5), 0.38f)});
        simulation.add(apart);
        for (int i = 0; i < 90; ++i) simulation.advance(1.0f / 30.0f, &volume);
        const std::vector<Particle> before = simulation.particles();
        for (int i = 0; i < 30; ++i) simulation.advance(1.0f / 30.0f, &volume);
        const std::vector<Particle> after = simulation.particles();
        for (std::size_t i = 0; i < after.size(); ++i) {
            EXPECT_NEAR(plane(after[i].position_m), config.radius_m - 0.001f, 0.0005f) << i;
            EXPECT_LT((after[i].position_m - before[i].position_m).norm(), 0.005f)
                << "creeps less than 5 mm/s";
        }
    }
}

/// A palm of still spheres, 7 mm apart: what falls on it lies there after three seconds.
TEST_F(ParticleSimulationTest, RestsOnAHandHeldStill) {
    ParticleConfig config;
    ParticleSimulation simulation(device_, config);
    simulation.set_gravity(down);
    std::vector<Particle> palm;
    for (int x = 0; x < 14; ++x)
        for (int y = 0; y < 14; ++y)
            palm.push_back(
                {Eigen::Vector3f(0.007f * static_cast<float>(x), 0.007f * static_cast<float>(y), 0.0f)});
    simulation.set_still(palm);
    std::vector<Particle> few;
    for (int i = 0; i < 9; ++i)
        few.push_back({Eigen::Vector3f(0.03f + 0.015f * static_cast<float>(i % 3),
                                       0.03f + 0.015f * static_cast<float>(i / 3), 0.05f)});
    simulation.add(few);
    for (int i = 0; i < 90; ++i) simulation.advance(1.0f / 30.0f, nullptr);
    for (const Particle& p : simulation.particles()) {
        EXPECT_GT(p.position_m.z(), 0.006f) << p.id;
        EXPECT_LT(p.position_m.z(), 0.013f) << p.id;
        EXPECT_LT(p.velocity.norm(), 0.01f) << p.id;
    }
}

TEST_F(ParticleSimulationTest, ANewOnePushesOutTheOldest) {
    ParticleConfig config;
    config.capacity = 10;
    ParticleSimulation simulation(device_, config);
    simulation.add(random_cloud(8, {0.0f, 0.0f, 0.0f}, {1.0f, 1.0f, 1.0f}, 0.0f, 1));
    simulation.add(random_cloud(5, {0.0f, 0.0f, 0.0f}, {1.0f, 1.0f, 1.0f}, 0.0f, 2));
    const std::vector<Particle> found = simulation.particles();
    ASSERT_EQ(found.size(), 10u);
    EXPECT_EQ(found.front().id, 3);
    EXPECT_EQ(found.back().id, 12);
    simulation.clear();
    EXPECT_TRUE(simulation.particles().empty());
}

/// Frames of any length come to the same: sub-steps are of one length.
TEST_F(ParticleSimulationTest, TheTimeOfAFrameChangesNothing) {
    const ParticleConfig config = box(0.08f);
    const std::vector<Particle> cloud =
        random_cloud(100, Eigen::Vector3f::Constant(0.005f), Eigen::Vector3f::Constant(0.075f), 0.2f, 9);
    ParticleSimulation often(device_, config), seldom(device_, config);
    for (ParticleSimulation* each : {&often, &seldom}) {
        each->set_gravity(down);
        each->add(cloud);
    }
    for (int i = 0; i < 40; ++i) often.advance(1.0f / 200.0f, nullptr);
    for (int i = 0; i < 4; ++i) seldom.advance(1.0f / 20.0f, nullptr);
    const std::vector<Particle> a = often.particles(), b = seldom.particles();
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].position_m, b[i].position_m) << i;
}

}  // namespace
}  // namespace touchstone
