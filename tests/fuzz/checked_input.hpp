#pragma once

#include <array>
#include <cstring>
#include <string>
#include <xxhash.h>

#include "platform/system/checked_file.hpp"
#include "tests/fuzz/support.hpp"

namespace touchstone::fuzz {

/// How an input stands for a checked file: its first byte says so.
enum class CheckedInput : char {
    content = 'c',  ///< what follows is packed and sealed as the program does it
    sealed = 's',   ///< what follows is the file, with a checksum that is right
    file = 'f',     ///< what follows is the file
};

inline std::string sealed(std::string file) {
    if (file.size() < checked_file_header_bytes) return file;
    XXH3_state_t* const state = XXH3_createState();
    XXH3_64bits_reset(state);
    XXH3_64bits_update(state, file.data(), 32);
    XXH3_64bits_update(state, file.data() + checked_file_header_bytes,
                       file.size() - checked_file_header_bytes);
    const std::uint64_t sum = XXH3_64bits_digest(state);
    XXH3_freeState(state);
    std::memcpy(file.data() + 32, &sum, 8);
    return file;
}

/// The kind and version of a file that the program wrote.
inline FileFormat format_of(std::string_view file) {
    FileFormat format{"sample", {}, 0, std::uint64_t{1} << 32};
    std::memcpy(format.magic.data(), file.data(), format.magic.size());
    std::memcpy(&format.version, file.data() + 8, 4);
    return format;
}

/// Seeds of all three kinds for a file that the program wrote.
inline std::vector<std::string> checked_seeds(const std::filesystem::path& written, const std::string& file) {
    const std::string content = read_checked_file(written, format_of(file));
    return {marked('c', content), marked('s', file), marked('f', file)};
}

/// Puts the file that an input stands for in its place.
inline void put_checked(const MemoryFolder& folder, const std::string& name, const FileFormat& format,
                        std::string_view input) {
    if (input.empty()) return;
    const std::string rest(input.substr(1));
    if (input[0] == static_cast<char>(CheckedInput::content))
        write_checked_cache(folder / name, format, rest);
    else
        folder.put(name, input[0] == static_cast<char>(CheckedInput::sealed) ? sealed(rest) : rest);
}

}  // namespace touchstone::fuzz
