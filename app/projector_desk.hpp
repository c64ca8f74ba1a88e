#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/config.hpp"
#include "app/projector_mapping.hpp"
#include "app/projector_watch.hpp"

namespace touchstone {

/// What the presentation loop tells of its display.
struct ProjectorScreen {
    bool is_projector = false;  ///< its picture falls on the table
    PixelSize size_px;
    std::shared_ptr<const ThrownPicture> shown;  ///< thrown now instead of the scene; null: none
};

/// What the perception loop does for a projector: where its light falls, its calibration when the operator
/// asks, and a look whether it still holds at the start and after a knock. No touch counts during a
/// calibration; a look waits until nobody is over the table, and ends when somebody comes.
class ProjectorDesk {
  public:
    /// Reads the file of the configuration where there is one. Says what is wrong with it.
    explicit ProjectorDesk(const ProjectorMappingConfig& config);

    void see(const ProjectorScreen& screen);
    bool can_calibrate() const { return !config_.file.empty() && screen_.is_projector; }
    /// By light where the camera has colours, unless that has just failed; else by touch.
    void calibrate(bool can_see_color);
    bool calibrates() const { return calibration_.has_value(); }
    /// A calibration or a look ends without a result: without a camera, for example.
    void give_up(const std::string& why);

    /// After each frame.
    void follow(const TableLook& look, bool can_see_color);
    bool wants_color() const { return watch_ || (calibration_ && calibration_->wants_color()); }
    bool wants_held_exposure() const;

    /// Null until a calibrated table is live.
    std::shared_ptr<const ProjectorModel> model() const { return mapping_ ? mapping_->model() : nullptr; }
    std::shared_ptr<const SurfaceGrid> surface() const { return mapping_ ? mapping_->surface() : nullptr; }
    /// Instead of the scene; null: the scene.
    std::shared_ptr<const ThrownPicture> thrown() const;
    /// For the table: empty when all is well.
    std::string note() const;
    /// For the operator's panel: what became of the last calibration or look.
    const std::string& words() const { return words_; }
    /// As the last look found it.
    std::optional<double> off_mm() const { return off_mm_; }
    /// Why its last calibration is not on the disk; empty when nothing is wrong.
    const std::string& unsaved() const { return unsaved_; }

  private:
    void load();
    void say(const std::string& words, bool is_good);
    bool is_shown(const std::shared_ptr<const ThrownPicture>& picture);
    void follow_calibration(const TableLook& look);
    void take_over(const CalibrationResult& result, const TableLook& look);
    void follow_watch(const TableLook& look, bool can_see_color);
    void begin_watch(const TableLook& look);
    void put_off_watch();
    void conclude(const ProjectorCheck& check);

    ProjectorMappingConfig config_;
    std::optional<ProjectorMapping> mapping_;
    ProjectorModel calibrated_;  ///< its picture's size is that of the calibration
    std::string written_on_;     ///< for people
    ProjectorScreen screen_;
    std::optional<ProjectorCalibration> calibration_;
    std::optional<ProjectorWatch> watch_;
    bool light_failed_ = false;  ///< the next calibration is by touch
    int answered_ = 0;           ///< of the mapping's doubts
    int quiet_ = 0, put_off_ = 0, unshown_ = 0;
    std::string words_, size_note_, unsaved_;
    std::optional<double> off_mm_;
};

}  // namespace touchstone
