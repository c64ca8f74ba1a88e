#include "platform/openni2_drivers/simulator/turned_object.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "platform/openni2_drivers/simulator/random.hpp"

namespace touchstone::sim {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

constexpr int turning_strokes = 8;  ///< the first ones, about the vertical
constexpr double stroke_rad = std::numbers::pi / 4.0;

/// Share of a stroke, 0 to 1: constant speed, with six frames to gather it and six to lose it.
double stroke_share(double frame) {
    constexpr double ramp = 6.0;
    constexpr double length = TurnedObject::stroke_frames;
    const auto gathered = [](double t) {
        // Integral of (1 - cos(pi t / ramp)) / 2.
        return t < ramp ? 0.5 * (t - ramp / std::numbers::pi * std::sin(std::numbers::pi * t / ramp))
                        : t - 0.5 * ramp;
    };
    const double t = std::clamp(frame, 0.0, length);
    const double whole = length - ramp;
    return t < 0.5 * length ? gathered(t) / whole : 1.0 - gathered(length - t) / whole;
}

/// Strokes made since the start, a real number.
double strokes_made(double frame) {
    const double begun =
        std::min(std::floor(frame / TurnedObject::period_frames), static_cast<double>(TurnedObject::strokes));
    if (begun >= TurnedObject::strokes) return TurnedObject::strokes;
    return begun + stroke_share(frame - begun * TurnedObject::period_frames - TurnedObject::pause_frames);
}

}  // namespace

TurnedObject::TurnedObject(std::uint64_t seed) {
    Random random(seed, 0x704e);
    side_ = random.chance(0.5F) ? 1.0 : -1.0;
    phase_rad_ = static_cast<double>(random.uniform(0.0F, 6.28F));
}

Eigen::Isometry3d TurnedObject::at(double frame) const {
    const double made = strokes_made(frame);
    const double turn_rad = side_ * stroke_rad * std::min(made, static_cast<double>(turning_strokes));
    const double tilt_rad = stroke_rad * std::max(made - turning_strokes, 0.0);
    // Hands do not hold still.
    const auto sway = [&](double period, double phase_rad) {
        return std::sin(2.0 * std::numbers::pi * frame / period + phase_rad + phase_rad_);
    };
    Eigen::Isometry3d T_w_o = Eigen::Isometry3d::Identity();
    T_w_o.translation() = Vector3d(0.0, distance_m, 0.0) +
                          Vector3d(0.012 * sway(149, 0.0), 0.015 * sway(211, 1.0), 0.010 * sway(113, 2.0));
    T_w_o.linear() = (AngleAxisd(0.03 * sway(83, 3.0), Vector3d(1.0, 2.0, 1.0).normalized()) *
                      AngleAxisd(tilt_rad, Vector3d::UnitX()) * AngleAxisd(turn_rad, Vector3d::UnitZ()) *
                      AngleAxisd(0.5 * std::numbers::pi, Vector3d::UnitX()))
                         .toRotationMatrix();
    return T_w_o;
}

int TurnedObject::folded(int frame) {
    const int within = frame % (2 * frames);
    return within <= frames ? within : 2 * frames - within;
}

}  // namespace touchstone::sim
