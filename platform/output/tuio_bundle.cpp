#include "platform/output/tuio_bundle.hpp"

#include <algorithm>
#include <lo/lo.h>
#include <span>

namespace touchstone {
namespace {

const char* address_of(TuioProfile profile) {
    return profile == TuioProfile::cursors_2d ? "/tuio/2Dcur" : "/tuio/25Dcur";
}

lo_message message_about(const char* what) {
    lo_message message = lo_message_new();
    lo_message_add_string(message, what);
    return message;
}

lo_message source_message(const std::string& source) {
    lo_message message = message_about("source");
    lo_message_add_string(message, source.c_str());
    return message;
}

lo_message alive_message(const std::vector<std::int32_t>& sessions) {
    lo_message message = message_about("alive");
    for (const std::int32_t session : sessions) lo_message_add_int32(message, session);
    return message;
}

std::vector<float> numbers_of(const TuioCursor& cursor, TuioProfile profile) {
    if (profile == TuioProfile::cursors_2d)
        return {cursor.x, cursor.y, cursor.velocity_x, cursor.velocity_y, cursor.acceleration};
    return {cursor.x,          cursor.y,          cursor.z,           cursor.velocity_x,
            cursor.velocity_y, cursor.velocity_z, cursor.acceleration};
}

lo_message set_message(const TuioCursor& cursor, TuioProfile profile) {
    lo_message message = message_about("set");
    lo_message_add_int32(message, cursor.session);
    for (const float number : numbers_of(cursor, profile)) lo_message_add_float(message, number);
    return message;
}

lo_message fseq_message(std::int32_t fseq) {
    lo_message message = message_about("fseq");
    lo_message_add_int32(message, fseq);
    return message;
}

OscBundle part_of(const TuioBundle& state, std::span<const TuioCursor> cursors, TuioProfile profile,
                  const std::string& source) {
    const char* address = address_of(profile);
    OscBundle part(lo_bundle_new(LO_TT_IMMEDIATE));
    lo_bundle_add_message(part.get(), address, source_message(source));
    lo_bundle_add_message(part.get(), address, alive_message(state.alive));
    for (const TuioCursor& cursor : cursors)
        lo_bundle_add_message(part.get(), address, set_message(cursor, profile));
    lo_bundle_add_message(part.get(), address, fseq_message(state.fseq));
    return part;
}

}  // namespace

std::vector<OscBundle> osc_bundles(const TuioBundle& state, TuioProfile profile, const std::string& source,
                                   std::size_t largest) {
    const auto bytes_with = [&](std::span<const TuioCursor> cursors) {
        return lo_bundle_length(part_of(state, cursors, profile, source).get());
    };
    const std::size_t frame = bytes_with({});
    const std::size_t set = bytes_with(std::vector<TuioCursor>(1)) - frame;
    const std::size_t at_once = std::max<std::size_t>(1, (largest - std::min(largest, frame)) / set);
    std::vector<OscBundle> parts;
    std::span<const TuioCursor> left(state.cursors);
    do {
        const std::size_t count = std::min(at_once, left.size());
        parts.push_back(part_of(state, left.first(count), profile, source));
        left = left.subspan(count);
    } while (!left.empty());
    return parts;
}

}  // namespace touchstone
