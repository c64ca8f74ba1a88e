#include "platform/mesh/mesh_file.hpp"
#include "tests/fuzz/support.hpp"

namespace touchstone::fuzz {
namespace {

const MemoryFolder folder;

}  // namespace

std::vector<std::string> seeds() {
    return {"# a tetrahedron\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n",
            "o quad\nv -1 0 -1 1 0 0\nv 1 0 -1 0 1 0\nv 1 0 1 0 0 1\nv -1 0 1 1 1 1\nvt 0 0\nvt 1 0\nvt 1 "
            "1\nvt 0 1\n"
            "vn 0 1 0\ng part\nusemtl none\ns 1\nf 1/1/1 2/2/1 3/3/1 4/4/1\nf -4//-1 -3//-1 -2//-1\n",
            "v 1e-3 2.5e+2 -0.5\nv 0 \\\n 1 2\nv 3 3 3\nl 1 2\np 1\nf 1// 2// 3//\n"};
}

}  // namespace touchstone::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace touchstone::fuzz;
    const std::filesystem::path file = folder.put("tested.obj", text_of(bytes, size));
    must_answer([&] { (void)touchstone::read_mesh_file(file, touchstone::MeshDetail::look); });
    must_answer([&] { (void)touchstone::read_mesh_file(file, touchstone::MeshDetail::shape); });
    return 0;
}
