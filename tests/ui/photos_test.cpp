// Photos: what gestures do to them, how they move on, what is seen.
#include "ui/scenes/photos.hpp"

#include "scene_fixture.hpp"

namespace touchstone {
namespace {

using Eigen::AlignedBox2f;
using Eigen::Vector2f;

const AlignedBox2f room(Vector2f(0.f, 0.f), Vector2f(640.f, 480.f));

Gesture on(int target, std::variant<Tap, DoubleTap, Hold, Drag, Swipe, Transform> what) {
    Gesture gesture;
    gesture.target = target;
    gesture.what = std::move(what);
    return gesture;
}

Drag drag(GesturePhase phase, const Vector2f& delta_px) {
    Drag dragged;
    dragged.phase = phase;
    dragged.delta_px = delta_px;
    return dragged;
}

Swipe thrown(const Vector2f& velocity_px_s) {
    Swipe swipe;
    swipe.velocity_px_s = velocity_px_s;
    return swipe;
}

const PhotoCard& card(const PhotoTable& table, int id) {
    return *std::ranges::find(table.cards(), id, &PhotoCard::id);
}

class PhotoTableTest : public testing::Test {
  protected:
    PhotoTableTest() {
        table_.set_room(SurfaceRoom(room), 1.7f);
        for (int i = 0; i < 6; ++i) table_.add(1.5f, 6);
    }
    void pass(float seconds) {
        for (int i = 0; i < static_cast<int>(60.f * seconds); ++i) table_.update(1.f / 60.f);
    }
    PhotoTable table_;
};

TEST_F(PhotoTableTest, TheyLieScatteredAllInTheRoomNoneUponAnothersMiddle) {
    for (const PhotoCard& a : table_.cards()) {
        EXPECT_TRUE(room.contains(a.center_px));
        EXPECT_NE(a.rotation_rad, 0.f);
        for (const PhotoCard& b : table_.cards())
            EXPECT_TRUE(a.id == b.id || (a.center_px - b.center_px).norm() > 80.f);
    }
}

/// Each corner of each photo, in an area whose far side is seen narrower.
TEST(PhotoTable, InANarrowAreaAllOfEachPhotoLiesInside) {
    const std::array<Vector2f, 4> corners{Vector2f(140.f, 40.f), Vector2f(350.f, 40.f),
                                          Vector2f(350.f, 440.f), Vector2f(20.f, 440.f)};
    const SurfaceRoom narrow(corners, room);
    for (const int count : {1, 3, 6, 24}) {
        PhotoTable table;
        table.set_room(narrow, 1.7f);
        for (int i = 0; i < count; ++i) table.add(i % 2 == 0 ? 1.5f : 0.7f, count);
        for (const PhotoCard& photo : table.cards()) {
            const Vector2f half = photo.half_box_px();
            for (const float side : {-1.f, 1.f}) {
                const auto span = narrow.span_px(photo.center_px.y() + 0.999f * side * half.y());
                ASSERT_TRUE(span) << "photo " << photo.id << " of " << count;
                EXPECT_GE(photo.center_px.x() - half.x(), span->x() - 0.5f) << photo.id << " of " << count;
                EXPECT_LE(photo.center_px.x() + half.x(), span->y() + 0.5f) << photo.id << " of " << count;
            }
        }
        table.update(0.f);
        EXPECT_FALSE(table.update(0.1f)) << "none is pushed anywhere";
    }
}

TEST_F(PhotoTableTest, ADragKeepsThePhotoUnderTheFinger) {
    const Vector2f before = card(table_, 2).center_px;
    table_.on_gesture(on(2, drag(GesturePhase::begin, {12.f, 5.f})));
    table_.on_gesture(on(2, drag(GesturePhase::change, {3.f, -1.f})));
    EXPECT_TRUE(card(table_, 2).held);
    pass(0.5f);
    EXPECT_EQ(card(table_, 2).center_px, Vector2f(before + Vector2f(15.f, 4.f)));
    table_.on_gesture(on(2, drag(GesturePhase::end, Vector2f(0.f, 0.f))));
    EXPECT_FALSE(card(table_, 2).held);
}

TEST_F(PhotoTableTest, TwoFingersTurnAndStretchAboutTheirMiddle) {
    Transform transform;
    transform.delta.center_px = card(table_, 0).center_px + Vector2f(20.f, 0.f);
    transform.delta.rotation_rad = 0.5f;
    transform.delta.scale = 1.4f;
    const PhotoCard before = card(table_, 0);
    table_.on_gesture(on(0, transform));
    const PhotoCard& after = card(table_, 0);
    EXPECT_FLOAT_EQ(after.scale, 1.4f);
    EXPECT_FLOAT_EQ(after.rotation_rad, before.rotation_rad + 0.5f);
    EXPECT_LT((after.center_px - transform.delta(before.center_px)).norm(), 1e-3f);
    for (int i = 0; i < 50; ++i) table_.on_gesture(on(0, transform));
    EXPECT_LE(card(table_, 0).scale, 3.f) << "not without end";
}

TEST_F(PhotoTableTest, AThrownPhotoSlowsDownAndStaysOnTheTable) {
    for (const Vector2f& velocity :
         {Vector2f(4000.f, 0.f), Vector2f(-3000.f, 2500.f), Vector2f(0.f, -6000.f)}) {
        table_.on_gesture(on(1, thrown(velocity)));
        const Vector2f before = card(table_, 1).center_px;
        pass(0.05f);
        EXPECT_GT((card(table_, 1).center_px - before).dot(velocity), 0.f);
        pass(5.f);
        EXPECT_TRUE(room.contains(card(table_, 1).center_px));
        EXPECT_EQ(card(table_, 1).velocity_px_s, Vector2f(0.f, 0.f));
        EXPECT_FALSE(table_.update(1.f / 60.f)) << "nothing moves any more";
    }
}

TEST_F(PhotoTableTest, TheTouchedOneComesToTheTop) {
    table_.grasp(0);
    EXPECT_EQ(table_.cards().back().id, 0);
    table_.grasp(3);
    EXPECT_EQ(table_.cards().back().id, 3);
    EXPECT_EQ(table_.hit(card(table_, 3).center_px), 3);
}

TEST_F(PhotoTableTest, ADoubleTapStraightensAndEnlargesAndAnotherMakesItSmall) {
    table_.on_gesture(on(4, DoubleTap{}));
    pass(2.f);
    EXPECT_EQ(card(table_, 4).rotation_rad, 0.f);
    EXPECT_GT(card(table_, 4).scale, 1.3f);
    const Vector2f half = card(table_, 4).half_box_px();
    EXPECT_TRUE(
        room.contains(AlignedBox2f(card(table_, 4).center_px - half, card(table_, 4).center_px + half)));
    table_.on_gesture(on(4, DoubleTap{}));
    pass(2.f);
    EXPECT_FLOAT_EQ(card(table_, 4).scale, 1.f);
}

class PhotosSceneTest : public SceneFixture {
  protected:
    /// Two pictures, red and blue, on their grid places.
    void open_two() {
        PresenterConfig config;
        config.menu = false;
        config.scenes.open_photos = [] {
            const auto next = [left = 2]() mutable -> std::optional<Picture> {
                if (left-- <= 0) return std::nullopt;
                Picture picture{30, 20, {}};
                for (int i = 0; i < 600; ++i) {
                    const bool red = left == 1;
                    picture.rgba.insert(picture.rgba.end(), {static_cast<std::uint8_t>(red ? 220 : 20), 30,
                                                             static_cast<std::uint8_t>(red ? 30 : 220), 255});
                }
                return picture;
            };
            return PictureStream{2, next};
        };
        open("photos", config);
        pass(0.3f);
    }
    /// The middle of all pixels of the view that are as red, or as blue, as the picture.
    Vector2f middle_of(bool red) {
        const Picture shown = present();
        Vector2f sum(0.f, 0.f);
        float count = 0.f;
        for (int y = 0; y < 240; ++y)
            for (int x = 0; x < 320; ++x) {
                const Vector2f at(static_cast<float>(x), static_cast<float>(y));
                const style::Color color = color_at_view(shown, at);
                const int high = red ? color.r : color.b, low = red ? color.b : color.r;
                if (high < 180 || low > 60) continue;
                sum += at;
                count += 1.f;
            }
        EXPECT_GT(count, 100.f);
        return sum / std::max(count, 1.f);
    }
};

TEST_F(PhotosSceneTest, PicturesOfTheFolderAreSeenAndFollowAFinger) {
    open_two();
    const Vector2f red = middle_of(true), blue = middle_of(false);
    present({touch(56, TouchPhase::down, red)});
    for (int i = 1; i <= 20; ++i)
        present({touch(56, TouchPhase::move, red + Vector2f(0.f, 1.5f * static_cast<float>(i)))});
    const Vector2f dragged = middle_of(true);
    EXPECT_NEAR((dragged - red).y(), 30.f, 2.5f);
    EXPECT_NEAR((dragged - red).x(), 0.f, 2.5f);
    EXPECT_LT((middle_of(false) - blue).norm(), 1.f) << "the other one stays";
}

TEST_F(PhotosSceneTest, TwoPeopleAtTwoPicturesAtOnce) {
    open_two();
    const Vector2f red = middle_of(true), blue = middle_of(false);
    present({touch(56, TouchPhase::down, red), touch(60, TouchPhase::down, blue)});
    for (int i = 1; i <= 20; ++i) {
        const Vector2f moved(0.f, 1.5f * static_cast<float>(i));
        present({touch(56, TouchPhase::move, red + moved), touch(60, TouchPhase::move, blue - moved)});
    }
    EXPECT_NEAR((middle_of(true) - red).y(), 30.f, 2.5f);
    EXPECT_NEAR((middle_of(false) - blue).y(), -30.f, 2.5f);
}

TEST_F(PhotosSceneTest, WithoutPicturesItShowsItsOwnAndSaysWhereToPutThem) {
    PresenterConfig config;
    config.scenes.photo_folder = "/srv/pictures";
    config.scenes.open_photos = [] { return PictureStream{0, [] { return std::optional<Picture>(); }}; };
    open("photos", config);
    pass(0.3f);
    const Picture shown = present();
    int coloured = 0;
    for (int y = 0; y < 240; ++y)
        for (int x = 0; x < 320; ++x) {
            const style::Color c = color_at_view(shown, {static_cast<float>(x), static_cast<float>(y)});
            coloured += std::max({c.r, c.g, c.b}) - std::min({c.r, c.g, c.b}) > 40 ? 1 : 0;
        }
    EXPECT_GT(coloured, 3000);
}

}  // namespace
}  // namespace touchstone
