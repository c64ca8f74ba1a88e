#include "ui/painting.hpp"

#include <algorithm>
#include <cmath>

#include "platform/system/byte_stream.hpp"
#include "platform/system/error.hpp"

namespace touchstone {

namespace {

using Eigen::Vector3f;

constexpr float farthest_m = 100.f, widest_mm = 1000.f;

void put_stroke(ByteWriter& writer, const Stroke& stroke) {
    writer.put(stroke.color.packed());
    writer.put(stroke.width_mm);
    writer.put(static_cast<std::uint8_t>(stroke.erases));
    writer.put(static_cast<std::uint32_t>(stroke.points_g_m.size()));
    for (const Vector3f& point : stroke.points_g_m)
        for (const float value : {point.x(), point.y(), point.z()}) writer.put(value);
}

float checked(float value, float most) {
    if (!std::isfinite(value) || std::abs(value) > most)
        throw Error(ExitStatus::bad_data, "a number is out of range");
    return value;
}

Stroke get_stroke(ByteReader& reader) {
    Stroke stroke;
    const auto color = reader.get<std::uint32_t>();
    const auto channel = [color](int shift) { return static_cast<std::uint8_t>(color >> shift); };
    stroke.color = {channel(0), channel(8), channel(16), channel(24)};
    stroke.width_mm = checked(reader.get<float>(), widest_mm);
    stroke.erases = reader.get<std::uint8_t>() != 0;
    const auto count = reader.get<std::uint32_t>();
    if (count == 0 || count > reader.remaining() / sizeof(Vector3f))
        throw Error(ExitStatus::bad_data, "a stroke is damaged");
    stroke.points_g_m.resize(count);
    for (Vector3f& point : stroke.points_g_m)
        for (int axis = 0; axis < 3; ++axis) point[axis] = checked(reader.get<float>(), farthest_m);
    return stroke;
}

}  // namespace

Painting::Deed* Painting::find(int number) {
    const auto found = std::find_if(deeds_.rbegin(), deeds_.rend(),
                                    [number](const Deed& deed) { return deed.number == number; });
    return found == deeds_.rend() ? nullptr : &*found;
}

const Stroke* Painting::stroke(int number) const {
    const auto found = std::find_if(deeds_.rbegin(), deeds_.rend(),
                                    [number](const Deed& deed) { return deed.number == number; });
    return found == deeds_.rend() ? nullptr : &found->stroke;
}

int Painting::begin(style::Color color, float width_mm, bool erases, const Vector3f& point_g_m) {
    deeds_.push_back({++numbers_given_, false, false, {color, width_mm, erases, {point_g_m}}});
    ++points_;
    keep_to_limits();
    return numbers_given_;
}

bool Painting::extend(int number, const Vector3f& point_g_m) {
    Deed* const deed = find(number);
    if (deed == nullptr || deed->finished) return false;
    std::vector<Vector3f>& points = deed->stroke.points_g_m;
    if ((point_g_m - points.back()).norm() < least_step_m) return false;
    points.push_back(point_g_m);
    ++points_;
    keep_to_limits();
    return true;
}

void Painting::finish(int number) {
    if (Deed* const deed = find(number)) deed->finished = true;
}

bool Painting::can_undo() const {
    return std::any_of(deeds_.begin(), deeds_.end(), [](const Deed& deed) { return deed.finished; });
}

bool Painting::undo() {
    const auto last =
        std::find_if(deeds_.rbegin(), deeds_.rend(), [](const Deed& deed) { return deed.finished; });
    if (last == deeds_.rend()) return false;
    points_ -= last->stroke.points_g_m.size();
    deeds_.erase(std::next(last).base());
    ++redraws_;
    return true;
}

void Painting::clear() {
    if (is_empty()) return;
    for (Deed& deed : deeds_) deed.finished = true;
    Deed cleared;
    cleared.number = ++numbers_given_;
    cleared.is_clear = true;
    deeds_.push_back(std::move(cleared));
    ++redraws_;
    keep_to_limits();
}

std::vector<const Stroke*> Painting::visible() const {
    const auto last_clear =
        std::find_if(deeds_.rbegin(), deeds_.rend(), [](const Deed& deed) { return deed.is_clear; });
    std::vector<const Stroke*> strokes;
    for (auto deed = last_clear.base(); deed != deeds_.end(); ++deed) strokes.push_back(&deed->stroke);
    return strokes;
}

/// A tenth goes at once, for everything is drawn anew after it.
void Painting::keep_to_limits() {
    if (points_ <= limits_.points && deeds_.size() <= limits_.deeds) return;
    while (deeds_.size() > 1 && deeds_.front().finished &&
           (points_ > limits_.points - limits_.points / 10 ||
            deeds_.size() > limits_.deeds - limits_.deeds / 10)) {
        points_ -= deeds_.front().stroke.points_g_m.size();
        deeds_.pop_front();
        ++redraws_;
    }
}

void Painting::move(const RigidTransform& T_new_old) {
    for (Deed& deed : deeds_)
        for (Vector3f& point : deed.stroke.points_g_m) point = T_new_old * point;
    ++redraws_;
}

std::string Painting::bytes() const {
    ByteWriter writer;
    const auto count = std::count_if(deeds_.begin(), deeds_.end(), [](const Deed& d) { return d.finished; });
    writer.put(static_cast<std::uint32_t>(count));
    for (const Deed& deed : deeds_) {
        if (!deed.finished) continue;
        writer.put(static_cast<std::uint8_t>(deed.is_clear));
        if (!deed.is_clear) put_stroke(writer, deed.stroke);
    }
    return writer.take();
}

Painting Painting::from_bytes(std::string_view bytes, PaintingLimits limits) {
    ByteReader reader(bytes);
    Painting painting(limits);
    const auto count = reader.get<std::uint32_t>();
    for (std::uint32_t i = 0; i < count; ++i) {
        Deed deed;
        deed.number = ++painting.numbers_given_;
        deed.is_clear = reader.get<std::uint8_t>() != 0;
        if (!deed.is_clear) deed.stroke = get_stroke(reader);
        painting.points_ += deed.stroke.points_g_m.size();
        painting.deeds_.push_back(std::move(deed));
        painting.keep_to_limits();
    }
    if (reader.remaining() != 0) throw Error(ExitStatus::bad_data, "there are bytes after its end");
    return painting;
}

}  // namespace touchstone
