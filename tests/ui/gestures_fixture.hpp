#pragma once

#include <gtest/gtest.h>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "ui/gestures.hpp"

namespace touchstone {

/// Unlike the default, so that a length in the wrong unit shows.
inline constexpr float mm_per_px = 2.f;
inline constexpr std::uint64_t frame_us = 33'000;

inline GestureConfig config() {
    GestureConfig result;
    result.mm_per_px = mm_per_px;
    return result;
}

/// The left part of the table is target 1, the right is target 2, between them is background.
inline std::optional<int> two_things(const Eigen::Vector2f& place_px) {
    if (place_px.x() < 100.f) return 1;
    if (place_px.x() > 400.f) return 2;
    return std::nullopt;
}

inline std::string word(GesturePhase phase) {
    return phase == GesturePhase::begin ? "begin" : phase == GesturePhase::change ? "change" : "end";
}
inline std::string word(const Tap&) { return "tap"; }
inline std::string word(const DoubleTap&) { return "double tap"; }
inline std::string word(const Hold&) { return "hold"; }
inline std::string word(const Swipe&) { return "swipe"; }
inline std::string word(const Drag& d) { return "drag " + word(d.phase) + (d.cancelled ? " cancelled" : ""); }
inline std::string word(const Transform& t) {
    return "transform " + word(t.phase) + (t.cancelled ? " cancelled" : "");
}

/// A table at 30 frames a second on which fingers are put by number. Places are millimetres.
class GesturesTest : public testing::Test {
  protected:
    void touch(int finger, TouchPhase phase, FingerState state = FingerState::down) {
        TouchEvent event;
        event.tip.id = ids_.at(finger);
        event.tip.pixel_px = places_mm_.at(finger) / mm_per_px;
        event.tip.state = state;
        event.phase = phase;
        recognizer_.on_touch(event, now_us_);
    }
    void down(int finger, Eigen::Vector2f at_mm) {
        ids_[finger] = next_id_++;
        places_mm_[finger] = at_mm;
        down_[finger] = true;
        touch(finger, TouchPhase::down);
    }
    void up(int finger) {
        down_[finger] = false;
        touch(finger, TouchPhase::up);
    }
    void put(int finger, Eigen::Vector2f at_mm) { places_mm_[finger] = at_mm; }

    /// Tells where all fingers are, moves time on by a frame and takes what was recognised.
    void frame(std::uint64_t us = frame_us) {
        for (const auto& [finger, is_down] : down_)
            if (is_down) touch(finger, TouchPhase::move);
        take(recognizer_.update(now_us_));
        now_us_ += us;
    }
    void frames(int count) {
        for (int i = 0; i < count; ++i) frame();
    }
    void wait(std::uint64_t us) { take(recognizer_.update(now_us_ += us)); }
    void move_to(int finger, Eigen::Vector2f to_mm, int in_frames) {
        const Eigen::Vector2f from_mm = places_mm_.at(finger);
        for (int i = 1; i <= in_frames; ++i) {
            put(finger, from_mm + (to_mm - from_mm) * static_cast<float>(i) / static_cast<float>(in_frames));
            frame();
        }
    }
    void tap(int finger, Eigen::Vector2f at_mm, int in_frames = 3) {
        down(finger, at_mm);
        frames(in_frames);
        up(finger);
        frame();
    }
    void take(std::vector<Gesture> gestures) {
        for (Gesture& gesture : gestures) all_.push_back(std::move(gesture));
    }

    /// In order, without changes.
    std::string story(std::size_t first = 0) const {
        std::string result;
        for (std::size_t i = first; i < all_.size(); ++i) {
            const Gesture& gesture = all_[i];
            const std::string told = std::visit([](const auto& what) { return word(what); }, gesture.what);
            if (!told.ends_with("change")) result += (result.empty() ? "" : ", ") + told;
        }
        return result;
    }
    template <class T>
    std::vector<T> every() const {
        std::vector<T> result;
        for (const Gesture& gesture : all_)
            if (const T* what = std::get_if<T>(&gesture.what)) result.push_back(*what);
        return result;
    }
    const Gesture& last() const { return all_.back(); }

    void TearDown() override {
        // Whatever the test: what begins ends, and deltas sum up to the total.
        take(recognizer_.cancel());
        std::map<int, int> open;
        std::map<int, Eigen::Vector2f> sums_px;
        for (const Gesture& gesture : all_) {
            GesturePhase phase = GesturePhase::change;
            if (const Drag* drag = std::get_if<Drag>(&gesture.what)) {
                phase = drag->phase;
                Eigen::Vector2f& sum_px = sums_px.try_emplace(gesture.group, 0.f, 0.f).first->second;
                if (phase == GesturePhase::begin) sum_px.setZero();
                sum_px += drag->delta_px;
                EXPECT_LT((sum_px - drag->total_px).norm(), 1e-2f) << "pixels";
                EXPECT_EQ(open[gesture.group], phase == GesturePhase::begin ? 0 : 1);
                EXPECT_EQ(gesture.fingers, 1);
            } else if (const Transform* transform = std::get_if<Transform>(&gesture.what)) {
                phase = transform->phase;
                EXPECT_EQ(open[gesture.group], phase == GesturePhase::begin ? 0 : 1);
                EXPECT_GE(gesture.fingers, 2);
            }
            open[gesture.group] += phase == GesturePhase::begin ? 1 : phase == GesturePhase::end ? -1 : 0;
        }
        for (const auto& [group, count] : open) EXPECT_EQ(count, 0) << "group " << group;
    }

    GestureRecognizer recognizer_{config(), two_things};
    std::uint64_t now_us_ = 1'000'000;
    int next_id_ = 1;
    std::map<int, int> ids_;
    std::map<int, Eigen::Vector2f> places_mm_;
    std::map<int, bool> down_;
    std::vector<Gesture> all_;
};

inline const Eigen::Vector2f on_one(60.f, 400.f);    // target 1
inline const Eigen::Vector2f on_two(1000.f, 400.f);  // target 2
inline const Eigen::Vector2f background(500.f, 400.f);

}  // namespace touchstone
