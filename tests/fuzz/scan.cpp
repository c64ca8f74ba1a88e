#include "pipeline/scan_file.hpp"
#include "tests/fuzz/checked_input.hpp"

namespace touchstone::fuzz {
namespace {

const MemoryFolder folder;

SavedScan some_scan() {
    SavedScan scan;
    scan.volume.config.size_vox = 64;
    scan.volume.bricks = {1, 5};
    scan.volume.color_bricks = {5};
    for (int i = 0; i < 2 * BRICK_VOXELS; ++i) scan.volume.voxels.push_back(i * i);
    scan.volume.colors.assign(BRICK_VOXELS, 0x40302010);
    scan.intrinsics = {575.f, 575.f, 320.f, 240.f, 640, 480, {}};
    scan.keyframes.resize(2);
    return scan;
}

}  // namespace

std::vector<std::string> seeds() {
    save_scan(folder / "seed", some_scan());
    return checked_seeds(folder / "seed", folder.bytes("seed"));
}

}  // namespace touchstone::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace touchstone::fuzz;
    put_checked(folder, "scan", touchstone::scan_file_format, text_of(bytes, size));
    must_answer([] { (void)touchstone::load_scan(folder / "scan"); });
    return 0;
}
