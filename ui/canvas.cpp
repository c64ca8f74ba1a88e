#include "ui/canvas.hpp"

#include <cfloat>
#include <imgui.h>
#include <imgui_internal.h>
#include <numbers>

namespace touchstone {

namespace {

constexpr float largest_circle_error_px = 0.2f;

ImVec2 im(const Eigen::Vector2f& v) { return {v.x(), v.y()}; }

float angle(float turn) { return (turn - 0.25f) * 2.f * std::numbers::pi_v<float>; }

}  // namespace

struct Canvas::SharedData {
    ImDrawListSharedData data;
};

Canvas::Canvas(FontFiles files)
    : files_(std::move(files)),
      shared_(std::make_unique<SharedData>()),
      list_(std::make_unique<ImDrawList>(&shared_->data)) {
    shared_->data.InitialFlags =
        ImDrawListFlags_AntiAliasedLines | ImDrawListFlags_AntiAliasedFill | ImDrawListFlags_AllowVtxOffset;
    shared_->data.SetCircleTessellationMaxError(largest_circle_error_px);
}

Canvas::~Canvas() = default;

void Canvas::begin(const Eigen::Vector2f& size_px, float scale) {
    if (scale != scale_) {
        fonts_ = std::make_unique<Fonts>(files_, scale);
        shared_->data.TexUvWhitePixel = fonts_->atlas().TexUvWhitePixel;
        shared_->data.TexUvLines = fonts_->atlas().TexUvLines;
        scale_ = scale;
        ++fonts_version_;
    }
    size_px_ = size_px;
    shared_->data.ClipRectFullscreen = {0.f, 0.f, size_px.x(), size_px.y()};
    list_->_ResetForNewFrame();
    list_->PushClipRectFullScreen();
    list_->PushTextureID(fonts_->atlas().TexID);
}

void Canvas::text(TextStyle style, const Eigen::Vector2f& at_px, style::Color color, std::string_view words,
                  float wrap_px) {
    ImFont* font = fonts_->font(style);
    const ImVec2 whole_px(std::round(at_px.x()), std::round(at_px.y()));
    list_->AddText(font, font->FontSize, whole_px, color.packed(), words.data(), words.data() + words.size(),
                   wrap_px);
}

Eigen::Vector2f Canvas::text_size_px(TextStyle style, std::string_view words, float wrap_px) const {
    const ImFont* font = fonts_->font(style);
    const ImVec2 size =
        font->CalcTextSizeA(font->FontSize, FLT_MAX, wrap_px, words.data(), words.data() + words.size());
    return {size.x, size.y};
}

void Canvas::disc(const Eigen::Vector2f& center_px, float radius_px, style::Color color) {
    list_->AddCircleFilled(im(center_px), radius_px, color.packed());
}

void Canvas::ring(const Eigen::Vector2f& center_px, float radius_px, float width_px, style::Color color) {
    list_->AddCircle(im(center_px), radius_px, color.packed(), 0, width_px);
}

void Canvas::arc(const Eigen::Vector2f& center_px, float radius_px, float width_px, float from_turn,
                 float to_turn, style::Color color) {
    list_->PathArcTo(im(center_px), radius_px, angle(from_turn), angle(to_turn), 64);
    list_->PathStroke(color.packed(), 0, width_px);
}

void Canvas::line(const Eigen::Vector2f& a_px, const Eigen::Vector2f& b_px, float width_px,
                  style::Color color) {
    // The draw list takes pixel corners for lines and moves them half a pixel.
    list_->AddLine({a_px.x() - 0.5f, a_px.y() - 0.5f}, {b_px.x() - 0.5f, b_px.y() - 0.5f}, color.packed(),
                   width_px);
}

void Canvas::box(const Eigen::Vector2f& min_px, const Eigen::Vector2f& max_px, float corner_px,
                 style::Color color) {
    list_->AddRectFilled(im(min_px), im(max_px), color.packed(), corner_px);
}

void Canvas::begin_clip(const Eigen::Vector2f& min_px, const Eigen::Vector2f& max_px) {
    list_->PushClipRect({min_px.x(), min_px.y()}, {max_px.x(), max_px.y()}, true);
}

void Canvas::end_clip() { list_->PopClipRect(); }

}  // namespace touchstone
