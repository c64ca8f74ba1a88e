#include "tests/accuracy/mask_run.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <fstream>
#include <stdexcept>

#include "platform/image/png_file.hpp"
#include "tests/accuracy/mask_picture.hpp"
#include "tests/support/run_program.hpp"

namespace touchstone {

namespace {

namespace fs = std::filesystem;

constexpr int scan_frames = 20, table_scan_frames = 25;
constexpr int first_object_label = 20;

/// A picture, what is true of it and what was found in it.
struct Labelled {
    std::string name;
    Image16 depth;
    std::vector<std::uint8_t> truth, mask, counted;
};

fs::path depth_file(const fs::path& folder, int frame) {
    return folder / fmt::format("frame-{:06}.depth.png", frame);
}

fs::path mask_file(const fs::path& folder, int frame) {
    return folder / fmt::format("frame-{:06}.foreground.png", frame);
}

void run(const std::string& program, const std::string& sensor, const TemporaryFolder& folder) {
    // A display as small as can be: the picture is not what is scored.
    std::ofstream(folder / "masks.toml")
        << "[display]\nwidth_px = 160\nheight_px = 120\n[tuio]\nenabled = false\n";
    const test::ProgramResult result = test::run_program(
        {program, "run", "--sensor", sensor, "--pace", "step", "--display", "headless", "--maps",
         (folder / "maps").string(), "--config", (folder / "masks.toml").string()});
    if (result.status != 0) throw std::runtime_error(sensor + ": " + result.err);
}

MaskFrame compare(const Labelled& picture) {
    MaskFrame frame{picture.name};
    for (std::size_t i = 0; i < picture.depth.pixels.size(); ++i) {
        if (picture.depth.pixels[i] == 0 || picture.counted[i] == 0) continue;
        ++frame.readings;
        frame.truth += picture.truth[i] != 0;
        frame.marked += picture.mask[i] != 0;
        frame.both += picture.truth[i] != 0 && picture.mask[i] != 0;
    }
    return frame;
}

void draw(const Labelled& picture, const PictureFolder& pictures, const std::string& name) {
    if (pictures.empty()) return;
    fs::create_directories(pictures);
    write_png(pictures / (name + ".png"),
              mask_picture(picture.depth, picture.truth, picture.mask, picture.counted));
}

Labelled simulated_frame(int frame, const TemporaryFolder& folder) {
    Labelled picture{std::to_string(frame), read_png_16(depth_file(folder / "truth", frame)), {}, {}, {}};
    picture.truth = read_png_8(folder / "truth" / fmt::format("truth-{:06}.mask.png", frame)).pixels;
    picture.mask = read_png_8(mask_file(folder / "maps", frame)).pixels;
    picture.counted.assign(picture.truth.size(), 255);
    return picture;
}

/// The frame with the smallest overlap of those with hands, and the one with the most marked of those
/// without.
void draw_worst(const std::string& scene, int seed, int frames, const TemporaryFolder& folder,
                const PictureFolder& pictures) {
    constexpr int first = 60;
    constexpr long enough = 1500;
    int worst = -1, falsest = -1;
    double least_iou = 1.0, most_marked = 0.0;
    for (int frame = first; frame < frames; ++frame) {
        const MaskFrame score = compare(simulated_frame(frame, folder));
        if (score.truth > enough && score.iou() < least_iou) worst = frame, least_iou = score.iou();
        if (score.truth == 0 && score.marked_share() > most_marked)
            falsest = frame, most_marked = score.marked_share();
    }
    for (const int frame : {worst, falsest})
        if (frame >= 0)
            draw(simulated_frame(frame, folder), pictures, fmt::format("{}-{}-{}", scene, seed, frame));
}

std::vector<fs::path> scenes_of(const fs::path& table) {
    std::vector<fs::path> scenes;
    for (const auto& entry : fs::directory_iterator(table)) {
        const std::string name = entry.path().filename().string();
        if (name.ends_with(".depth.png") && name != "background.depth.png") scenes.push_back(entry.path());
    }
    std::ranges::sort(scenes);
    return scenes;
}

Labelled labelled_scene(const fs::path& scene, const Image16& background, const fs::path& mask) {
    const std::string name = scene.filename().string();
    const std::string stem = name.substr(0, name.find('.'));
    Labelled picture{stem, read_png_16(scene), {}, read_png_8(mask).pixels, {}};
    const Image8 labels = read_png_8(scene.parent_path() / (stem + ".label.png"));
    for (std::size_t i = 0; i < labels.pixels.size(); ++i) {
        picture.truth.push_back(labels.pixels[i] >= first_object_label ? 255 : 0);
        picture.counted.push_back(labels.pixels[i] != 0 && background.pixels[i] != 0 ? 255 : 0);
    }
    return picture;
}

/// Of a frame of which nothing is foreground.
Labelled empty_frame(const std::string& name, const fs::path& depth, const fs::path& mask) {
    Labelled picture{name, read_png_16(depth), {}, read_png_8(mask).pixels, {}};
    picture.truth.assign(picture.mask.size(), 0);
    picture.counted.assign(picture.mask.size(), 255);
    return picture;
}

}  // namespace

double MaskFrame::iou() const {
    const long either = truth + marked - both;
    return either == 0 ? 1.0 : static_cast<double>(both) / static_cast<double>(either);
}

double MaskFrame::marked_share() const {
    return static_cast<double>(marked) / static_cast<double>(std::max(1L, readings));
}

MaskScore scored_simulation(const std::string& program, const std::string& scene, int seed, int frames,
                            const PictureFolder& pictures) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "truth");
    run(program,
        fmt::format("sim:{}?hands=2&seed={}&frames={}&masks={}", scene, seed, frames,
                    (folder / "truth").string()),
        folder);
    if (!pictures.empty()) draw_worst(scene, seed, frames, folder, pictures);
    return score_masks(folder / "truth", folder / "maps");
}

