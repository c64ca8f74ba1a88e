// fuzz_READER [--count N] [--seed N] [--write-seeds DIR] [FILE...]: the reader takes N malformed inputs, or
// the files, and answers each. Ends with 0 where it did not crash, hang, leak or take absurd memory.
#include <CLI/CLI.hpp>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include "tests/fuzz/mutation.hpp"
#include "tests/fuzz/reader.hpp"

namespace touchstone::fuzz {
namespace {

constexpr unsigned longest_s = 10;
constexpr std::size_t most_memory = std::size_t{2} << 30, most_growth = 1 << 20;

// How clang tells; GCC defines macros.
#ifndef __has_feature
#define __has_feature(feature) 0
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || __has_feature(address_sanitizer) || \
    __has_feature(thread_sanitizer)
constexpr bool is_watched_by_sanitizer = true;
#else
constexpr bool is_watched_by_sanitizer = false;
#endif

std::string current;

/// Keeps the input that brought the reader down, for a look at it.
void keep_input(int signal) {
    std::FILE* const file = std::fopen("fuzz-input", "wb");
    if (file != nullptr) {
        std::fwrite(current.data(), 1, current.size(), file);
        std::fclose(file);
    }
    std::fprintf(stderr, "signal %d; the input is in ./fuzz-input\n", signal);
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

void take(std::string input) {
    current = std::move(input);
    alarm(longest_s);
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(current.data()), current.size());
    alarm(0);
}

void limit_memory() {
    if (is_watched_by_sanitizer) return;
    const rlimit limit{most_memory, most_memory};
    setrlimit(RLIMIT_AS, &limit);
}

int take_many(int count, unsigned seed) {
    const std::vector<std::string> all = seeds();
    for (const std::string& known : all) take(known);
    std::mt19937 random(seed);
    std::size_t half_way = 0;
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < count; ++i) {
        if (i == count / 2) half_way = mallinfo2().uordblks;
        take(mutated(all, random));
    }
    current = {};
    const std::size_t now = mallinfo2().uordblks;
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    std::printf("%d malformed inputs in %.1f s\n", count, taken.count());
    if (is_watched_by_sanitizer || now < half_way + most_growth) return 0;
    std::fprintf(stderr, "%zu bytes are not given back\n", now - half_way);
    return 1;
}

void write_seeds(const std::string& folder) {
    int number = 0;
    for (const std::string& seed : seeds())
        std::ofstream(folder + "/seed-" + std::to_string(number++), std::ios::binary) << seed;
}

}  // namespace
}  // namespace touchstone::fuzz

int main(int argc, char** argv) {
    using namespace touchstone::fuzz;
    CLI::App app("Gives a reader malformed inputs");
    int count = 10'000;
    unsigned seed = 1;
    std::string seed_folder;
    std::vector<std::string> files;
    app.add_option("--count", count, "so many");
    app.add_option("--seed", seed, "of the random numbers");
    app.add_option("--write-seeds", seed_folder, "folder for what libFuzzer begins with");
    app.add_option("files", files, "inputs to be taken instead");
    CLI11_PARSE(app, argc, argv);
    for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGALRM}) std::signal(signal, keep_input);
    limit_memory();
    if (!seed_folder.empty()) {
        write_seeds(seed_folder);
        return 0;
    }
    for (const std::string& name : files) {
        std::ifstream file(name, std::ios::binary);
        take({std::istreambuf_iterator<char>(file), {}});
    }
    return files.empty() ? take_many(count, seed) : 0;
}
