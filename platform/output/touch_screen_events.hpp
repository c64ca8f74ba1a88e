#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "platform/output/contact_follower.hpp"

namespace touchstone {

struct TouchScreenConfig {
    int slots = 10;     ///< contacts at one time
    int width_mm = 0;   ///< of the interactive area; 0: not known
    int height_mm = 0;  ///< of the interactive area; 0: not known
};

/// One axis of the screen, from 0.
struct TouchScreenAxis {
    int largest = 0;
    int units_per_mm = 0;  ///< 0: not known
};

/// A tenth of a millimetre a unit where the length is known.
TouchScreenAxis touch_screen_axis(int length_mm);

/// What the kernel's input_event holds beside the time.
struct InputEvent {
    std::uint16_t type = 0, code = 0;
    std::int32_t value = 0;
    bool operator==(const InputEvent&) const = default;
};

/// Turns reports into the events of a multi-touch screen, protocol B (the kernel's
/// Documentation/input/multi-touch-protocol.rst). The oldest contact is the pointer of programs that know
/// one finger only. A contact for which no slot is free when it begins is left out as long as it lasts.
class TouchScreenEvents {
  public:
    using Events = std::vector<InputEvent>;

    explicit TouchScreenEvents(const TouchScreenConfig& config);

    /// Empty where nothing changed, else closed by SYN_REPORT; a contact that begins and ends in one report
    /// takes two of them, so that it is seen.
    Events frame(const std::vector<ReportedFinger>& touches);
    Events release_all();
    /// Contacts that found no slot.
    int left_out() const { return left_out_; }

  private:
    struct Slot {
        std::int32_t contact = 0;  ///< 0: free
        int x = 0, y = 0;          ///< of its last contact, as the kernel has it
        bool is_new = false;       ///< has begun or ended since the last SYN_REPORT
    };

    Events tell(const std::vector<ContactChange>& changes);
    void begin(const ContactChange& change);
    void move(Slot& slot, const ReportedFinger& finger);
    void end(Slot& slot);
    void close();
    void point();
    Slot* slot_of(std::int32_t contact);
    Slot* free_slot();
    void select(const Slot& slot);
    void put(unsigned type, unsigned code, int value);

    TouchScreenAxis x_axis_, y_axis_;
    ContactFollower follower_{1};
    std::vector<Slot> slots_;
    int left_out_ = 0;
    Events events_;  ///< of the report at hand
    bool is_open_ = false;
    std::ptrdiff_t selected_slot_ = 0;
    Slot pointer_;  ///< as it was last said
};

}  // namespace touchstone
