#pragma once

#include <chrono>

namespace touchstone {

/// What brings a silent camera back, the gentlest first.
enum class Remedy { none, restart_stream, reopen, reset_and_reopen };

/// Decides when a camera that is open but gives nothing good is helped, and how. No frame for 500 ms: restart
/// its stream; another second: open it anew; two more: reset it on USB; then again and again with longer
/// pauses, at most 10 s.
class CameraRecovery {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// It was opened: the first frame may take 3 s. `silence` stands for the 500 ms with slow cameras.
    void opened(Time now, std::chrono::milliseconds silence = std::chrono::milliseconds(500));
    /// A good frame came.
    void healthy(Time now);
    /// It was pulled out, or died. One that is lost again and again without a good frame is opened less
    /// often.
    void lost(Time now);
    bool may_open(Time now) const { return now >= open_at_; }
    /// Asked while none comes; a remedy is named once, when it is due.
    Remedy due(Time now);
    /// Whether it is being helped.
    bool ailing() const { return attempts_ > 0; }

  private:
    Time due_{};
    std::chrono::milliseconds silence_{500};
    int attempts_ = 0;
    Time open_at_{};
    int losses_ = 0;
};

}  // namespace touchstone
