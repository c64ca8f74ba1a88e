#include "ui/canvas_renderer.hpp"

#include <cstdint>
#include <imgui.h>
#include <span>

#include "ui/shader.hpp"

namespace touchstone {

namespace {

constexpr GLenum index_type = sizeof(ImDrawIdx) == 2 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT;

void describe_vertices() {
    constexpr GLuint position = 0, uv = 1, color = 2;
    glVertexAttribFormat(position, 2, GL_FLOAT, GL_FALSE, offsetof(ImDrawVert, pos));
    glVertexAttribFormat(uv, 2, GL_FLOAT, GL_FALSE, offsetof(ImDrawVert, uv));
    glVertexAttribFormat(color, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(ImDrawVert, col));
    for (const GLuint attribute : {position, uv, color}) {
        glVertexAttribBinding(attribute, 0);
        glEnableVertexAttribArray(attribute);
    }
}

void draw_triangles(const ImDrawCmd& command) {
    const std::size_t first_byte = command.IdxOffset * sizeof(ImDrawIdx);
    // GL takes a place in the bound buffer as a pointer. NOLINTNEXTLINE(performance-no-int-to-ptr)
    const auto* place = reinterpret_cast<const void*>(first_byte);
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount), index_type, place);
}

void clip_to(const ImVec4& clip, float height_px) {
    glScissor(static_cast<GLint>(clip.x), static_cast<GLint>(height_px - clip.w),
              static_cast<GLsizei>(clip.z - clip.x), static_cast<GLsizei>(clip.w - clip.y));
}

}  // namespace

CanvasRenderer::CanvasRenderer()
    : program_(make_program("canvas")), size_px_uniform_(program_.uniform("u_size_px")) {
    glBindVertexArray(vertex_array_.id());
    describe_vertices();
    glBindVertexArray(0);
}

void CanvasRenderer::upload_letters(Canvas& canvas) {
    if (canvas.fonts_version() == letters_version_) return;
    unsigned char* texels = nullptr;
    PixelSize size;
    canvas.fonts().atlas().GetTexDataAsAlpha8(&texels, &size.width_px, &size.height_px);
    letters_.emplace(size, TexelFormat::r8);
    letters_->upload(
        {texels, static_cast<std::size_t>(size.width_px) * static_cast<std::size_t>(size.height_px)});
    letters_version_ = canvas.fonts_version();
}

void CanvasRenderer::draw(Canvas& canvas) {
    upload_letters(canvas);
    letters_->bind(0);
    program_.use();
    glUniform2f(size_px_uniform_, canvas.size_px().x(), canvas.size_px().y());
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glEnable(GL_SCISSOR_TEST);

    const ImDrawList& list = canvas.list();
    glBindVertexArray(vertex_array_.id());
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.id());
    glBufferData(GL_ARRAY_BUFFER, list.VtxBuffer.size_in_bytes(), list.VtxBuffer.Data, GL_STREAM_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, list.IdxBuffer.size_in_bytes(), list.IdxBuffer.Data,
                 GL_STREAM_DRAW);
    for (const ImDrawCmd& command : list.CmdBuffer) {
        if (command.ElemCount == 0) continue;
        clip_to(command.ClipRect, canvas.size_px().y());
        glBindVertexBuffer(0, vertices_.id(), static_cast<GLintptr>(command.VtxOffset * sizeof(ImDrawVert)),
                           sizeof(ImDrawVert));
        draw_triangles(command);
    }
    glBindVertexArray(0);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
}

}  // namespace touchstone
