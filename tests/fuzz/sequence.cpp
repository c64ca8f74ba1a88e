// The lists of a folder of depth pictures, and the camera's intrinsics in it.
#include "platform/image/png_file.hpp"
#include "platform/openni2_drivers/sequence/sequence_source.hpp"
#include "tests/fuzz/support.hpp"

namespace touchstone::fuzz {
namespace {

/// Files of an input begin with a line "=NAME"; a name that is not one of these stands for none.
constexpr std::string_view names[] = {"depth.txt", "rgb.txt", "camera-intrinsics.txt"};

struct Folder {
    Folder() {
        const Image16 depth{16, 12, std::vector<std::uint16_t>(192, 5000)};
        write_png(folder / "a.png", depth);
        write_png(folder / "frame-000000.depth.png", depth);
        write_png(folder / "c.png", Image8{16, 12, 3, std::vector<std::uint8_t>(576, 9)});
    }
    MemoryFolder folder;
};

const Folder& the_folder() {
    static const Folder made;
    return made;
}

void put_files(std::string_view input) {
    const MemoryFolder& folder = the_folder().folder;
    for (const std::string_view name : names) std::filesystem::remove(folder / std::string(name));
    while (!input.empty()) {
        const std::size_t line = std::min(input.find('\n'), input.size());
        const std::string_view name = input.substr(0, line);
        const std::string_view rest = input.substr(std::min(line + 1, input.size()));
        const std::size_t end = std::min(rest.find("\n="), rest.size());
        for (const std::string_view known : names)
            if (name.starts_with('=') && name.substr(1) == known)
                folder.put(std::string(known), rest.substr(0, end));
        input = rest.substr(std::min(end + 1, rest.size()));
    }
}

}  // namespace

std::vector<std::string> seeds() {
    return {"=camera-intrinsics.txt\n525 0 319.5\n0 525 239.5\n0 0 1\n",
            "=depth.txt\n# depth\n1305031102.160407 a.png\n1305031102.194330 a.png\n"
            "=rgb.txt\n1305031102.175304 c.png\n",
            "=depth.txt\n0.1 a.png\n0.2 frame-000000.depth.png\n=rgb.txt\n# none\n"
            "=camera-intrinsics.txt\n5.7e2 0 8\n0 570 6\n0 0 1\n"};
}

}  // namespace touchstone::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace touchstone::fuzz;
    put_files(text_of(bytes, size));
    must_answer([] {
        touchstone::SequenceSource source(the_folder().folder / "");
        source.enable_color(true);
        touchstone::SourceFrame frame;
        for (int i = 0; i < 4 && source.next(frame); ++i) continue;
    });
    return 0;
}
