#include "ui/instanced_quads.hpp"

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
    glVertexBindingDivisor(0, 1);
    glBindVertexArray(0);
}

void InstancedQuads::draw(std::span<const QuadInstance> quads) {
    if (quads.empty()) return;
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glBindVertexArray(vertex_array_.id());
    glBindBuffer(GL_ARRAY_BUFFER, instance_buffer_.id());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(quads.size_bytes()), quads.data(), GL_STREAM_DRAW);
    glBindVertexBuffer(0, instance_buffer_.id(), 0, sizeof(QuadInstance));
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(quads.size()));
    glBindVertexArray(0);
    glDisable(GL_BLEND);
}

}  // namespace touchstone
