#include "platform/openni2_drivers/simulator/camera_path.hpp"

#include <cmath>
#include <numbers>

#include "platform/openni2_drivers/simulator/random.hpp"

namespace touchstone::sim {
namespace {

constexpr double rad(double degrees) { return degrees * std::numbers::pi / 180.0; }

/// Amplitude and period of x, y, z (metres) and yaw, pitch, roll (radians).
struct Swing {
    double amplitude, period_frames;
};
using Swings = std::array<Swing, 6>;

Swings swings_of(CameraMotion motion) {
    switch (motion) {
        case CameraMotion::still:
            break;
        case CameraMotion::sweep:
            return {{{0.42, 300}, {0.16, 190}, {0.25, 410}, {rad(14), 160}, {rad(8), 130}, {rad(6), 230}}};
        case CameraMotion::orbit:
            return {{{0, 1}, {0, 1}, {0, 1}, {rad(42), 440}, {rad(12), 220}, {0, 1}}};
        case CameraMotion::rpy:
            return {{{0.04, 170}, {0.03, 130}, {0.04, 210}, {rad(21), 29}, {rad(15), 23}, {rad(22), 31}}};
        case CameraMotion::slide:
            return {{{0.45, 260}, {0, 1}, {0, 1}, {0, 1}, {0, 1}, {0, 1}}};
    }
    Swings none;
    none.fill({0.0, 1.0});
    return none;
}

/// Time that starts from rest and soon runs as fast as the frames.
double eased(double frames) {
    constexpr double start_frames = 12.0;
    return frames * frames / (frames + start_frames);
}

Eigen::Matrix3d turned(double yaw_rad, double pitch_rad, double roll_rad) {
    using Eigen::AngleAxisd;
    return (AngleAxisd(yaw_rad, Eigen::Vector3d::UnitY()) * AngleAxisd(pitch_rad, Eigen::Vector3d::UnitX()) *
            AngleAxisd(roll_rad, Eigen::Vector3d::UnitZ()))
        .toRotationMatrix();
}

}  // namespace

double CameraPath::Wave::operator()(double frames) const {
    return amplitude *
           (std::sin(2.0 * std::numbers::pi * frames / period_frames + phase_rad) - std::sin(phase_rad));
}

CameraPath::CameraPath(CameraMotion motion, const Viewpoint& start, std::uint64_t seed)
    : motion_(motion), start_(start) {
    Random random(seed, 0xca3e4a);
    const Swings swings = swings_of(motion);
    for (std::size_t i = 0; i < waves_.size(); ++i) {
        // The first way is left or right, up or down.
        const double side = random.chance(0.5F) ? 1.0 : -1.0;
        const auto scale = static_cast<double>(random.uniform(0.95F, 1.05F));
        waves_[i] = {side * swings[i].amplitude, scale * swings[i].period_frames, 0.0};
    }
    // Nearer and back: behind the viewpoint there is no room.
    waves_[2].amplitude = std::abs(waves_[2].amplitude);
    waves_[2].phase_rad = -0.5 * std::numbers::pi;
    for (std::size_t i = 0; i < tremor_.size(); ++i) {
        const bool shift = i < tremor_.size() / 2;
        const auto amplitude = static_cast<double>(random.uniform(0.2F, 0.6F));
        const auto period = static_cast<double>(random.uniform(3.3F, 8.0F));  // 4 to 9 Hz
        const auto phase = static_cast<double>(random.uniform(0.0F, 6.28F));
        tremor_[i] = {amplitude * (shift ? 1e-3 : rad(0.06)), period, phase};
    }
}

Eigen::Isometry3d CameraPath::at(int frame) const {
    const double frames = eased(frame);
    Offset offset;
    if (motion_ == CameraMotion::still) return start_.T_s_c;
    if (motion_ == CameraMotion::sweep) offset = sweep(frames);
    if (motion_ == CameraMotion::orbit) offset = orbit(frames);
    if (motion_ == CameraMotion::rpy) offset = rpy(frames);
    if (motion_ == CameraMotion::slide) offset = slide(frames);
    Eigen::Isometry3d T_start_c = Eigen::Isometry3d::Identity();
    T_start_c.linear() = turned(offset.yaw_rad, offset.pitch_rad, offset.roll_rad);
    T_start_c.translation() = offset.shift_m;
    return start_.T_s_c * T_start_c;
}

CameraPath::Offset CameraPath::sweep(double frames) const {
    Offset offset;
    offset.shift_m = {waves_[0](frames), waves_[1](frames), waves_[2](frames)};
    // Looks at what it passes, and around.
    offset.yaw_rad = waves_[3](frames) - 0.6 * std::atan(offset.shift_m.x() / start_.pivot_m);
    offset.pitch_rad = waves_[4](frames) + 0.6 * std::atan(offset.shift_m.y() / start_.pivot_m);
    offset.roll_rad = waves_[5](frames);
    add_tremor(frames, offset);
    return offset;
}

CameraPath::Offset CameraPath::orbit(double frames) const {
    Offset offset;
    offset.yaw_rad = waves_[3](frames);
    offset.pitch_rad = waves_[4](frames);
    const Eigen::Vector3d pivot(0.0, 0.0, start_.pivot_m);
    offset.shift_m = pivot - turned(offset.yaw_rad, offset.pitch_rad, 0.0) * pivot;
    return offset;
}

/// The axes take turns, a second or two each, with rests between.
CameraPath::Offset CameraPath::rpy(double frames) const {
    constexpr double turn_frames = 75.0;
    const auto share = [&](double turn) {
        const double phase = frames / turn_frames - turn;
        const double own = phase - 3.0 * std::floor(phase / 3.0);
        return own < 1.0 ? std::pow(std::sin(std::numbers::pi * own), 2.0) : 0.0;
    };
    Offset offset;
    offset.shift_m = {waves_[0](frames), waves_[1](frames), waves_[2](frames)};
    offset.yaw_rad = share(0.0) * waves_[3](frames);
    offset.pitch_rad = share(1.0) * waves_[4](frames);
    offset.roll_rad = share(2.0) * waves_[5](frames);
    add_tremor(frames, offset);
    return offset;
}

CameraPath::Offset CameraPath::slide(double frames) const {
    Offset offset;
    offset.shift_m.x() = waves_[0](frames);
    return offset;
}

void CameraPath::add_tremor(double frames, Offset& offset) const {
    // Grows with the movement: the path starts at rest.
    const double share = frames / (frames + 12.0);
    const auto both = [&](std::size_t i) {
        return share * (tremor_[2 * i](frames) + tremor_[2 * i + 1](frames));
    };
    offset.shift_m += Eigen::Vector3d(both(0), both(1), both(2));
    offset.yaw_rad += both(3);
    offset.pitch_rad += both(4);
    offset.roll_rad += both(5);
}

}  // namespace touchstone::sim
