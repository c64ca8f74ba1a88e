#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

struct ImFont;
struct ImFontAtlas;

namespace touchstone {

enum class TextStyle { caption, body, heading, title, figure };
inline constexpr std::size_t text_style_count = 5;

/// The first of each list that exists is taken.
struct FontFiles {
    std::vector<std::string> regular;
    std::vector<std::string> strong;
};

/// Inter, else DejaVu, where Debian installs them.
FontFiles default_font_files();

/// The letters of every text style, drawn at one scale into one picture. Throws Error{unavailable} naming the
/// files looked for when there is no font.
class Fonts {
  public:
    Fonts(const FontFiles& files, float scale);
    ~Fonts();

    ImFontAtlas& atlas() { return *atlas_; }
    ImFont* font(TextStyle style) const { return fonts_[static_cast<std::size_t>(style)]; }

  private:
    std::unique_ptr<ImFontAtlas> atlas_;
    std::array<ImFont*, text_style_count> fonts_{};
};

}  // namespace touchstone
