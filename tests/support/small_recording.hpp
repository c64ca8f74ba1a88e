#pragma once

#include <cstdint>
#include <string>

#include "platform/system/byte_stream.hpp"

/// Records of an .oni file, as OpenNI 2.2 writes them.
namespace touchstone::test {

inline std::string record(std::uint32_t type, std::uint32_t node, const std::string& fields,
                          const std::string& payload = {}) {
    ByteWriter out;
    for (const std::uint32_t value :
         {0x0052494Eu, type, node, 28u + static_cast<std::uint32_t>(fields.size()),
          static_cast<std::uint32_t>(payload.size())})
        out.put(value);
    out.put(std::uint64_t{0});
    return out.take() + fields + payload;
}

inline std::string text(const std::string& words) {
    ByteWriter out;
    out.put(static_cast<std::uint32_t>(words.size() + 1));
    return out.take() + words + '\0';
}

template <class... Numbers>
std::string numbers(Numbers... values) {
    ByteWriter out;
    (out.put(values), ...);
    return out.take();
}

enum class ListAt { after_end, before_end };  ///< as OpenNI 1 and as OpenNI 2 write it

/// A depth stream of two pictures, with its list.
inline std::string small_recording(ListAt list_at = ListAt::before_end) {
    using u32 = std::uint32_t;
    using u64 = std::uint64_t;
    const std::string start =
        "NI10" + numbers(std::uint8_t{1}, std::uint8_t{0}, std::uint16_t{1}, u32{0}, u64{66'666}, u32{1});
    const std::string pictures =
        record(3, 1, text("oniMirror") + numbers(u32{8}, u64{0})) +
        record(4, 1, text("xnZPD") + numbers(u32{8}, 120.0)) + record(5, 1, text("Type") + text("Depth")) +
        record(6, 1, text("oniVideoMode") + numbers(u32{16}, u32{100}, u32{4}, u32{3}, u32{30})) +
        record(9, 1, "") + record(8, 1, numbers(u32{2}, u64{66'666})) +
        record(10, 1, numbers(u64{33'333}, u32{1}), std::string(24, '\1')) +
        record(10, 1, numbers(u64{66'666}, u32{2}), std::string(24, '\2'));
    const std::string removed = record(7, 1, ""), end = record(11, 0, "");
    const std::string list = record(14, 1, "", std::string(60, '\0'));
    const std::string rest = pictures + (list_at == ListAt::before_end ? removed : end);
    const std::string depth =
        text("Depth") + numbers(u32{2}) + "NONE" + numbers(u32{2}, u64{33'333}, u64{66'666});
    const u64 place = start.size() + 28 + depth.size() + 8 + rest.size();
    return start + record(13, 1, depth + numbers(place)) + rest + list +
           (list_at == ListAt::before_end ? end : "");
}

}  // namespace touchstone::test
