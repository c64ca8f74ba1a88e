#include "platform/openni2_drivers/simulator/simulator_source.hpp"

#include <algorithm>
#include <cmath>

#include "platform/openni2_drivers/simulator/depth_noise.hpp"
#include "platform/openni2_drivers/simulator/hand_layer.hpp"
#include "platform/openni2_drivers/simulator/hand_script.hpp"
#include "platform/openni2_drivers/simulator/knock.hpp"
#include "platform/openni2_drivers/simulator/mask_files.hpp"
#include "platform/openni2_drivers/simulator/placed_object.hpp"
#include "platform/openni2_drivers/simulator/pose_writer.hpp"
#include "platform/openni2_drivers/simulator/projector_light.hpp"
#include "platform/openni2_drivers/simulator/static_layer.hpp"
#include "platform/openni2_drivers/simulator/truth_writer.hpp"
#include "platform/system/error.hpp"

namespace touchstone {
namespace {

using namespace sim;

SourceInfo make_info(const SimulatorConfig& config, const TableView& view) {
    const Intrinsics& k = view.intrinsics;
    return {k, config.color, k.width_px, k.height_px, config.rate_hz, Pace::live, config.color};
}

/// Half the width of what the camera sees of the table along its optical axis.
float reach_m(const TableView& view) { return view.on_table(639.0F, 239.5F).x(); }

/// Nothing for a tip that is farther than 300 mm from every surface.
std::optional<TipTruth> tip_truth(const RoundCone& tip, int hand, int finger, const Scene& scene,
                                  const TableView& view) {
    constexpr float farthest_m = 0.3F;
    const float distance_m = scene.distance(tip.a);
    const float gap = std::max(0.0F, distance_m - tip.radius_a);
    if (gap > farthest_m) return std::nullopt;
    const Vec3 on_surface_s = tip.a - distance_m * scene.normal(tip.a);
    return TipTruth{hand, finger, 1000.0F * gap, 1000.0F * view.to_camera(on_surface_s)};
}

std::optional<PlacedObject> make_placed(const SimulatorConfig& config, const Scene& scene,
                                        const TableView& view) {
    if (config.object == ObjectKind::none) return std::nullopt;
    return PlacedObject(config, scene, view);
}

/// What hands touch: an object that stays counts from the start.
Scene with_object(const Scene& scene, const std::optional<PlacedObject>& placed) {
    std::vector<Shape> shapes = scene.shapes();
    if (placed) shapes.push_back(placed->resting());
    return Scene(std::move(shapes));
}

}  // namespace

struct SimulatorSource::State {
    explicit State(const SimulatorConfig& given)
        : config(given),
          view(make_table_view(config.height_m, config.tilt_deg)),
          scene(make_scene(config.scene, config.seed, reach_m(view))),
          static_depth_m(render_static_depth(scene, view)),
          placed(make_placed(config, scene, view)),
          touched(with_object(scene, placed)),
          touched_depth_m(placed ? render_static_depth(touched, view) : static_depth_m),
          info(make_info(config, view)),
          noise(config.seed, view.intrinsics.fx_px, config.noise, config.drift) {
        for (int hand = 0; hand < config.hands; ++hand) {
            const float half = config.hands < 2 ? 0.0F : hand == 0 ? -1.0F : 1.0F;
            scripts.emplace_back(config, Workplace{touched, view, touched_depth_m, half}, hand);
        }
        if (config.projector) set_up_projector();
        if (!config.truth_path.empty()) truth.emplace(config.truth_path, config.rate_hz);
        if (!config.poses_path.empty()) poses.emplace(config.poses_path);
    }

    void set_up_projector();
    void ask_hands();
    void follow_camera(double time_s);
    void draw(double time_s);
    void draw_placed(double time_s);
    void write_truth();
    void make_color(std::vector<std::uint8_t>& color_rgb);

