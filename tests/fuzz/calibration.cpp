// The calibration of a projector, and that of touches.
#include "app/projector_file.hpp"
#include "app/touch_bias_file.hpp"
#include "tests/fuzz/checked_input.hpp"

namespace touchstone::fuzz {
namespace {

const MemoryFolder folder;

struct Formats {
    FileFormat projector, bias;
};

const Formats& formats() {
    static const Formats known = [] {
        SavedProjector projector;
        projector.model.width_px = 1280;
        projector.model.height_px = 800;
        projector.method = "graycode";
        save_projector(folder / "pinhole", projector);
        projector.model.kind = ProjectorModelKind::homography;
        save_projector(folder / "homography", projector);
        TouchBiasFit fit;
        fit.bias = {0.003f, -0.001f};
        save_touch_bias(folder / "bias", fit);
        return Formats{format_of(folder.bytes("pinhole")), format_of(folder.bytes("bias"))};
    }();
    return known;
}

}  // namespace

std::vector<std::string> seeds() {
    (void)formats();
    std::vector<std::string> all;
    for (const char* name : {"pinhole", "homography", "bias"})
        for (const std::string& seed : checked_seeds(folder / name, folder.bytes(name)))
            all.push_back(marked(std::string_view(name) == "bias" ? 'b' : 'p', seed));
    all.emplace_back(R"(bf{"along_mm": 1.5, "across_mm": -0.25})");
    return all;
}

}  // namespace touchstone::fuzz

/// The first byte says which of the two.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace touchstone::fuzz;
    if (size == 0) return 0;
    const std::string_view input = text_of(bytes, size).substr(1);
    if (bytes[0] == 'b') {
        put_checked(folder, "tested", formats().bias, input);
        must_answer([] { (void)touchstone::load_touch_bias(folder / "tested"); });
    } else {
        put_checked(folder, "tested", formats().projector, input);
        must_answer([] { (void)touchstone::load_projector(folder / "tested"); });
    }
    return 0;
}
