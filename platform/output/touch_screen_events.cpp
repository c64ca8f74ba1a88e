#include "platform/output/touch_screen_events.hpp"

#include <algorithm>
#include <cmath>
#include <linux/input.h>
#include <utility>

namespace touchstone {
namespace {

constexpr int units_per_mm = 10;
constexpr int largest_of_unknown_length = 32767;
constexpr int tracking_ids = 65536;

int place(double share, const TouchScreenAxis& axis) {
    return static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * axis.largest));
}

}  // namespace

TouchScreenAxis touch_screen_axis(int length_mm) {
    if (length_mm <= 0) return {largest_of_unknown_length, 0};
    return {units_per_mm * length_mm, units_per_mm};
}

TouchScreenEvents::TouchScreenEvents(const TouchScreenConfig& config)
    : x_axis_(touch_screen_axis(config.width_mm)),
      y_axis_(touch_screen_axis(config.height_mm)),
      slots_(static_cast<std::size_t>(config.slots)) {}

TouchScreenEvents::Events TouchScreenEvents::frame(const std::vector<ReportedFinger>& touches) {
    return tell(follower_.take(touches));
}

TouchScreenEvents::Events TouchScreenEvents::release_all() { return tell(follower_.end_all()); }

TouchScreenEvents::Events TouchScreenEvents::tell(const std::vector<ContactChange>& changes) {
    for (const ContactChange& change : changes) {
        if (change.step == ContactStep::begin) {
            begin(change);
        } else if (Slot* slot = slot_of(change.contact)) {
            change.step == ContactStep::move ? move(*slot, change.finger) : end(*slot);
        }
    }
    close();
    return std::exchange(events_, {});
}

void TouchScreenEvents::begin(const ContactChange& change) {
    Slot* slot = free_slot();
    if (slot == nullptr) {
        close();
        slot = free_slot();
    }
    if (slot == nullptr) {
        ++left_out_;
        return;
    }
    slot->contact = change.contact;
    slot->is_new = true;
    select(*slot);
    put(EV_ABS, ABS_MT_TRACKING_ID, change.contact % tracking_ids);
    move(*slot, change.finger);
}

void TouchScreenEvents::move(Slot& slot, const ReportedFinger& finger) {
    const int x = place(finger.surface[0], x_axis_), y = place(finger.surface[1], y_axis_);
    if (x == slot.x && y == slot.y) return;
    select(slot);
    if (x != slot.x) put(EV_ABS, ABS_MT_POSITION_X, x);
    if (y != slot.y) put(EV_ABS, ABS_MT_POSITION_Y, y);
    slot.x = x;
    slot.y = y;
}

void TouchScreenEvents::end(Slot& slot) {
    if (slot.is_new) close();
    select(slot);
    put(EV_ABS, ABS_MT_TRACKING_ID, -1);
    slot.contact = 0;
    slot.is_new = true;
}

/// Ends what the kernel is told at one time, if there is anything.
void TouchScreenEvents::close() {
    if (!is_open_) return;
    point();
    put(EV_SYN, SYN_REPORT, 0);
    is_open_ = false;
    for (Slot& slot : slots_) slot.is_new = false;
}

/// The pointer, by the rules of the kernel's input_mt_report_pointer_emulation.
void TouchScreenEvents::point() {
    const Slot* oldest = nullptr;
    for (const Slot& slot : slots_)
        if (slot.contact != 0 && (oldest == nullptr || slot.contact < oldest->contact)) oldest = &slot;
    Slot now = oldest != nullptr ? *oldest : pointer_;
    if (oldest == nullptr) now.contact = 0;
    if ((now.contact != 0) != (pointer_.contact != 0)) put(EV_KEY, BTN_TOUCH, now.contact != 0 ? 1 : 0);
    if (now.x != pointer_.x) put(EV_ABS, ABS_X, now.x);
    if (now.y != pointer_.y) put(EV_ABS, ABS_Y, now.y);
    pointer_ = now;
}

TouchScreenEvents::Slot* TouchScreenEvents::slot_of(std::int32_t contact) {
    const auto found = std::ranges::find(slots_, contact, &Slot::contact);
    return found != slots_.end() ? &*found : nullptr;
}

TouchScreenEvents::Slot* TouchScreenEvents::free_slot() {
    const auto found =
        std::ranges::find_if(slots_, [](const Slot& slot) { return slot.contact == 0 && !slot.is_new; });
    return found != slots_.end() ? &*found : nullptr;
}

void TouchScreenEvents::select(const Slot& slot) {
    const std::ptrdiff_t index = &slot - slots_.data();
    if (index != selected_slot_) put(EV_ABS, ABS_MT_SLOT, static_cast<int>(index));
    selected_slot_ = index;
}

void TouchScreenEvents::put(unsigned type, unsigned code, int value) {
    events_.push_back({static_cast<std::uint16_t>(type), static_cast<std::uint16_t>(code), value});
    is_open_ = true;
}

}  // namespace touchstone
