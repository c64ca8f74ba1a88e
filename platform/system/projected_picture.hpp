#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace touchstone {

/// What a projector throws, as a simulated camera and a simulated person see it. Row 0 at the top.
struct ProjectedPicture {
    int width_px = 0, height_px = 0;
    std::uint64_t version = 0;       ///< grows with every picture
    std::vector<std::uint8_t> rgba;  ///< row-major, 8 bits a channel; alpha is not looked at
    /// The pixel of the projector that a person is asked to touch; none: nothing is asked.
    std::optional<std::array<float, 2>> aim_px;
};

/// Of this process, in POSIX shared memory: the display and the drivers do not know one another.
std::string projected_picture_name();

/// Makes the shared memory, and removes it in the end. Throws Error{io_error} where the system refuses it.
class ProjectedPictureWriter {
  public:
    /// The largest picture that will be shown.
    ProjectedPictureWriter(const std::string& name, int width_px, int height_px);
    ~ProjectedPictureWriter();
    ProjectedPictureWriter(const ProjectedPictureWriter&) = delete;
    ProjectedPictureWriter& operator=(const ProjectedPictureWriter&) = delete;

    /// rgba as in ProjectedPicture, of width x height pixels. Throws Error{bad_data} where it is larger than
    /// announced or its bytes are too few or too many.
    void show(std::span<const std::uint8_t> rgba, int width_px, int height_px,
              std::optional<std::array<float, 2>> aim_px = std::nullopt);

  private:
    struct Mapping;
    std::unique_ptr<Mapping> mapping_;
};

/// Looks for the shared memory at every read, so that either side may start first.
class ProjectedPictureReader {
  public:
    explicit ProjectedPictureReader(std::string name);
    ~ProjectedPictureReader();
    ProjectedPictureReader(const ProjectedPictureReader&) = delete;
    ProjectedPictureReader& operator=(const ProjectedPictureReader&) = delete;

    /// The picture that is shown now, whole, never half of one and half of the next; null before the first
    /// and when the writer is gone. Valid until the next call; copied only when there is a new one, which has
    /// a new version, of whichever writer.
    const ProjectedPicture* latest();

  private:
    struct Mapping;
    std::string name_;
    std::unique_ptr<Mapping> mapping_;
    ProjectedPicture picture_;
};

}  // namespace touchstone
