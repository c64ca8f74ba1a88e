#include "ui/fonts.hpp"

#include <cmath>
#include <filesystem>
#include <imgui.h>
#include <imgui_freetype.h>

#include "platform/system/error.hpp"
#include "ui/style.hpp"

namespace touchstone {

namespace {

struct TextLook {
    float size_px;
    bool strong;
};

constexpr std::array<TextLook, text_style_count> looks{{{style::caption_px, false},
                                                        {style::body_px, false},
                                                        {style::heading_px, true},
                                                        {style::title_px, true},
                                                        {style::figure_px, true}}};

// Latin-1, and of the general punctuation the dashes, quotation marks and the ellipsis.
constexpr ImWchar letters[] = {0x0020, 0x00ff, 0x2010, 0x2026, 0};

std::string first_existing(const std::vector<std::string>& paths) {
    std::string looked_for;
    for (const std::string& path : paths) {
        if (std::filesystem::is_regular_file(path)) return path;
        looked_for += (looked_for.empty() ? "" : ", ") + path;
    }
    throw Error(ExitStatus::unavailable,
                "No font for the display (looked for " + looked_for + "); install the package fonts-inter");
}

}  // namespace

FontFiles default_font_files() {
    const std::string inter = "/usr/share/fonts/opentype/inter/";
    const std::string dejavu = "/usr/share/fonts/truetype/dejavu/";
    return {{inter + "Inter-Regular.otf", dejavu + "DejaVuSans.ttf"},
            {inter + "Inter-SemiBold.otf", dejavu + "DejaVuSans-Bold.ttf"}};
}

Fonts::Fonts(const FontFiles& files, float scale) : atlas_(std::make_unique<ImFontAtlas>()) {
    const std::string regular = first_existing(files.regular);
    const std::string strong = first_existing(files.strong);
    atlas_->FontBuilderIO =
        ImGuiFreeType::GetBuilderForFreeType();  // Inter's outlines are CFF, which stb cannot read
    atlas_->FontBuilderFlags = ImGuiFreeTypeBuilderFlags_LightHinting;
    for (std::size_t i = 0; i < looks.size(); ++i)
        fonts_[i] = atlas_->AddFontFromFileTTF((looks[i].strong ? strong : regular).c_str(),
                                               std::round(looks[i].size_px * scale), nullptr, letters);
    if (!atlas_->Build())
        throw Error(ExitStatus::unavailable, "The font " + regular + " or " + strong +
                                                 " cannot be read; reinstall the package fonts-inter");
}

Fonts::~Fonts() = default;

}  // namespace touchstone
