// The check of an .oni file, which stands before OpenNI's player.
#include "platform/camera/recording_check.hpp"
#include "tests/fuzz/support.hpp"
#include "tests/support/small_recording.hpp"

namespace touchstone::fuzz {
namespace {

const MemoryFolder folder;

}  // namespace

std::vector<std::string> seeds() { return {test::small_recording()}; }

}  // namespace touchstone::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace touchstone::fuzz;
    const std::filesystem::path file = folder.put("tested.oni", text_of(bytes, size));
    must_answer([&] { touchstone::check_recording(file.string()); });
    return 0;
}
