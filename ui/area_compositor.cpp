#include "ui/area_compositor.hpp"

#include <algorithm>

#include "ui/shader.hpp"

namespace touchstone {

AreaCompositor::AreaCompositor() : program_(make_program("area")) {
    program_.use();
    glUniform1i(program_.uniform("u_layer"), 0);
    glBindVertexArray(vertex_array_.id());
    glVertexAttribFormat(0, 2, GL_FLOAT, GL_FALSE, 0);
    glVertexAttribBinding(0, 0);
    glEnableVertexAttribArray(0);
    glBindVertexArray(0);
}

const GlTexture* AreaCompositor::compose(PixelSize view, std::span<const AreaLayer> layers) {
    const auto first =
        std::ranges::find_if(layers, [](const AreaLayer& layer) { return layer.layer != nullptr; });
    if (first == layers.end() || view.width_px == 0) return nullptr;
    if (!picture_ || picture_->size_px() != first->layer->size_px())
        picture_.emplace(first->layer->size_px());
    picture_->bind();
    glClearColor(0.f, 0.f, 0.f, 0.f);
    glClear(GL_COLOR_BUFFER_BIT);
    program_.use();
    glBindVertexArray(vertex_array_.id());
    const Eigen::Vector2f size(static_cast<float>(view.width_px), static_cast<float>(view.height_px));
    for (const auto& [area, layer] : layers) {
        if (layer == nullptr) continue;
        places_.clear();
        for (const int corner : area->triangles)
            places_.push_back(
                (area->corners_px[static_cast<std::size_t>(corner)] + Eigen::Vector2f(0.5f, 0.5f))
                    .cwiseQuotient(size));
        glBindBuffer(GL_ARRAY_BUFFER, buffer_.id());
        glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(places_.size() * sizeof places_[0]),
                     places_.data(), GL_STREAM_DRAW);
        glBindVertexBuffer(0, buffer_.id(), 0, sizeof places_[0]);
        layer->bind(0);
        glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(places_.size()));
    }
    glBindVertexArray(0);
    return &picture_->color();
}

}  // namespace touchstone
