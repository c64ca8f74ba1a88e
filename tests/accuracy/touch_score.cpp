#include "tests/accuracy/touch_score.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "tests/accuracy/touch_match.hpp"

namespace touchstone {
namespace {

constexpr double contact_gap_mm = 1.0;
constexpr double drag_mm = 20.0;
constexpr double justified_gap_mm = 6.0;
constexpr int frames_before = 2;
constexpr int frames_after = 3;
constexpr std::size_t hover_bins = 60;  // of a millimetre
constexpr int fewest_tips_of_a_bin = 10;

using Finger = std::pair<int, int>;  // hand, finger
using Tips = std::vector<TrueTip>;
using Touches = std::vector<LoggedTouch>;

struct Contact {
    Finger finger;
    int first = 0;
    int last = 0;
    std::array<double, 3> at_mm{};  ///< in its last frame
    double way_mm = 0.0;
};

struct Hit {
    int frame = 0;
    int id = 0;
};

Finger finger_of(const TrueTip& tip) { return {tip.hand, tip.finger}; }

std::vector<Contact> contacts_of(const TouchTruth& truth) {
    std::vector<Contact> done;
    std::map<Finger, Contact> open;
    for (int frame = 0; frame <= std::ssize(truth.tips); ++frame) {
        Tips down;
        if (frame < std::ssize(truth.tips))
            down = tips_within(truth.tips[static_cast<std::size_t>(frame)], contact_gap_mm);
        for (const TrueTip& tip : down) {
            const auto& at = tip.camera_mm;
            Contact& contact =
                open.try_emplace(finger_of(tip), Contact{finger_of(tip), frame, frame, at}).first->second;
            const auto& before = contact.at_mm;
            contact.way_mm += std::hypot(at[0] - before[0], at[1] - before[1], at[2] - before[2]);
            contact.at_mm = at;
            contact.last = frame;
        }
        std::erase_if(open, [&](const auto& begun) {
            const bool over = begun.second.last < frame;
            if (over) done.push_back(begun.second);
            return over;
        });
    }
    return done;
}

/// Collects, frame by frame, what the scores of contacts, ids and hover are made of.
class Scorer {
  public:
    explicit Scorer(const TouchTruth& truth) : contacts_(contacts_of(truth)) {
        score_.frames = static_cast<int>(truth.tips.size());
        score_.fps = truth.fps;
    }

    void take_frame(int frame, const Tips& tips, const Touches& touches) {
        for (const LoggedTouch& touch : touches)
            seen_.try_emplace(touch.id, SpuriousTouch{touch.id, frame, touch.camera_mm});
        const Tips near = tips_within(tips, justified_gap_mm);
        const auto near_matches = match_touches(near, touches);
        for (const TouchMatch& match : near_matches) {
            const int id = touches[match.touch].id;
            justified_.insert(id);
            hits_[finger_of(near[match.tip])].push_back({frame, id});
            if (near[match.tip].gap_mm <= contact_gap_mm) score_.position_mm.push_back(match.distance_mm);
        }
        const Tips down = tips_within(tips, contact_gap_mm);
        const int found = static_cast<int>(match_touches(down, touches).size());
        score_.true_frames += found;
        score_.missed_frames += static_cast<int>(down.size()) - found;
        score_.false_frames += static_cast<int>(touches.size()) - static_cast<int>(near_matches.size());
        take_hovers(frame, tips, touches);
    }

    TouchScore result() {
        for (const Contact& contact : contacts_) take_contact(contact);
        for (const auto& [id, touch] : seen_)
            if (!justified_.contains(id)) score_.spurious.push_back(touch);
        score_.spurious_ids = static_cast<int>(score_.spurious.size());
        finish_hover();
        return std::move(score_);
    }

  private:
    struct HoverBin {
        int tips = 0;
        int told = 0;
    };

    static bool counts_for(const Contact& contact, int frame) {
        return frame >= contact.first - frames_before && frame <= contact.last + frames_after;
    }

