#include "tests/accuracy/close_pairs.hpp"

#include <cmath>
#include <set>

#include "tests/accuracy/touch_match.hpp"

namespace touchstone {
namespace {

constexpr double contact_gap_mm = 1.0;
constexpr double least_apart_mm = 30.0, most_apart_mm = 45.0;
constexpr int frames_after = 3;

bool are_close(const TrueTip& a, const TrueTip& b) {
    const double mm = std::hypot(a.camera_mm[0] - b.camera_mm[0], a.camera_mm[1] - b.camera_mm[1],
                                 a.camera_mm[2] - b.camera_mm[2]);
    return a.hand == b.hand && mm >= least_apart_mm && mm <= most_apart_mm;
}

/// Hands with a close pair in a frame.
std::set<int> paired_hands(const std::vector<TrueTip>& tips) {
    std::set<int> hands;
    const std::vector<TrueTip> down = tips_within(tips, contact_gap_mm);
    for (std::size_t i = 0; i < down.size(); ++i)
        for (std::size_t j = i + 1; j < down.size(); ++j)
            if (are_close(down[i], down[j])) hands.insert(down[i].hand);
    return hands;
}

/// Hands whose two fingers have a touch each.
std::set<int> found_hands(const std::vector<TrueTip>& tips, const std::vector<LoggedTouch>& touches) {
    std::set<int> once, twice;
    for (const TouchMatch& match : match_touches(tips, touches)) {
        const int hand = tips[match.tip].hand;
        if (!once.insert(hand).second) twice.insert(hand);
    }
    return twice;
}

/// A pair of a hand that is looked at, until some frames after it was last seen.
struct OpenPair {
    int last = 0;
    bool found = false;
};

}  // namespace

Found score_close_pairs(const TouchTruth& truth, const TouchLog& log) {
    static const std::vector<LoggedTouch> none;
    Found pairs;
    std::map<int, OpenPair> open;
    const auto close = [&](const OpenPair& pair) { pairs.found += pair.found ? 1 : 0; };
    for (int frame = 0; frame < std::ssize(truth.tips); ++frame) {
        const auto& tips = truth.tips[static_cast<std::size_t>(frame)];
        for (const int hand : paired_hands(tips)) {
            const auto [pair, is_new] = open.try_emplace(hand);
            pair->second.last = frame;
            pairs.contacts += is_new ? 1 : 0;
        }
        const auto logged = log.find(frame);
        const auto& touches = logged == log.end() ? none : logged->second;
        for (const int hand : found_hands(tips, touches))
            if (const auto pair = open.find(hand); pair != open.end()) pair->second.found = true;
        std::erase_if(open, [&](const auto& entry) {
            const bool over = frame >= entry.second.last + frames_after;
            if (over) close(entry.second);
            return over;
        });
    }
    for (const auto& [hand, pair] : open) close(pair);
    return pairs;
}

}  // namespace touchstone
