#pragma once

#include <memory>
#include <string_view>

#include "platform/openni2_drivers/common/frame_source.hpp"
#include "platform/openni2_drivers/sequence/sequence_folder.hpp"

namespace touchstone {

/// Replays a folder of depth pictures. Values 0 and 65535 come out as 0. Pictures may have any size up to
/// 4096x4096; all depth pictures have the first one's size, all colour pictures the first colour picture's,
/// else Error{bad_data}.
class SequenceSource : public FrameSource {
  public:
    explicit SequenceSource(const std::filesystem::path& folder);

    const SourceInfo& info() const override { return info_; }
    void enable_color(bool enabled) override { color_enabled_ = enabled; }
    bool next(SourceFrame& frame) override;

  private:
    void read_depth(const SequenceEntry& entry, SourceFrame& frame) const;
    void read_color(const SequenceEntry& entry, SourceFrame& frame) const;

    SequenceFolder folder_;
    SourceInfo info_;
    bool color_enabled_ = false;
    std::size_t next_entry_ = 0;
};

/// What follows "seq:" in a sensor URI: the folder. Throws Error.
std::unique_ptr<FrameSource> open_sequence(std::string_view after_scheme);

}  // namespace touchstone
