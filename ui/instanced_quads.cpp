#include "ui/instanced_quads.hpp"

#include <bit>
#include <cstddef>

namespace touchstone {

InstancedQuads::InstancedQuads() {
    glBindVertexArray(vertex_array_.id());
    glVertexAttribFormat(0, 4, GL_FLOAT, GL_FALSE, offsetof(QuadInstance, values));
    glVertexAttribFormat(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(QuadInstance, color));
    for (const GLuint attribute : {0U, 1U}) {
        glVertexAttribBinding(attribute, 0);
        glEnableVertexAttribArray(attribute);
    }
    glBindVertexArray(0);
}

/// Two triangles a quad, for at least so many.
void InstancedQuads::index(std::size_t quads) {
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, index_buffer_.id());
    if (quads <= quads_indexed_) return;
    quads_indexed_ = std::bit_ceil(quads);
    std::vector<GLuint> indices;
    indices.reserve(6 * quads_indexed_);
    for (GLuint first = 0; first < 4 * quads_indexed_; first += 4)
        for (const GLuint corner : {0U, 1U, 2U, 2U, 1U, 3U}) indices.push_back(first + corner);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(GLuint)),
                 indices.data(), GL_STATIC_DRAW);
}

void InstancedQuads::draw(std::span<const QuadInstance> quads, QuadBlend blend) {
    if (quads.empty()) return;
    glEnable(GL_BLEND);
    glBlendFunc(blend == QuadBlend::over ? GL_ONE : GL_ZERO, GL_ONE_MINUS_SRC_ALPHA);
    corners_.clear();
    for (const QuadInstance& quad : quads) corners_.insert(corners_.end(), 4, quad);
    glBindVertexArray(vertex_array_.id());
    index(quads.size());
    glBindBuffer(GL_ARRAY_BUFFER, corner_buffer_.id());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners_.size() * sizeof(QuadInstance)),
                 corners_.data(), GL_STREAM_DRAW);
    glBindVertexBuffer(0, corner_buffer_.id(), 0, sizeof(QuadInstance));
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(6 * quads.size()), GL_UNSIGNED_INT, nullptr);
    glBindVertexArray(0);
    glDisable(GL_BLEND);
}

void InstancedQuads::draw_points(std::span<const QuadInstance> quads) {
    if (quads.empty()) return;
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glBindVertexArray(vertex_array_.id());
    glBindBuffer(GL_ARRAY_BUFFER, corner_buffer_.id());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(quads.size_bytes()), quads.data(), GL_STREAM_DRAW);
    glBindVertexBuffer(0, corner_buffer_.id(), 0, sizeof(QuadInstance));
    glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(quads.size()));
    glBindVertexArray(0);
    glDisable(GL_BLEND);
}

}  // namespace touchstone
