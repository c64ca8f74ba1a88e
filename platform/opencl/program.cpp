#include "platform/opencl/program.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <optional>
#include <regex>
#include <sstream>
#include <xxhash.h>

#include "platform/opencl/device_error.hpp"
#include "platform/system/checked_file.hpp"
#include "platform/system/log.hpp"

namespace touchstone {

namespace {

constexpr std::string_view build_flags = "-cl-std=CL1.2 -Werror ";
/// Drivers trust a binary as they trust code: a torn one must not reach them.
constexpr FileFormat binary_format{
    "compiled program", {'T', 'S', 'K', 'E', 'R', 'N', 'E', 'L'}, 1, std::uint64_t{1} << 28};

std::string join_sources(std::span<const ProgramSource> sources) {
    std::string text;
    for (const ProgramSource& source : sources) {
        text += "#line 1 \"" + std::string(source.path) + "\"\n" + std::string(source.text) + "\n";
    }
    return text;
}

std::filesystem::path binary_path(const Device& device, const std::string& text, const std::string& options) {
    const std::string key = device.fingerprint() + "|" + options + "|" + text;
    std::ostringstream name;
    name << std::hex << XXH3_64bits(key.data(), key.size()) << ".kernels";
    return device.cache_dir() / name.str();
}

std::string first_error(const std::string& log) {
    std::istringstream lines(log);
    for (std::string line; std::getline(lines, line);) {
        if (line.find("error:") != std::string::npos) return line;
    }
    return log;
}

std::optional<cl::Program> load_binary(const Device& device, const std::filesystem::path& path,
                                       const std::string& options) {
    std::error_code none;
    if (!std::filesystem::exists(path, none)) return std::nullopt;
    try {
        const std::string content = read_checked_file(path, binary_format);
        const std::vector<unsigned char> bytes(content.begin(), content.end());
        cl::Program program(device.context(), {device.handle()}, cl::Program::Binaries{bytes});
        program.build({device.handle()}, options.c_str());
        return program;
    } catch (const cl::Error& error) {
        log_warning("kernel cache: {} is not usable ({}), compiling again", path.string(),
                    opencl_error_name(error.err()));
        return std::nullopt;
    } catch (const Error& error) {
        log_warning("kernel cache: {}; compiling again", error.what());
        return std::nullopt;
    }
}

void save_binary(const Device& device, const cl::Program& program, const std::filesystem::path& path) {
    const std::vector<std::vector<unsigned char>> binaries = program.getInfo<CL_PROGRAM_BINARIES>();
    if (binaries.empty() || binaries.front().empty()) return;
    try {
        std::filesystem::create_directories(path.parent_path());
        const auto& bytes = binaries.front();
        write_checked_cache(path, binary_format, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    } catch (const std::exception& error) {
        if (device.is_first_unsaved_program())
            log_warning("kernel cache: not saved, the next start compiles again: {}", error.what());
    }
}

}  // namespace

std::string first_build_error(const std::string& log, std::span<const ProgramSource> sources) {
    const std::string error = first_error(log);
    const auto names_it = [&](const ProgramSource& source) {
        return error.find(source.path) != std::string::npos;
    };
    std::smatch place;
    if (std::ranges::any_of(sources, names_it) ||
        !std::regex_search(error, place, std::regex(R"(:(\d{1,7}):)")))
        return error;
    long line = std::stol(place[1]);
    for (const ProgramSource& source : sources) {
        const long joined = 2 + std::ranges::count(source.text, '\n');  // with its #line
        if (line <= joined) return fmt::format("{}:{}:{}", source.path, line - 1, place.suffix().str());
        line -= joined;
    }
    return error;
}

void Kernel::enqueue(const LaunchSize& size) {
    const cl::NDRange global(size.global[0], size.global[1], size.global[2]);
    const cl::NDRange local(size.local[0], size.local[1], size.local[2]);
    const cl::NDRange first(size.first[0], size.first[1], size.first[2]);
    device_->queue().enqueueNDRangeKernel(kernel_, first, global, local);
}

Program::Program(const Device& device, std::span<const ProgramSource> sources, std::string_view options)
    : device_(&device), file_(sources.empty() ? "" : sources.back().path) {
    const std::string text = join_sources(sources);
    const std::string flags = std::string(build_flags) + std::string(options);
    const bool cached = !device.cache_dir().empty();
    const std::filesystem::path path = cached ? binary_path(device, text, flags) : std::filesystem::path();
    if (cached) {
        if (auto loaded = load_binary(device, path, flags)) {
            program_ = *loaded;
            came_from_cache_ = true;
            return;
        }
    }
    try {
        program_ = cl::Program(device.context(), text);
        program_.build({device.handle()}, flags.c_str());
    } catch (const cl::BuildError& error) {
        const std::string log = error.getBuildLog().empty() ? "" : error.getBuildLog().front().second;
        throw Error(ExitStatus::unavailable,
                    "kernel does not build on " + device.name() + ": " + first_build_error(log, sources));
    } catch (const cl::Error& error) {
        throw DeviceError("building " + file_, error.err(), device.name());
    }
    if (cached) save_binary(device, program_, path);
}

Kernel Program::kernel(const std::string& name) const {
    try {
        return {*device_, cl::Kernel(program_, name.c_str()), file_ + ":" + name};
    } catch (const cl::Error& error) {
        throw DeviceError("kernel " + file_ + ":" + name, error.err(), device_->name());
    }
}

}  // namespace touchstone