std::vector<MaskFrame> scored_table(const std::string& program, const fs::path& table,
                                    const PictureFolder& pictures) {
    const TemporaryFolder folder;
    const fs::path frames = folder / "frames";
    fs::create_directory(frames);
    fs::copy_file(table / "camera-intrinsics.txt", frames / "camera-intrinsics.txt");
    int count = 0;
    while (count < table_scan_frames)
        fs::copy_file(table / "background.depth.png", depth_file(frames, count++));
    const std::vector<fs::path> scenes = scenes_of(table);
    for (const fs::path& scene : scenes) fs::copy_file(scene, depth_file(frames, count++));
    run(program, "seq:" + frames.string(), folder);
    const Image16 background = read_png_16(table / "background.depth.png");
    std::vector<MaskFrame> scores;
    for (const fs::path& scene : scenes) {
        const int frame = table_scan_frames + static_cast<int>(scores.size());
        const Labelled picture = labelled_scene(scene, background, mask_file(folder / "maps", frame));
        draw(picture, pictures, "table-" + picture.name);
        scores.push_back(compare(picture));
    }
    return scores;
}

RoomScore scored_room(const std::string& program, const fs::path& room, const PictureFolder& pictures) {
    const TemporaryFolder folder;
    const fs::path frames = folder / "frames", maps = folder / "maps";
    fs::create_directory(frames);
    fs::copy_file(room / "camera-intrinsics.txt", frames / "camera-intrinsics.txt");
    for (int frame = 0; frame < scan_frames; ++frame)
        fs::copy_file(depth_file(room, frame), depth_file(frames, frame));
    constexpr int last = 345;
    for (int frame = 0; frame <= last; ++frame)
        fs::copy_file(depth_file(room, frame), depth_file(frames, scan_frames + frame));
    run(program, "seq:" + frames.string(), folder);
    const auto scored = [&](int first, int end, std::vector<MaskFrame>& scores) {
        for (int frame = first; frame < end; ++frame) {
            const Labelled picture = empty_frame(std::to_string(frame), depth_file(room, frame),
                                                 mask_file(maps, scan_frames + frame));
            scores.push_back(compare(picture));
            if (scores.back().marked > 0) draw(picture, pictures, "room-" + picture.name);
        }
    };
    RoomScore score;
    scored(0, scan_frames, score.before);
    scored(330, last + 1, score.after);
    for (const int frame : {80, 150, 220, 280}) {
        const Labelled picture =
            empty_frame(std::to_string(frame), depth_file(room, frame), mask_file(maps, scan_frames + frame));
        score.least_person = std::min(score.least_person, compare(picture).marked_share());
        draw(picture, pictures, "room-person-" + picture.name);
    }
    return score;
}

}  // namespace touchstone
