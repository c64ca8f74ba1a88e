#include "tests/accuracy/touch_series.hpp"

#include <gtest/gtest.h>

#include "tests/accuracy/touch_score.hpp"

namespace touchstone {
namespace {

/// Eight frames without hands, two of a contact.
TouchTruth contact() {
    TouchTruth truth;
    truth.tips.resize(8);
    truth.tips.resize(10, {TrueTip{}});
    return truth;
}

TEST(TouchSeries, ScoresAsAllOfIt) {
    TouchSeries series;
    series.append(contact(), {{8, {{.id = 4, .camera_mm = {3.0, 0.0, 0.0}}}}});
    series.append(contact(), {});
    series.append(contact(), {{9, {{.id = 4, .camera_mm = {5.0, 0.0, 0.0}}}}});
    const TouchScore score = score_touches(series.truth(), series.log());
    EXPECT_EQ(score.frames, 30);
    EXPECT_EQ(score.all.contacts, 3);
    EXPECT_EQ(score.all.found, 2);
    EXPECT_EQ(score.position_mm, (std::vector<double>{3.0, 5.0}));
}

TEST(TouchSeries, TheSameIdInTwoSequencesIsTwoTouches) {
    TouchSeries series;
    const TouchLog far{{0, {{.id = 1, .camera_mm = {300.0, 0.0, 0.0}}}}};
    series.append(contact(), far);
    series.append(contact(), far);
    EXPECT_EQ(score_touches(series.truth(), series.log()).spurious_ids, 2);
}

}  // namespace
}  // namespace touchstone
