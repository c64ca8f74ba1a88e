#include "tests/fuzz/mutation.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

namespace touchstone::fuzz {
namespace {

constexpr std::size_t largest = 1 << 18;
constexpr std::array<std::uint64_t, 14> odd_numbers{
    0,       1,          2,          0x7f,       0xff,       0x7fff,     0xffff,
    0x10000, 0x7fffffff, 0x80000000, 0xfffffffe, 0xffffffff, ~0ULL >> 1, ~0ULL};
constexpr std::array<std::string_view, 14> odd_words{"-1",         "1e999",
                                                     "nan",        "inf",
                                                     "-0",         "99999999999999999999",
                                                     "0x7fffffff", "0.0000000000000000000000001",
                                                     "[[[[[[[[",   "\"\"\"",
                                                     "{}",         "\\u0000",
                                                     "true",       "%s%n"};

class Mutation {
  public:
    Mutation(const std::vector<std::string>& seeds, std::mt19937& random)
        : seeds_(seeds), random_(random), bytes_(any_seed()) {}

    void step() {
        switch (below(12)) {
            case 0:
                return flip_bit();
            case 1:
            case 2:
                return set_number();
            case 3:
                return cut_out();
            case 4:
                return repeat_piece();
            case 5:
                return insert_noise();
            case 6:
                return splice();
            case 7:
                bytes_.resize(below(bytes_.size() + 1));
                return;
            case 8:
                return replace_number_word();
            case 9:
                bytes_.insert(below(bytes_.size() + 1), odd_words[below(odd_words.size())]);
                return;
            case 10:
                return change_number();
            default:
                return set_byte();
        }
    }
    std::string take() {
        if (bytes_.size() > largest) bytes_.resize(largest);
        return std::move(bytes_);
    }

  private:
    /// 0 to count - 1; 0 for none.
    std::size_t below(std::size_t count) { return count == 0 ? 0 : random_() % count; }
    const std::string& any_seed() { return seeds_[below(seeds_.size())]; }
    /// Headers are worth more than what follows them.
    std::size_t place() {
        return below(2) == 0 ? below(std::min<std::size_t>(bytes_.size(), 96)) : below(bytes_.size());
    }

    void flip_bit() {
        if (bytes_.empty()) return;
        char& byte = bytes_[place()];
        byte = static_cast<char>(byte ^ (1 << below(8)));
    }
    void set_byte() {
        if (!bytes_.empty()) bytes_[place()] = static_cast<char>(random_());
    }
    void put(std::size_t at, std::uint64_t value, std::size_t width, bool big_endian) {
        for (std::size_t i = 0; i < width && at + i < bytes_.size(); ++i)
            bytes_[at + i] = static_cast<char>(value >> 8 * (big_endian ? width - 1 - i : i));
    }
    void set_number() {
        const std::size_t width = std::size_t{1} << below(4);
        put(place(), odd_numbers[below(odd_numbers.size())], width, below(2) == 0);
    }
    /// By a little.
    void change_number() {
        const std::size_t at = place();
        if (at + 4 > bytes_.size()) return;
        std::uint32_t value = 0;
        for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<std::uint8_t>(bytes_[at + i]);
        put(at, value + static_cast<std::uint32_t>(below(9)) - 4u, 4, false);
    }
    void cut_out() {
        const std::size_t at = place();
        bytes_.erase(at, 1 + below(std::min<std::size_t>(bytes_.size() - at, 64)));
    }
    void repeat_piece() {
        const std::size_t at = place();
        const std::string piece = bytes_.substr(at, 1 + below(200));
        for (std::size_t i = below(below(8) == 0 ? 200 : 4); i > 0; --i) bytes_.insert(at, piece);
    }
    void insert_noise() {
        std::string noise(1 + below(20), '\0');
        for (char& byte : noise) byte = static_cast<char>(random_());
        bytes_.insert(below(bytes_.size() + 1), noise);
    }
    void splice() {
        const std::string& other = any_seed();
        bytes_ = bytes_.substr(0, below(bytes_.size() + 1)) + other.substr(below(other.size() + 1));
    }
    /// Of a text.
    void replace_number_word() {
        constexpr const char* digits = "0123456789";
        const std::size_t begin = bytes_.find_first_of(digits, place());
        if (begin == std::string::npos) return;
        const std::size_t end = std::min(bytes_.find_first_not_of(digits, begin), bytes_.size());
        bytes_.replace(begin, end - begin, odd_words[below(odd_words.size())]);
    }

    const std::vector<std::string>& seeds_;
    std::mt19937& random_;
    std::string bytes_;
};

}  // namespace

std::string mutated(const std::vector<std::string>& seeds, std::mt19937& random) {
    Mutation mutation(seeds, random);
    for (unsigned steps = 1 + random() % 4; steps > 0; --steps) mutation.step();
    return mutation.take();
}

}  // namespace touchstone::fuzz
