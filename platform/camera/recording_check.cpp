#include "platform/camera/recording_check.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <map>
#include <optional>
#include <string_view>
#include <tuple>
#include <vector>

#include "platform/system/byte_stream.hpp"
#include "platform/system/error.hpp"

namespace touchstone {
namespace {

// The limits of OpenNI 2.2's player, and what its tables shall need at most.
constexpr std::uint64_t largest_record_bytes = 1600 * 1200 * 3;
constexpr std::uint32_t most_nodes = 32, most_frames = 10'000'000;
constexpr std::size_t longest_name = 79;
constexpr std::uint32_t record_magic = 0x0052494E;
constexpr std::size_t file_header_bytes = 24;

enum RecordType : std::uint32_t {
    node_added_1_0_0_4 = 2,
    int_property,
    real_property,
    string_property,
    general_property,
    node_removed,
    node_data_begin,
    node_state_ready,
    new_data,
    end,
    node_added_1_0_0_5,
    node_added,
    seek_table,
};
constexpr std::uint32_t depth_node = 2, image_node = 3, ir_node = 5;

struct RecordHeader {
    std::uint32_t magic, type, node, fields_bytes, payload_bytes;
    std::uint64_t at;
};

struct Node {
    bool is_generator = false, is_ready = false;
    std::uint32_t frames = 0;
};

[[noreturn]] void refuse(const std::string& why) { throw Error(ExitStatus::bad_data, why); }

bool is_property(std::uint32_t type) { return type >= int_property && type <= general_property; }
bool adds_node(std::uint32_t type) {
    return type == node_added || type == node_added_1_0_0_5 || type == node_added_1_0_0_4;
}

std::uint32_t code(std::string_view four) {
    std::uint32_t value;
    std::memcpy(&value, four.data(), sizeof value);
    return value;
}

bool is_known_codec(std::uint32_t codec) {
    constexpr std::string_view known[] = {"NONE", "16zP", "16zT", "Im8z", "JPEG"};
    return std::ranges::any_of(known, [&](std::string_view name) { return code(name) == codec; });
}

/// A text with its size before it and a zero at its end.
std::string_view take_text(ByteReader& fields, std::string_view all, std::size_t longest) {
    const auto size = fields.get<std::uint32_t>();
    if (size == 0 || size > fields.remaining() || size - 1 > longest) refuse("a name in it is too long");
    const std::string_view text = all.substr(all.size() - fields.remaining(), size);
    for (std::uint32_t i = 0; i < size; ++i) (void)fields.get<char>();
    if (text.find('\0') != size - 1) refuse("a name in it has no end");
    return text.substr(0, size - 1);
}

class RecordWalk {
  public:
    explicit RecordWalk(const std::string& path)
        : file_(path, std::ios::binary), size_(std::filesystem::file_size(path)) {}

    void walk() {
        read_file_header();
        std::uint64_t at = file_header_bytes;
        for (;;) {
            const RecordHeader record = read_header(at);
            const std::string fields = read(at + header_bytes_, record.fields_bytes - header_bytes_);
            if (record.type == end) break;
            check(record, fields);
            at += record.fields_bytes + record.payload_bytes;
        }
        if (!has_data_) refuse("it has no pictures");
        for (const auto& [place, node] : seek_tables_) check_seek_table(place, node);
    }

  private:
    std::string read(std::uint64_t at, std::uint64_t count) {
        if (at > size_ || count > size_ - at) refuse("it is cut short");
        std::string bytes(count, '\0');
        file_.seekg(static_cast<std::streamoff>(at));
        if (!file_.read(bytes.data(), static_cast<std::streamsize>(count))) refuse("it cannot be read");
        return bytes;
    }

    void read_file_header() {
        const std::string header = read(0, std::min<std::uint64_t>(size_, file_header_bytes));
        if (!header.starts_with("NI10")) refuse("it is not an OpenNI recording");
        if (header.size() < file_header_bytes) refuse("it is cut short");
        ByteReader in(std::string_view(header).substr(4));
        const auto major = in.get<std::uint8_t>(), minor = in.get<std::uint8_t>();
        const auto maintenance = in.get<std::uint16_t>();
        const std::tuple version{major, minor, maintenance, in.get<std::uint32_t>()};
        if (version < std::tuple{1, 0, 0, 4u} || version > std::tuple{1, 0, 1, 0u})
            refuse("it is of a version that OpenNI 2 does not play");
        header_bytes_ = version < std::tuple{1, 0, 1, 0u} ? 24 : 28;
        max_time_us_ = in.get<std::uint64_t>();
        nodes_ = in.get<std::uint32_t>();
        if (nodes_ >= most_nodes) refuse("it claims more streams than there can be");
    }

    RecordHeader read_header(std::uint64_t at) {
        const std::string bytes = read(at, header_bytes_);
        ByteReader in(bytes);
        RecordHeader header{};
        for (std::uint32_t* value :
             {&header.magic, &header.type, &header.node, &header.fields_bytes, &header.payload_bytes})
            *value = in.get<std::uint32_t>();
        header.at = at;
        if (header.magic != record_magic || header.type < node_added_1_0_0_4 || header.type > seek_table)
            refuse("what should be a record is none");
        const std::uint64_t record_bytes = std::uint64_t{header.fields_bytes} + header.payload_bytes;
        if (header.fields_bytes < header_bytes_ || record_bytes > largest_record_bytes)
            refuse("a record has a size that none can have");
        if (record_bytes > size_ - at) refuse("it is cut short");
        if (header.payload_bytes > 0 && header.type != new_data && header.type != seek_table)
            refuse("a record holds what it cannot");
        return header;
    }

