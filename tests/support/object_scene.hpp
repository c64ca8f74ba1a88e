#pragma once

#include <optional>
#include <vector>

#include "pipeline/background_model.hpp"
#include "pipeline/depth_map_conversion.hpp"
#include "pipeline/foreground_segmentation.hpp"
#include "pipeline/object_segmentation.hpp"
#include "tests/support/analytic_scene.hpp"
#include "tests/support/map_access.hpp"

namespace touchstone::test {

/// A rectangle of a picture at one depth, columns and rows x0 <= x < x1.
struct Slab {
    int x0, y0, x1, y1;
    float depth_m;
};

/// A wall 1 m before a small fixed camera, with slabs before it, through the object stages; 30 frames a
/// second.
class ObjectScene {
  public:
    explicit ObjectScene(const ObjectsConfig& objects = fast())
        : conversion_(device, {}, k),
          live(device, shape),
          segmentation_(device, {}, k),
          objects_(objects, k) {
        BackgroundConfig config;
        config.volume.size_vox = 128;
        config.volume.max_weight = 64;
        config.objects = objects;
        VolumePlacement placement{0.64f, RigidTransform::Identity()};
        placement.T_g_c.translation() = Eigen::Vector3f(0.32f, 0.32f, -0.55f);
        background.emplace(device, config, k, placement);
    }
    /// 10 frames of settling.
    static ObjectsConfig fast() {
        ObjectsConfig config;
        config.settle_s = 0.35f;
        return config;
    }

    std::vector<std::uint16_t> picture(const std::vector<Slab>& slabs) const {
        std::vector<std::uint16_t> depth_mm(static_cast<std::size_t>(k.width_px * k.height_px), 1000);
        for (const Slab& slab : slabs) {
            for (int y = slab.y0; y < slab.y1; ++y) {
                for (int x = slab.x0; x < slab.x1; ++x)
                    depth_mm[static_cast<std::size_t>(y * k.width_px + x)] =
                        static_cast<std::uint16_t>(1000.0f * slab.depth_m);
            }
        }
        return depth_mm;
    }
    void scan(const std::vector<Slab>& slabs, int frames = 10) {
        const auto depth_mm = picture(slabs);
        for (int frame = 0; frame < frames; ++frame) {
            conversion_.convert({depth_mm, k}, live);
            background->scan(live);
            segmentation_.learn(live, background->prediction());
        }
    }
    /// One live frame.
    ObjectChanges show(const std::vector<Slab>& slabs, const std::vector<TouchEvent>& touches = {}) {
        const auto depth_mm = picture(slabs);
        conversion_.convert({depth_mm, k}, live);
        const Foreground& foreground = segmentation_.segment(live, background->prediction());
        segmentation_.mask_background(live, background->prediction());
        foreground_components = static_cast<int>(foreground.components.size());
        const ObjectChanges changes = objects_.update(live, foreground, touches, time_us, *background);
        background->follow(live, foreground.background_mask);
        time_us += 33'333;
        return changes;
    }
    /// The sum of what several frames of the same gave.
    ObjectChanges show_for(int frames, const std::vector<Slab>& slabs,
                           const std::vector<TouchEvent>& touches = {}) {
        ObjectChanges all;
        for (int frame = 0; frame < frames; ++frame) {
            ObjectChanges changes = show(slabs, touches);
            all.settled += changes.settled;
            all.taken += changes.taken;
            for (VolumeSnapshot& object : changes.lifted) all.lifted.push_back(std::move(object));
        }
        return all;
    }
    float predicted_m(int x, int y) const {
        return background->prediction().depth_m.read()[map_index(shape, x, y)];
    }

    Device device{DeviceConfig{}};
    Intrinsics k = small_camera(192, 160);
    MapShape shape = make_map_shape(k);
    std::uint64_t time_us = 0;
    int foreground_components = 0;

  private:
    DepthMapConversion conversion_;

  public:
    LiveMaps live;
    std::optional<BackgroundModel> background;

  private:
    ForegroundSegmentation segmentation_;
    ObjectSegmentation objects_;
};

}  // namespace touchstone::test
