#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "platform/system/error.hpp"

namespace touchstone {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

/// Numbers as bytes, little endian, without gaps.
class ByteWriter {
  public:
    template <class Number>
    requires std::is_arithmetic_v<Number>
    void put(Number value) { bytes_.append(reinterpret_cast<const char*>(&value), sizeof value); }
    void put_bytes(std::span<const std::uint8_t> bytes) {
        bytes_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    }
    /// The lowest byte of all values, then the second, ...: alike bytes side by side compress better.
    template <class Word>
    requires(sizeof(Word) == 4) void put_planes(std::span<const Word> words) {
        bytes_.reserve(bytes_.size() + 4 * words.size());
        for (int shift = 0; shift < 32; shift += 8) {
            for (const Word word : words)
                bytes_.push_back(static_cast<char>(static_cast<std::uint32_t>(word) >> shift));
        }
    }
    std::string take() { return std::move(bytes_); }

  private:
    std::string bytes_;
};

/// The same numbers again. Throws Error{bad_data} at the end of the bytes, before memory is taken.
class ByteReader {
  public:
    explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

    template <class Number>
    requires std::is_arithmetic_v<Number> Number get() {
        Number value;
        std::memcpy(&value, take(sizeof value).data(), sizeof value);
        return value;
    }
    void get_bytes(std::span<std::uint8_t> bytes) {
        std::memcpy(bytes.data(), take(bytes.size()).data(), bytes.size());
    }
    template <class Word>
    requires(sizeof(Word) == 4) std::vector<Word> get_planes(std::size_t count) {
        const std::string_view planes = take(4 * count);
        std::vector<Word> words(count);
        for (std::size_t i = 0; i < count; ++i) {
            std::uint32_t word = 0;
            for (std::size_t plane = 4; plane-- > 0;)
                word = word << 8 | static_cast<std::uint8_t>(planes[plane * count + i]);
            words[i] = static_cast<Word>(word);
        }
        return words;
    }
    std::size_t remaining() const { return rest_.size(); }

  private:
    std::string_view take(std::size_t size) {
        if (size > rest_.size()) throw Error(ExitStatus::bad_data, "it ends too early");
        const std::string_view taken = rest_.substr(0, size);
        rest_.remove_prefix(size);
        return taken;
    }

    std::string_view rest_;
};

}  // namespace touchstone
