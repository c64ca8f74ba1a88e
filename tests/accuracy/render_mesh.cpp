// render_mesh MESH PNG: a picture of a mesh to look at.
#include <CLI/CLI.hpp>
#include <iostream>

#include "platform/image/png_file.hpp"
#include "platform/system/error.hpp"
#include "tests/accuracy/mesh_input.hpp"
#include "tests/accuracy/mesh_picture.hpp"

namespace touchstone {
namespace {

Eigen::Vector3f vector_of(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

int render(int argc, char** argv) {
    CLI::App app("Draws a mesh: light at the viewer, backs of triangles red.");
    std::string mesh_path, png_path;
    std::array<float, 3> direction{0.5f, -0.6f, -1.0f}, eye{}, look_at{}, up{0.0f, -1.0f, 0.0f};
    float field_of_view_deg = 40.0f;
    int width_px = 960;
    bool grey = false;
    app.add_option("MESH", mesh_path, "PLY, OBJ or STL")->required();
    app.add_option("PNG", png_path, "the picture to write")->required();
    app.add_option("--direction", direction, "from the mesh to the viewer; the whole mesh is seen");
    CLI::Option* eye_option = app.add_option("--eye", eye, "place of the viewer instead, metres");
    app.add_option("--look-at", look_at, "with --eye: the middle of the picture, metres")->needs(eye_option);
    app.add_option("--up", up, "direction that is up");
    app.add_option("--field-of-view", field_of_view_deg, "with --eye: left to right, degrees")
        ->check(CLI::Range(1, 170))
        ->needs(eye_option);
    app.add_option("--width", width_px, "of the picture, pixels; the height is 3/4")
        ->check(CLI::Range(16, 8192));
    app.add_flag("--grey", grey, "without the mesh's colours");
    CLI11_PARSE(app, argc, argv);
    const SurfaceMesh mesh = read_mesh(mesh_path);
    PictureConfig config = whole_mesh(mesh, vector_of(direction), vector_of(up));
    if (*eye_option) {
        config.eye_m = vector_of(eye);
        config.look_at_m = vector_of(look_at);
        config.field_of_view_rad = field_of_view_deg * 3.14159265f / 180.0f;
    }
    config.width_px = width_px;
    config.height_px = width_px * 3 / 4;
    config.use_colors = !grey;
    write_png(png_path, draw_mesh(mesh, config));
    return 0;
}

}  // namespace
}  // namespace touchstone

int main(int argc, char** argv) try {
    return touchstone::render(argc, argv);
} catch (const touchstone::Error& error) {
    std::cerr << "render_mesh: " << error.what() << '\n';
    return static_cast<int>(error.status());
}
