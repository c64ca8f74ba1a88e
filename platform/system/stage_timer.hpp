#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace touchstone {

/// What one stage took over the frames remembered.
struct StageSummary {
    std::string stage;
    double median_ms = 0.0;
    double p99_ms = 0.0;
    std::size_t frames = 0;  ///< frames remembered in which the stage ran
};

/// Times of the named stages over the last frames. One thread uses it; each loop has its own.
class StageTimes {
  public:
    explicit StageTimes(std::size_t window_frames = 300);

    /// Adds to what the stage took in the present frame: a stage that runs twice a frame counts with the sum.
    void add(std::string_view stage, double ms);
    /// Ends the present frame. Stages that did not run in it get no sample.
    void end_frame();
    /// Forgets all frames, the present one too.
    void clear();

    /// Stages in the order in which they first ran.
    std::vector<StageSummary> summary() const;
    /// One stage; zeros where it never ran.
    StageSummary summary(std::string_view stage) const;

  private:
    struct Stage {
        std::string name;
        double frame_ms = 0.0;
        bool ran = false;
        std::vector<double> ring_ms;
        std::size_t next = 0;
    };
    StageSummary summarize(const Stage& stage) const;

    std::size_t window_frames_;
    std::vector<Stage> stages_;
};

/// Adds the time from its making to its end to one stage. The name must outlive it: a literal.
class StageTimer {
  public:
    StageTimer(StageTimes& times, std::string_view stage)
        : times_(times), stage_(stage), start_(std::chrono::steady_clock::now()) {}
    ~StageTimer() {
        const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start_;
        times_.add(stage_, taken.count());
    }
    StageTimer(const StageTimer&) = delete;
    StageTimer& operator=(const StageTimer&) = delete;

  private:
    StageTimes& times_;
    std::string_view stage_;
    std::chrono::steady_clock::time_point start_;
};

}  // namespace touchstone
