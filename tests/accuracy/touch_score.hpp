#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tests/accuracy/touch_record.hpp"

namespace touchstone {

struct Found {
    int contacts = 0;
    int found = 0;
    double rate() const { return contacts == 0 ? 0.0 : static_cast<double>(found) / contacts; }
};

/// Fingertips in the air, outside the frames that count for a contact.
struct HoverScore {
    int tips = 0;      ///< tip and frame pairs looked at
    int mistaken = 0;  ///< of them, taken for a touch
    std::optional<double> smallest_mistaken_mm;
    std::optional<double> largest_mistaken_mm;
    /// The gap from which on, in every millimetre with at least ten tips, 95 % are told from a touch.
    std::optional<double> told_from_mm;
};

/// What a log lacks or has too much: for looking at it.
struct MissedContact {
    int hand = 0, finger = 0;
    int first_frame = 0, last_frame = 0;
    std::array<double, 3> camera_mm{};  ///< in its last frame
};
struct SpuriousTouch {
    int id = 0;
    int first_frame = 0;
    std::array<double, 3> camera_mm{};  ///< in its first frame
};

/// How a touch log compares with the truth. A contact is a run of frames with a gap of at most 1 mm. It is
/// found if one of its frames, two before to three after it, has a touch within 25 mm. A touch id is spurious
/// if in none of its frames a fingertip within 6 mm of the surface was within 25 mm of it.
struct TouchScore {
    Found all, of_one_frame, of_two_frames, of_three_and_more, of_two_and_more, second_fingers;
    int spurious_ids = 0;
    int true_frames = 0, missed_frames = 0, false_frames = 0;  ///< touch and frame pairs
    std::vector<double> position_mm;  ///< error of each matched touch within a contact
    std::vector<double> late_frames;  ///< of each contact found; negative: before it began
    int id_switches = 0;
    int drags = 0, drag_id_switches = 0;  ///< contacts found that moved by 20 mm or more, and of them
    HoverScore hover;
    std::vector<MissedContact> missed;
    std::vector<SpuriousTouch> spurious;  ///< one for each spurious id
    int frames = 0;
    double fps = 30.0;

    double minutes() const { return frames / fps / 60.0; }
};

TouchScore score_touches(const TouchTruth& truth, const TouchLog& log);

/// All figures, with the names of the independent scorer where it has them.
std::string json_of(const TouchScore& score);
/// One line for people.
std::string line_of(const TouchScore& score);

}  // namespace touchstone
