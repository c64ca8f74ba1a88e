#pragma once

#include "tests/accuracy/touch_record.hpp"

namespace touchstone {

/// Sequences one after the other, as if they were one: scores of it are those of all together. Each sequence
/// must begin without hands, so that no contact reaches over a seam.
class TouchSeries {
  public:
    /// Ids are kept apart from those of the sequences before.
    void append(const TouchTruth& truth, const TouchLog& log);

    const TouchTruth& truth() const { return truth_; }
    const TouchLog& log() const { return log_; }

  private:
    TouchTruth truth_;
    TouchLog log_;
    int next_id_ = 0;
};

}  // namespace touchstone
