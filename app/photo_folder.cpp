#include "app/photo_folder.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <memory>

#include "platform/image/jpeg_file.hpp"
#include "platform/image/png_file.hpp"
#include "platform/system/error.hpp"
#include "platform/system/log.hpp"

namespace touchstone {

namespace {

namespace fs = std::filesystem;

std::string ending(const fs::path& path) {
    std::string text = path.extension().string();
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

bool is_png(const fs::path& path) { return ending(path) == ".png"; }
bool is_jpeg(const fs::path& path) { return ending(path) == ".jpg" || ending(path) == ".jpeg"; }

std::vector<fs::path> photo_files(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code failure;
    for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end;
         entry.increment(failure))
        if (is_png(entry->path()) || is_jpeg(entry->path())) files.push_back(entry->path());
    if (failure)
        log_warning("no photos from {}: {}; pictures of the program's own are shown", folder.string(),
                    failure.message());
    else if (files.empty())
        log_warning("no PNG or JPEG in {}: pictures of the program's own are shown", folder.string());
    else if (files.size() <= most_photos)
        log_info("{} photos from {}", files.size(), folder.string());
    else
        log_info("{} holds {} photos: the first {} are shown", folder.string(), files.size(), most_photos);
    std::ranges::sort(files);
    files.resize(std::min(files.size(), most_photos));
    return files;
}

/// Red, green, blue, opacity.
std::array<unsigned, 4> pixel_of(const Image8& image, int x, int y) {
    const std::size_t at = (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width_px) +
                            static_cast<std::size_t>(x)) *
                           static_cast<std::size_t>(image.channels);
    const std::uint8_t* const p = &image.pixels[at];
    if (image.channels == 1) return {p[0], p[0], p[0], 255U};
    return {p[0], p[1], p[2], image.channels == 4 ? p[3] : 255U};
}

struct Span {
    int from, to;
};

Span source_span(int at, int size, int source_size) {
    const auto part = [&](int i) { return static_cast<int>(static_cast<long long>(i) * source_size / size); };
    return {part(at), std::max(part(at) + 1, part(at + 1))};
}

void append_mean(const Image8& image, Span across, Span down, std::vector<std::uint8_t>& rgba) {
    std::array<std::uint64_t, 3> sum{};
    for (int y = down.from; y < down.to; ++y)
        for (int x = across.from; x < across.to; ++x) {
            const auto pixel = pixel_of(image, x, y);
            for (std::size_t c = 0; c < 3; ++c) sum[c] += pixel[c] * pixel[3] + 255U * (255U - pixel[3]);
        }
    const auto count = static_cast<std::uint64_t>(across.to - across.from) *
                       static_cast<std::uint64_t>(down.to - down.from) * 255U;
    for (const std::uint64_t channel : sum)
        rgba.push_back(static_cast<std::uint8_t>((channel + count / 2) / count));
    rgba.push_back(255);
}

}  // namespace

Picture to_photo(const Image8& image, int most_px) {
    const int longest = std::max(image.width_px, image.height_px);
    const auto scaled = [&](int size) {
        if (longest <= most_px) return size;
        return std::max(1, static_cast<int>(static_cast<long long>(size) * most_px / longest));
    };
    Picture photo{scaled(image.width_px), scaled(image.height_px), {}};
    photo.rgba.reserve(static_cast<std::size_t>(photo.width_px) * static_cast<std::size_t>(photo.height_px) *
                       4);
    for (int y = 0; y < photo.height_px; ++y)
        for (int x = 0; x < photo.width_px; ++x)
            append_mean(image, source_span(x, photo.width_px, image.width_px),
                        source_span(y, photo.height_px, image.height_px), photo.rgba);
    return photo;
}

PictureStream open_photo_folder(const fs::path& folder) {
    struct State {
        std::vector<fs::path> files;
        std::size_t next = 0;
        bool warned = false;
    };
    auto state = std::make_shared<State>(State{photo_files(folder)});
    const auto next = [state]() -> std::optional<Picture> {
        while (state->next < state->files.size()) {
            const fs::path& file = state->files[state->next++];
            try {
                return to_photo(is_png(file) ? read_png_8(file) : read_jpeg_rgb(file), photo_side_px);
            } catch (const Error& error) {
                if (!state->warned) log_warning("{}; photos that cannot be read are left out", error.what());
                state->warned = true;
            }
        }
        return std::nullopt;
    };
    return {static_cast<int>(state->files.size()), next};
}

}  // namespace touchstone