    void check(const RecordHeader& record, std::string_view fields) {
        if (record.node > nodes_) refuse("a record is of a stream that there is not");
        ByteReader in(fields);
        if (adds_node(record.type)) return check_new_node(record, in, fields);
        // The player reads lists of pictures only where their streams say that they lie.
        if (record.type == seek_table) return;
        const auto known = known_.find(record.node);
        if (known == known_.end()) refuse("a record is of a stream that there is not yet");
        Node& node = known->second;
        if (is_property(record.type)) check_property(record.type, in, fields);
        if (record.type == node_removed) known_.erase(known);
        if (record.type == node_state_ready) node.is_ready = true;
        if (record.type == node_data_begin) {
            has_data_ = true;
            if (!node.is_generator || !node.is_ready) refuse("pictures begin where there are none");
            (void)in.get<std::uint32_t>(), (void)in.get<std::uint64_t>();
        }
        if (record.type == new_data) {
            if (!node.is_generator || !node.is_ready || !has_data_) refuse("a picture comes before its time");
            const auto time_us = in.get<std::uint64_t>();
            if (time_us > max_time_us_ || in.get<std::uint32_t>() > node.frames || record.payload_bytes == 0)
                refuse("a picture is of a time after its end");
        }
    }

    void check_new_node(const RecordHeader& record, ByteReader& in, std::string_view fields) {
        if (known_.contains(record.node)) refuse("it has the same stream twice");
        (void)take_text(in, fields, longest_name);
        const auto type = in.get<std::uint32_t>();
        Node node;
        node.is_generator = type == depth_node || type == image_node || type == ir_node;
        if (!is_known_codec(in.get<std::uint32_t>())) refuse("its pictures are packed in an unknown way");
        node.frames = most_frames;
        if (record.type != node_added_1_0_0_4) {
            node.frames = in.get<std::uint32_t>();
            (void)in.get<std::uint64_t>(), (void)in.get<std::uint64_t>();
        }
        if (node.frames > most_frames) refuse("it claims more pictures than there can be");
        if (record.type == node_added) {
            const std::uint64_t place =
                header_bytes_ == 24 ? in.get<std::uint32_t>() : in.get<std::uint64_t>();
            if (place != 0 && node.frames > 0) seek_tables_[place] = record.node;
        }
        all_[record.node] = known_[record.node] = node;
    }

    void check_property(std::uint32_t type, ByteReader& in, std::string_view fields) {
        const std::string_view name = take_text(in, fields, fields.size());
        const auto bytes = in.get<std::uint32_t>();
        if (bytes != in.remaining()) refuse("a property has a size that it cannot have");
        const std::string_view value = fields.substr(fields.size() - bytes);
        if ((type == int_property || type == real_property) && bytes != 8)
            refuse("a number has a size that none can have");
        if (type == string_property && (bytes == 0 || value.find('\0') != bytes - 1))
            refuse("a text in it has no end");
        if (type == general_property && bytes < least_bytes(name)) refuse("a property is cut short");
    }

    /// Of properties that the player takes for structures without a look at their size.
    static std::size_t least_bytes(std::string_view name) {
        constexpr std::pair<std::string_view, std::size_t> known[] = {{"xnMapOutputMode", 12},
                                                                      {"xnFieldOfView", 16},
                                                                      {"xnCropping", 10},
                                                                      {"xnVideoMode", 12},
                                                                      {"oniVideoMode", 16},
                                                                      {"xnRealWorldTranslationData", 24},
                                                                      {"ZPD", 8},
                                                                      {"xnAlternativeViewPoint", 0}};
        for (const auto& [structure, bytes] : known)
            if (name == structure) return bytes;
        return 0;
    }

    void check_seek_table(std::uint64_t place, std::uint32_t node) {
        const RecordHeader table = read_header(place);
        const std::uint64_t entry_bytes = header_bytes_ == 24 ? 16 : 20;
        if (table.type != seek_table || table.node != node ||
            table.payload_bytes != (std::uint64_t{all_.at(node).frames} + 1) * entry_bytes)
            refuse("its list of pictures is none");
    }

    std::ifstream file_;
    std::uint64_t size_, max_time_us_ = 0;
    std::size_t header_bytes_ = 0;
    std::uint32_t nodes_ = 0;
    std::map<std::uint32_t, Node> known_, all_;
    std::map<std::uint64_t, std::uint32_t> seek_tables_;
    bool has_data_ = false;
};

}  // namespace

void check_recording(const std::string& path) {
    std::error_code code;
    if (!std::filesystem::exists(path, code))
        throw Error(ExitStatus::no_input, fmt::format("no recording {}", path));
    if (!std::filesystem::is_regular_file(path, code) || !std::ifstream(path))
        throw Error(ExitStatus::no_input, fmt::format("cannot open recording {}", path));
    try {
        RecordWalk(path).walk();
    } catch (const Error& error) {
        throw Error(error.status(), fmt::format("recording {}: {}; record it anew", path, error.what()));
    }
}

}  // namespace touchstone
