#pragma once

#include <OpenNI.h>
#include <string>

namespace touchstone {

/// OpenNI's recorder on streams that run: every frame they deliver from the constructor's return on goes into
/// the file. Depth is kept without loss, colour as JPEG.
class Recording {
  public:
    /// Throws Error{io_error} where the file cannot be written.
    Recording(const std::string& path, openni::VideoStream& depth, openni::VideoStream& color);
    /// Returns when all frames are in the file.
    ~Recording();
    Recording(const Recording&) = delete;
    Recording& operator=(const Recording&) = delete;

  private:
    openni::Recorder recorder_;
};

}  // namespace touchstone
