#include "tests/accuracy/baselines/finger_slices.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

namespace touchstone::baselines {
namespace {

/// The pixels of a row or a column.
struct Line {
    const std::uint16_t* first;
    int count;
    int stride;

    int at(int i) const { return first[i * stride]; }
};

/// Change of depth over two pixels; nothing without readings.
std::optional<int> step_mm(const Line& line, int i) {
    const int before = line.at(i - 1), after = line.at(i + 1);
    if (before == 0 || after == 0) return std::nullopt;
    return after - before;
}

/// Middles of the slices of a line.
std::vector<double> slices_of(const Line& line, const SliceConfig& config) {
    std::vector<double> middles;
    std::optional<int> entered;
    for (int i = 1; i + 1 < line.count; ++i) {
        const auto step = step_mm(line, i);
        if (!step || std::abs(*step) > config.most_step_mm) {
            entered.reset();
        } else if (*step <= -config.least_step_mm) {
            entered = i;
        } else if (*step >= config.least_step_mm && entered) {
            const int width_px = i - *entered;
            if (width_px >= config.least_width_px && width_px <= config.most_width_px)
                middles.push_back(0.5 * (i + *entered));
            entered.reset();
        }
    }
    return middles;
}

/// Chains of slices, in coordinates (across, along).
class Chains {
  public:
    explicit Chains(const SliceConfig& config) : config_(config) {}

    void add_line(int along, const std::vector<double>& middles) {
        const auto is_over = [&](const SliceChain& chain) {
            return static_cast<double>(along) - chain.back().y() > config_.most_gap_px;
        };
        const auto over = std::stable_partition(open_.begin(), open_.end(), std::not_fn(is_over));
        std::for_each(over, open_.end(), [&](SliceChain& chain) { close(std::move(chain)); });
        open_.erase(over, open_.end());
        for (const double middle : middles) {
            const auto nearest = std::find_if(open_.begin(), open_.end(), [&](const SliceChain& chain) {
                return chain.back().y() < along && std::abs(chain.back().x() - middle) <= config_.most_gap_px;
            });
            if (nearest != open_.end())
                nearest->emplace_back(middle, along);
            else
                open_.push_back({{middle, along}});
        }
    }

    std::vector<SliceChain> finish() {
        for (SliceChain& chain : open_) close(std::move(chain));
        return std::move(done_);
    }

  private:
    void close(SliceChain&& chain) {
        if (std::ssize(chain) >= config_.least_slices) done_.push_back(std::move(chain));
    }

    SliceConfig config_;
    std::vector<SliceChain> open_, done_;
};

}  // namespace

std::vector<SliceChain> find_slice_chains(const DepthPicture& picture, const SliceConfig& config) {
    Chains upright(config), lying(config);
    for (int v = 0; v < picture.height_px; ++v)
        upright.add_line(v, slices_of({&picture.at(0, v), picture.width_px, 1}, config));
    for (int u = 0; u < picture.width_px; ++u)
        lying.add_line(u, slices_of({&picture.at(u, 0), picture.height_px, picture.width_px}, config));
    std::vector<SliceChain> chains = upright.finish();
    for (SliceChain& chain : lying.finish()) {
        for (Eigen::Vector2d& middle : chain) std::swap(middle.x(), middle.y());
        chains.push_back(std::move(chain));
    }
    return chains;
}

}  // namespace touchstone::baselines
