#include <algorithm>
#include <array>
#include <cmath>

#include "platform/openni2_drivers/simulator/random.hpp"
#include "platform/openni2_drivers/simulator/scene.hpp"

namespace touchstone::sim {
namespace {

Eigen::Vector2f direction(float yaw_rad) { return {std::cos(yaw_rad), std::sin(yaw_rad)}; }

/// Scatters things over a part of the table; they keep apart from each other.
class Layout {
  public:
    Layout(std::uint64_t seed, float left_m, float right_m, float depth_m)
        : random_(seed, 0x5ce4e), left_m_(left_m), right_m_(right_m), depth_m_(depth_m) {}

    void add_ridge(float x_m, float height_m) {
        Shape ridge;
        ridge.kind = Shape::Kind::ridge;
        ridge.center = {x_m, 0.0F, 0.0F};
        ridge.along = direction(radians(90.0F + random_.uniform(-15.0F, 15.0F)));
        ridge.radius_m = 0.16F;
        ridge.depth_m = height_m;
        ridge.thickness_m = 0.12F;
        ridge.albedo = {0.55F, 0.62F, 0.50F};
        shapes.push_back(ridge);
    }

    void add_bowl(float x_m, float y_m) {
        Shape bowl;
        bowl.kind = Shape::Kind::bowl;
        bowl.radius_m = 0.23F;
        bowl.depth_m = 0.075F;
        bowl.thickness_m = 0.004F;
        bowl.center = {x_m, y_m, bowl.radius_m + bowl.thickness_m};
        bowl.albedo = {0.72F, 0.76F, 0.80F};
        shapes.push_back(bowl);
    }

    void add_objects(int count) {
        for (int i = 0; i < count; ++i) {
            Shape shape = any_object(i);
            const float needed = object_reach_m(shape);
            for (int attempt = 0; attempt < 60; ++attempt) {
                const float x = random_.uniform(left_m_, right_m_);
                const float y = random_.uniform(-depth_m_, depth_m_);
                if (!apart(x, y, needed)) continue;
                shape.center.x() = x;
                shape.center.y() = y;
                taken_.push_back({x, y, needed});
                shapes.push_back(shape);
                break;
            }
        }
    }

    std::vector<Shape> shapes;

  private:
    Vec3 color_of(int number) const {
        constexpr std::array<std::array<float, 3>, 6> colors{{{0.75F, 0.25F, 0.2F},
                                                              {0.2F, 0.4F, 0.7F},
                                                              {0.85F, 0.75F, 0.3F},
                                                              {0.25F, 0.55F, 0.35F},
                                                              {0.8F, 0.8F, 0.78F},
                                                              {0.3F, 0.3F, 0.33F}}};
        return Vec3(colors[static_cast<std::size_t>(number + first_color_) % colors.size()].data());
    }

    /// Boxes, balls, and now and then a can or a book, standing on the table.
    Shape any_object(int number) {
        Shape shape;
        shape.albedo = color_of(number);
        if (number % 4 == 1) {
            shape.kind = Shape::Kind::ball;
            shape.radius_m = random_.uniform(0.022F, 0.055F);
            shape.center.z() = shape.radius_m;
            return shape;
        }
        if (number % 4 == 3) {
            shape.kind = Shape::Kind::can;
            shape.half = {random_.uniform(0.028F, 0.045F), 0.0F, random_.uniform(0.03F, 0.055F)};
            shape.radius_m = 0.004F;
        } else {
            const bool book = number % 4 == 2;
            shape.half = book ? Vec3(0.075F, 0.105F, random_.uniform(0.008F, 0.02F))
                              : Vec3(random_.uniform(0.025F, 0.07F), random_.uniform(0.025F, 0.08F),
                                     random_.uniform(0.015F, 0.05F));
            shape.radius_m = 0.002F;
            shape.along = direction(random_.uniform(-1.5F, 1.5F));
        }
        shape.center.z() = shape.half.z();
        return shape;
    }

    static float object_reach_m(const Shape& shape) {
        if (shape.kind == Shape::Kind::ball) return shape.radius_m;
        if (shape.kind == Shape::Kind::can) return shape.half.x();
        return shape.half.head<2>().norm();
    }

    bool apart(float x, float y, float needed) const {
        return std::all_of(taken_.begin(), taken_.end(), [&](const Vec3& other) {
            return std::hypot(x - other.x(), y - other.y()) > needed + other.z() + 0.03F;
        });
    }

    Random random_;
    int first_color_ = random_.below(6);
    float left_m_, right_m_, depth_m_;
    std::vector<Vec3> taken_;  ///< x, y, reach
};

}  // namespace

Scene make_scene(SimulatedScene kind, std::uint64_t seed, float reach_m) {
    const float side_m = 0.8F * reach_m;
    const bool mixed = kind == SimulatedScene::mixed;
    Layout layout(seed, mixed ? 0.05F * reach_m : -side_m, side_m, 0.65F * reach_m);
    if (kind == SimulatedScene::curved) layout.add_ridge(0.0F, 0.08F);
    if (kind == SimulatedScene::bowl) layout.add_bowl(0.0F, 0.0F);
    if (mixed) layout.add_ridge(-0.55F * reach_m, 0.06F);
    if (kind == SimulatedScene::cluttered) layout.add_objects(10);
    if (mixed) layout.add_objects(4);
    return Scene(std::move(layout.shapes));
}

}  // namespace touchstone::sim
