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

/// A depth stream of two pictures, with its list.
inline std::string small_recording() {
    using u32 = std::uint32_t;
    using u64 = std::uint64_t;
    const std::string start =
        "NI10" + numbers(std::uint8_t{1}, std::uint8_t{0}, std::uint16_t{1}, u32{0}, u64{66'666}, u32{0});
    const std::string rest =
        record(3, 0, text("oniMirror") + numbers(u32{8}, u64{0})) +
        record(4, 0, text("xnZPD") + numbers(u32{8}, 120.0)) + record(5, 0, text("Type") + text("Depth")) +
        record(6, 0, text("oniVideoMode") + numbers(u32{16}, u32{100}, u32{4}, u32{3}, u32{30})) +
        record(9, 0, "") + record(8, 0, numbers(u32{2}, u64{66'666})) +
        record(10, 0, numbers(u64{33'333}, u32{1}), std::string(24, '\1')) +
        record(10, 0, numbers(u64{66'666}, u32{2}), std::string(24, '\2')) + record(11, 0xffffffff, "");
    const std::string depth =
        text("Depth") + numbers(u32{2}) + "NONE" + numbers(u32{2}, u64{33'333}, u64{66'666});
    const u64 table = start.size() + 28 + depth.size() + 8 + rest.size();
    return start + record(13, 0, depth + numbers(table)) + rest + record(14, 0, "", std::string(60, '\0'));
}

}  // namespace touchstone::test
