#include "tests/fuzz/checked_input.hpp"
#include "ui/painting_file.hpp"

namespace touchstone::fuzz {
namespace {

const MemoryFolder folder;

const FileFormat& format() {
    static const FileFormat known = [] {
        Painting painting;
        painting.finish(painting.begin({255, 0, 0, 255}, 5.f, false, {0.f, 0.f, 1.f}));
        painting.clear();
        const int stroke = painting.begin({0, 255, 0, 255}, 9.f, true, {0.1f, 0.f, 1.f});
        for (int i = 1; i < 20; ++i) painting.extend(stroke, {0.01f * static_cast<float>(i), 0.2f, 1.f});
        painting.finish(stroke);
        save_painting(folder / "seed", painting, RigidTransform::Identity());
        return format_of(folder.bytes("seed"));
    }();
    return known;
}

}  // namespace

std::vector<std::string> seeds() {
    (void)format();
    return checked_seeds(folder / "seed", folder.bytes("seed"));
}

}  // namespace touchstone::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace touchstone::fuzz;
    put_checked(folder, "painting", format(), text_of(bytes, size));
    must_answer([] {
        const auto stored = touchstone::load_painting(folder / "painting");
        if (stored) (void)touchstone::Painting::from_bytes(stored->painting.bytes());
    });
    return 0;
}
