#include "ui/photo_layer.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "ui/shader.hpp"

namespace touchstone {

namespace {

using Eigen::Vector2f;

constexpr int layer_px_per_view_px = 2;
constexpr float border_mm = 8.f, corner_mm = 2.f;
constexpr float shadow_reach_mm = 14.f, shadow_fall_mm = 8.f, shadow_darkness = 0.62f;
constexpr float lifted = 1.8f;  // of the shadow, while it is held

}  // namespace

PhotoLayer::PhotoLayer() : program_(make_program("photo")) {
    program_.use();
    glUniform1i(program_.uniform("u_picture"), 0);
}

void PhotoLayer::set_view(PixelSize view) {
    const PixelSize size{view.width_px * layer_px_per_view_px, view.height_px * layer_px_per_view_px};
    if (picture_ && picture_->size_px() == size) return;
    picture_.emplace(size);
    program_.use();
    glUniform2f(program_.uniform("u_layer_size_px"), static_cast<float>(size.width_px),
                static_cast<float>(size.height_px));
    draw({}, 1.f);
}

void PhotoLayer::set_picture(int card_id, const Picture& picture) {
    GlTextureHandle texture(new_gl_texture());
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, texture.id());
    const auto longest = static_cast<unsigned>(std::max(picture.width_px, picture.height_px));
    glTexStorage2D(GL_TEXTURE_2D, static_cast<GLsizei>(std::bit_width(longest)), GL_RGBA8, picture.width_px,
                   picture.height_px);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, picture.width_px, picture.height_px, GL_RGBA, GL_UNSIGNED_BYTE,
                    picture.rgba.data());
    glGenerateMipmap(GL_TEXTURE_2D);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    pictures_.insert_or_assign(card_id, std::move(texture));
}

void PhotoLayer::draw(const std::vector<PhotoCard>& cards, float mm_per_px) {
    if (!picture_) return;
    picture_->bind();
    glClearColor(0.f, 0.f, 0.f, 0.f);
    glClear(GL_COLOR_BUFFER_BIT);
    program_.use();
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glBindVertexArray(vertex_array_.id());
    for (const PhotoCard& card : cards) draw_card(card, layer_px_per_view_px / mm_per_px);
    glBindVertexArray(0);
    glDisable(GL_BLEND);
}

void PhotoLayer::draw_card(const PhotoCard& card, float layer_px_per_mm) {
    const auto picture = pictures_.find(card.id);
    if (picture == pictures_.end()) return;
    const Vector2f center = layer_px_per_view_px * (card.center_px + Vector2f(0.5f, 0.5f));
    const Vector2f half = layer_px_per_view_px * card.scale * card.half_px;
    const float lift = layer_px_per_mm * (card.held ? lifted : 1.f);
    const Vector2f fall =
        Eigen::Rotation2Df(-card.rotation_rad) * Vector2f(0.4f * shadow_fall_mm, shadow_fall_mm) * lift;
    glUniform2f(program_.uniform("u_center_px"), center.x(), center.y());
    glUniform2f(program_.uniform("u_turn"), std::cos(card.rotation_rad), std::sin(card.rotation_rad));
    glUniform2f(program_.uniform("u_half_px"), half.x(), half.y());
    glUniform1f(program_.uniform("u_border_px"), border_mm * layer_px_per_mm);
    glUniform1f(program_.uniform("u_corner_px"), corner_mm * layer_px_per_mm);
    glUniform1f(program_.uniform("u_reach_px"), shadow_reach_mm * lift);
    glUniform2f(program_.uniform("u_fall_px"), fall.x(), fall.y());
    glUniform1f(program_.uniform("u_darkness"), shadow_darkness);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, picture->second.id());
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

}  // namespace touchstone
