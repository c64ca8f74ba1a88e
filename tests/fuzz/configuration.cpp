// The configuration, the models of cameras, the words of a sensor URI, and named areas.
#include <cstdlib>

#include "app/areas_file.hpp"
#include "app/config.hpp"
#include "platform/camera/sensor_models.hpp"
#include "platform/openni2_drivers/simulator/simulator_config.hpp"
#include "tests/fuzz/support.hpp"

namespace touchstone::fuzz {

std::vector<std::string> seeds() {
    std::vector<std::string> all{
        marked('c', print_config(Config{})),
        "c[sensor]\nuri = \"sim:flat\"\nmode = \"320x240@60\"\n[tuio]\nport = 3333\n",
        "c[display]\nwidth_px = 1_280 # wide\nscene = '''paint'''\n",
        "a[[area]]\nname = \"left\"\nscene = \"paint\"\ncorners_mm = [[-300, -200], [0, -200], [0, 200]]\n",
        "a[[area]]\nname = \"b\"\nsource = \"b@x\"\ncorners_mm = [[0, 0], [200, 0], [80, 100], [200, 200], "
        "[0, 200]]\n",
        "umixed?hands=2&seed=7&frames=30&height=1.1&tilt=20&object=ball&put_s=3",
        "uroom?motion=sweep&person=0.4&person_s=2&knock_s=3&knock_deg=2&knock_mm=9"};
    std::ifstream models(std::string(TOUCHSTONE_SOURCE_DIR) + "/platform/camera/sensor_models.toml");
    all.push_back(marked('m', std::string(std::istreambuf_iterator<char>(models), {})));
    return all;
}

}  // namespace touchstone::fuzz

/// The first byte says which of the four.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    using namespace touchstone::fuzz;
    if (size == 0) return 0;
    const std::string input(text_of(bytes, size).substr(1));
    must_answer([&] {
        if (bytes[0] == 'm') {
            (void)touchstone::parse_sensor_models(input, "models.toml");
        } else if (bytes[0] == 'u') {
            (void)touchstone::parse_simulator_uri(input);
        } else if (bytes[0] == 'a') {
            for (const touchstone::NamedArea& area : touchstone::parse_areas(input, "areas.toml"))
                if (touchstone::triangles_of(area.corners_mm).size() != 3 * (area.corners_mm.size() - 2))
                    std::abort();
        } else {
            touchstone::Config config;
            touchstone::parse_config(input, "table.toml", config);
            touchstone::Config again;
            touchstone::parse_config(touchstone::print_config(config), "printed.toml", again);
        }
    });
    return 0;
}
