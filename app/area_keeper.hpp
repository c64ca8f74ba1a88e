#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/command_line.hpp"
#include "pipeline/interaction_pipeline.hpp"
#include "pipeline/named_areas.hpp"
#include "ui/table_frame.hpp"

namespace touchstone {

/// The table's named areas: from their file, assigned to fingers, changed by the operator, followed when the
/// camera was knocked. Corners are kept in the plane frame of the camera as it stands.
class AreaKeeper {
  public:
    /// Reads the file that the configuration names, if any; a file that is not there yet is a table that is
    /// one, and so is one that is wrong, which is said: see load_areas.
    explicit AreaKeeper(const RunOptions& options);

    /// Empty where the table is one.
    std::span<const NamedArea> areas() const { return assignment_.areas(); }
    bool can_change() const { return !file_.empty() && is_kept_; }
    /// The camera stood there when areas and scan were written.
    void use_scan(const RigidTransform& T_g_c) { T_g_c_ = T_g_c; }

    /// Writes the areas of all fingers of a frame. Where the camera stands elsewhere in the same scan, the
    /// areas move with what it sees, and so does their file.
    void assign(const InteractionPipeline& pipeline, InteractionFrame& frame);
    /// The operator's list takes the place of the old one, in the file too; nothing changes where it is
    /// refused, or cannot be written. What became of it is in words().
    bool change(std::span<const AreaDraft> drafts, const InteractiveArea& table);
    const std::string& words() const { return words_; }
    /// From the end of the scan on.
    std::vector<ShownArea> shown(const InteractionPipeline& pipeline, const Intrinsics& intrinsics) const;

  private:
    void load();
    void tell_places(const InteractiveArea& table) const;
    void follow_camera(const InteractiveArea& table, const RigidTransform& T_g_c);
    std::vector<NamedArea> areas_of(std::span<const AreaDraft> drafts, const InteractiveArea& table) const;
    std::string free_name(const std::vector<NamedArea>& taken) const;

    std::string file_, table_scene_;
    bool is_kept_ = true, on_surface_ = false, is_told_ = false;
    AreaAssignment assignment_;
    std::optional<RigidTransform> T_g_c_;  ///< of the camera in whose plane frame the corners are
    std::string words_;
};

}  // namespace touchstone
