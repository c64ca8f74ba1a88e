#include "platform/openni2_drivers/simulator/truth_writer.hpp"

#include <fmt/core.h>

#include "platform/system/error.hpp"

namespace touchstone::sim {
namespace {

constexpr std::string_view closing = "]}\n";

std::string text_of(const std::vector<TipTruth>& tips) {
    std::string text = "[";
    for (const TipTruth& tip : tips)
        text +=
            fmt::format(R"({}{{"hand":{},"finger":{},"gap_mm":{:.3f},"camera_mm":[{:.2f},{:.2f},{:.2f}]}})",
                        text.size() > 1 ? "," : "", tip.hand, tip.finger, tip.gap_mm, tip.camera_mm.x(),
                        tip.camera_mm.y(), tip.camera_mm.z());
    return text + "]";
}

}  // namespace

TruthWriter::TruthWriter(std::filesystem::path path, double rate_hz)
    : path_(std::move(path)), file_(path_, std::ios::binary | std::ios::trunc) {
    std::string head = fmt::format(R"({{"fps":{},"frames":)", rate_hz);
    count_at_ = static_cast<std::streamoff>(head.size());
    head += fmt::format("{:10},\"tips\":[", 0);
    end_at_ = static_cast<std::streamoff>(head.size());
    file_ << head << closing << std::flush;
    if (!file_)
        throw Error(
            ExitStatus::io_error,
            fmt::format("cannot write the truth file {}: check the folder and the disk", path_.string()));
}

void TruthWriter::add_frame(const std::vector<TipTruth>& tips) {
    const std::string text = (frames_ > 0 ? ",\n" : "\n") + text_of(tips);
    file_.seekp(end_at_);
    file_ << text << closing << std::flush;
    end_at_ += static_cast<std::streamoff>(text.size());
    file_.seekp(count_at_);
    file_ << fmt::format("{:10}", ++frames_) << std::flush;
    if (!file_)
        throw Error(ExitStatus::io_error,
                    fmt::format("cannot write the truth file {}: the disk may be full", path_.string()));
}

}  // namespace touchstone::sim
