#pragma once

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <unistd.h>

#include "platform/system/error.hpp"
#include "platform/system/log.hpp"
#include "tests/fuzz/reader.hpp"

namespace touchstone::fuzz {

inline std::string_view text_of(const std::uint8_t* bytes, std::size_t size) {
    return {reinterpret_cast<const char*>(bytes), size};
}

/// An input whose first byte says what the rest is.
inline std::string marked(char kind, std::string_view rest) {
    std::string input(1, kind);
    return input.append(rest);
}

/// A folder for readers that open files by name, in memory unless TMPDIR says otherwise. libFuzzer ends
/// without the destructors: who starts it takes the folder away.
class MemoryFolder {
  public:
    MemoryFolder() {
        const char* const parent = std::getenv("TMPDIR");
        std::string pattern(parent == nullptr ? "/dev/shm" : parent);
        pattern.append("/touchstone-fuzz-XXXXXX");
        if (mkdtemp(pattern.data()) == nullptr) std::abort();
        path_ = pattern;
        set_log_level(LogLevel::error);
    }
    ~MemoryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    MemoryFolder(const MemoryFolder&) = delete;
    MemoryFolder& operator=(const MemoryFolder&) = delete;

    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    std::filesystem::path put(const std::string& name, std::string_view bytes) const {
        std::FILE* const file = std::fopen((path_ / name).c_str(), "wb");
        if (file == nullptr) std::abort();
        std::fwrite(bytes.data(), 1, bytes.size(), file);
        std::fclose(file);
        return path_ / name;
    }
    std::string bytes(const std::string& name) const {
        std::ifstream file(path_ / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }

  private:
    std::filesystem::path path_;
};

/// Runs a reader, which takes its input or answers with an Error of one line. Anything else ends the process.
template <class Reader>
void must_answer(Reader read) {
    try {
        read();
    } catch (const Error& error) {
        const std::string_view line = error.what();
        if (line.empty() || line.find('\n') != std::string_view::npos) {
            std::fprintf(stderr, "not one line: %s\n", error.what());
            std::abort();
        }
    }
}

}  // namespace touchstone::fuzz
