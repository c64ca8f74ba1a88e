#include "platform/system/failure_note.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>

#include "platform/system/atomic_file.hpp"
#include "platform/system/error.hpp"

namespace touchstone {

namespace {

/// The first of the unit's folders.
std::optional<std::filesystem::path> note_file() {
    const char* folders = std::getenv("STATE_DIRECTORY");
    if (folders == nullptr || *folders == '\0') return std::nullopt;
    const std::string all = folders;
    return std::filesystem::path(all.substr(0, all.find(':'))) / "last-failure";
}

}  // namespace

void keep_failure(const std::string& reason) {
    const auto file = note_file();
    if (!file) return;
    try {
        write_file_atomically(*file, reason + "\n");
    } catch (const Error&) {
        // The reason itself is said elsewhere.
    }
}

void forget_failure() {
    std::error_code none;
    if (const auto file = note_file()) std::filesystem::remove(*file, none);
}

std::string kept_failure() {
    const auto file = note_file();
    if (!file) return {};
    std::ifstream stream(*file);
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    while (!text.empty() && text.back() == '\n') text.pop_back();
    return text;
}

}  // namespace touchstone