    SimulatorConfig config;
    TableView view;  ///< of the camera as it was set up: what the hands reckon with
    Scene scene;
    std::vector<float> static_depth_m;  ///< in `view`
    std::optional<PlacedObject> placed;
    Scene touched;                       ///< the scene with the object
    std::vector<float> touched_depth_m;  ///< of that, in `view`
    PlacedObject::Moment placed_moment;  ///< of this frame
    TableView seen = view;               ///< of the camera as it is: elsewhere after a knock
    std::vector<float> seen_depth_m = static_depth_m;
    std::vector<std::uint8_t> static_color_rgb;  ///< made when colour is first asked for
    SourceInfo info;
    DepthNoise noise;
    std::vector<HandScript> scripts;
    std::vector<std::optional<HandMoment>> moments;  ///< of this frame, one for each script
    Picture picture;
    std::optional<TruthWriter> truth;
    std::optional<PoseWriter> poses;
    std::optional<Projector> projector;
    std::optional<ProjectorLight> light;
    ProjectedPictureReader thrown{projected_picture_name()};
    bool color = false;
    int next_index = 0;
};

void SimulatorSource::State::set_up_projector() {
    projector = make_projector(view, config.seed);
    projector->position_s.x() += 0.001F * static_cast<float>(config.projector_moved_mm);
    light.emplace(*projector, static_cast<float>(config.ambient), config.seed);
    if (!config.projector_truth_path.empty()) write_projector(config.projector_truth_path, *projector, view);
}

/// A person sees where the light of the asked pixel falls.
void SimulatorSource::State::ask_hands() {
    const ProjectedPicture* shown = thrown.latest();
    std::optional<Vec3> place_s;
    if (shown && shown->aim_px) {
        // The picture is stretched to the projector's.
        const Eigen::Vector2f stretch(
            static_cast<float>(projector->width_px) / static_cast<float>(shown->width_px),
            static_cast<float>(projector->height_px) / static_cast<float>(shown->height_px));
        const Eigen::Vector2f half(0.5F, 0.5F), aim_px((*shown->aim_px)[0], (*shown->aim_px)[1]);
        const Vec3 ray_s = projector->ray_s((aim_px + half).cwiseProduct(stretch) - half);
        place_s = first_hit(touched, projector->position_s, ray_s.normalized());
    }
    for (HandScript& script : scripts) script.ask(place_s);
}

void SimulatorSource::State::follow_camera(double time_s) {
    const TableView now = moved_view(view, knock(config, time_s));
    if (now.rotation_s_c == seen.rotation_s_c && now.camera_s == seen.camera_s) return;
    seen = now;
    seen_depth_m = render_static_depth(scene, seen);
    static_color_rgb.clear();
}

void SimulatorSource::State::draw(double time_s) {
    clear_picture(picture, seen_depth_m);
    moments.clear();
    if (placed) draw_placed(time_s);
    for (HandScript& script : scripts) {
        const auto owner = static_cast<int>(moments.size());
        moments.push_back(script.at(time_s));
        if (moments.back()) draw_hand(picture, moments.back()->hand, owner, seen);
    }
}

void SimulatorSource::State::draw_placed(double time_s) {
    placed_moment = placed->at(time_s);
    if (placed_moment.object) draw_shape(picture, *placed_moment.object, seen);
    // Its owner is one that no script has.
    if (placed_moment.hand) draw_hand(picture, *placed_moment.hand, config.hands, seen);
}

void SimulatorSource::State::write_truth() {
    std::vector<TipTruth> tips;
    for (std::size_t i = 0; i < moments.size(); ++i) {
        if (!moments[i]) continue;
        const auto hand = static_cast<int>(i);
        if (const auto index = tip_truth(moments[i]->hand.index(), hand, 0, touched, seen))
            tips.push_back(*index);
        if (!moments[i]->thumb_in_use) continue;
        if (const auto thumb = tip_truth(moments[i]->hand.thumb(), hand, 1, touched, seen))
            tips.push_back(*thumb);
    }
    truth->add_frame(tips);
}

void SimulatorSource::State::make_color(std::vector<std::uint8_t>& color_rgb) {
    if (static_color_rgb.empty()) static_color_rgb = render_static_color(scene, seen, seen_depth_m);
    color_rgb = static_color_rgb;
    if (placed_moment.object) color_shape(color_rgb, picture, *placed_moment.object, seen);
    if (placed_moment.hand)
        color_hand(color_rgb, picture, *placed_moment.hand, placed->hand_shape(), config.hands, seen);
    for (std::size_t i = 0; i < moments.size(); ++i)
        if (moments[i])
            color_hand(color_rgb, picture, moments[i]->hand, scripts[i].shape(), static_cast<int>(i), seen);
    if (light) light->shine(color_rgb, picture.depth_m, seen, thrown.latest(), next_index);
}

SimulatorSource::SimulatorSource(const SimulatorConfig& config) : state_(std::make_unique<State>(config)) {}

SimulatorSource::~SimulatorSource() = default;

const SourceInfo& SimulatorSource::info() const { return state_->info; }

void SimulatorSource::enable_color(bool enabled) { state_->color = enabled; }

bool SimulatorSource::next(SourceFrame& frame) {
    State& state = *state_;
    if (state.config.frames > 0 && state.next_index >= state.config.frames) return false;
    frame.index = state.next_index++;
    const double time_s = frame.index / state.config.rate_hz;
    frame.timestamp_us = static_cast<std::uint64_t>(std::llround(1e6 * time_s));
    state.follow_camera(time_s);
    if (state.config.guided) state.ask_hands();
    state.draw(time_s);
    state.noise.apply(state.picture.depth_m, frame.index, time_s, frame.depth_mm);
    frame.color_rgb.clear();
    if (state.color) state.make_color(frame.color_rgb);
    if (state.truth) state.write_truth();
    if (state.poses) state.poses->add_frame(time_s, pose_of(state.seen));
    if (!state.config.masks_folder.empty())
        write_masks(state.config.masks_folder, frame, state.picture, state.info.intrinsics);
    return true;
}

}  // namespace touchstone