    void take_contact(const Contact& contact) {
        std::set<int> ids;
        std::optional<int> first;
        for (const Hit& hit : hits_[contact.finger]) {
            if (!counts_for(contact, hit.frame)) continue;
            if (!first) first = hit.frame;
            ids.insert(hit.id);
        }
        const int length = contact.last - contact.first + 1;
        Found& by_length = length == 1   ? score_.of_one_frame
                           : length == 2 ? score_.of_two_frames
                                         : score_.of_three_and_more;
        count(score_.all, first.has_value());
        count(by_length, first.has_value());
        if (length >= 2) count(score_.of_two_and_more, first.has_value());
        if (contact.finger.second == 1) count(score_.second_fingers, first.has_value());
        if (!first) {
            score_.missed.push_back(
                {contact.finger.first, contact.finger.second, contact.first, contact.last, contact.at_mm});
            return;
        }
        score_.late_frames.push_back(*first - contact.first);
        const int switches = static_cast<int>(ids.size()) - 1;
        score_.id_switches += switches;
        if (contact.way_mm >= drag_mm) {
            ++score_.drags;
            score_.drag_id_switches += switches;
        }
    }

    static void count(Found& found, bool is_found) {
        ++found.contacts;
        found.found += is_found ? 1 : 0;
    }

    void take_hovers(int frame, const Tips& tips, const Touches& touches) {
        std::set<std::size_t> taken_for_touches;
        for (const TouchMatch& match : match_touches(tips, touches)) taken_for_touches.insert(match.tip);
        for (std::size_t i = 0; i < tips.size(); ++i) {
            if (tips[i].gap_mm > contact_gap_mm && !is_of_a_contact(finger_of(tips[i]), frame)) {
                take_hover(tips[i].gap_mm, taken_for_touches.contains(i));
            }
        }
    }

    bool is_of_a_contact(const Finger& finger, int frame) const {
        return std::any_of(contacts_.begin(), contacts_.end(), [&](const Contact& contact) {
            return contact.finger == finger && counts_for(contact, frame);
        });
    }

    void take_hover(double gap_mm, bool is_mistaken) {
        HoverScore& hover = score_.hover;
        ++hover.tips;
        if (is_mistaken) {
            ++hover.mistaken;
            hover.smallest_mistaken_mm = std::min(hover.smallest_mistaken_mm.value_or(gap_mm), gap_mm);
            hover.largest_mistaken_mm = std::max(hover.largest_mistaken_mm.value_or(gap_mm), gap_mm);
        }
        HoverBin& bin = hover_bins_[std::min(static_cast<std::size_t>(gap_mm), hover_bins - 1)];
        ++bin.tips;
        bin.told += is_mistaken ? 0 : 1;
    }

    void finish_hover() {
        for (std::size_t i = hover_bins; i-- > 0;) {
            const HoverBin& bin = hover_bins_[i];
            if (bin.tips < fewest_tips_of_a_bin) continue;
            if (bin.told < 0.95 * bin.tips) break;
            score_.hover.told_from_mm = static_cast<double>(i);
        }
    }

    std::vector<Contact> contacts_;
    std::map<Finger, std::vector<Hit>> hits_;
    std::map<int, SpuriousTouch> seen_;  ///< where each id began
    std::set<int> justified_;
    std::array<HoverBin, hover_bins> hover_bins_{};
    TouchScore score_;
};

}  // namespace

TouchScore score_touches(const TouchTruth& truth, const TouchLog& log) {
    static const Touches none;
    Scorer scorer(truth);
    for (int frame = 0; frame < std::ssize(truth.tips); ++frame) {
        const auto logged = log.find(frame);
        scorer.take_frame(frame, truth.tips[static_cast<std::size_t>(frame)],
                          logged == log.end() ? none : logged->second);
    }
    return scorer.result();
}

}  // namespace touchstone
