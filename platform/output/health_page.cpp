#include "platform/output/health_page.hpp"

#include <mutex>
#include <prometheus/collectable.h>
#include <prometheus/exposer.h>
#include <prometheus/metric_family.h>

#include "platform/system/error.hpp"

namespace touchstone {

namespace {

using Labels = std::vector<prometheus::ClientMetric::Label>;
using prometheus::MetricFamily;
using prometheus::MetricType;

MetricFamily family(const std::string& name, const std::string& help, MetricType type) {
    MetricFamily result;
    result.name = "touchstone_" + name;
    result.help = help;
    result.type = type;
    return result;
}

void add(MetricFamily& to, double value, Labels labels = {}) {
    prometheus::ClientMetric metric;
    metric.label = std::move(labels);
    if (to.type == MetricType::Counter)
        metric.counter.value = value;
    else
        metric.gauge.value = value;
    to.metric.push_back(std::move(metric));
}

MetricFamily counter(const std::string& name, const std::string& help, std::uint64_t value) {
    MetricFamily result = family(name, help, MetricType::Counter);
    add(result, static_cast<double>(value));
    return result;
}

MetricFamily counters(const std::string& name, const std::string& help, const std::string& label,
                      const std::map<std::string, std::uint64_t>& values) {
    MetricFamily result = family(name, help, MetricType::Counter);
    for (const auto& [kind, value] : values) add(result, static_cast<double>(value), {{label, kind}});
    return result;
}

MetricFamily gauge(const std::string& name, const std::string& help, double value, Labels labels = {}) {
    MetricFamily result = family(name, help, MetricType::Gauge);
    add(result, value, std::move(labels));
    return result;
}

MetricFamily stage_times(const std::vector<StageSummary>& stages) {
    MetricFamily result =
        family("stage_milliseconds", "Time of each stage over the last frames", MetricType::Gauge);
    for (const StageSummary& stage : stages) {
        add(result, stage.median_ms, {{"stage", stage.stage}, {"quantile", "0.5"}});
        add(result, stage.p99_ms, {{"stage", stage.stage}, {"quantile", "0.99"}});
    }
    return result;
}

MetricFamily temperatures(const std::vector<Temperature>& found) {
    MetricFamily result =
        family("temperature_celsius", "Of the machine, as the kernel tells it", MetricType::Gauge);
    for (const Temperature& temperature : found)
        add(result, temperature.celsius, {{"zone", temperature.zone}});
    return result;
}

std::vector<MetricFamily> families(const HealthFigures& figures) {
    std::vector<MetricFamily> all{
        counter("frames_total", "Frames processed", figures.frames),
        counter("missed_frames_total", "Frames that the camera should have given, by its clock",
                figures.missed_frames),
        counter("touches_total", "Touches that went down", figures.touches),
        counters("camera_faults_total", "Faults of the camera", "kind", figures.faults),
        counters("camera_restarts_total", "What was done to bring the camera back", "what", figures.restarts),
        counters("unsaved_total", "What could not be written to the disk", "what", figures.unsaved),
        gauge("state", "1 for the state of the table", 1.0, {{"state", figures.state}}),
        gauge("frame_rate_hertz", "Frames a second", figures.frame_rate_hz),
        gauge("resident_memory_megabytes", "Memory of the process", figures.resident_mb),
        stage_times(figures.stages),
        temperatures(figures.temperatures)};
    if (figures.projector_off_mm)
        all.push_back(gauge("projector_off_millimetres",
                            "How far from where it should the projector's light fell when last checked",
                            *figures.projector_off_mm));
    if (figures.lost_packets)
        all.push_back(
            counter("lost_packets_total", "Packets of the camera that USB lost", *figures.lost_packets));
    return all;
}

class LatestFigures : public prometheus::Collectable {
  public:
    std::vector<MetricFamily> Collect() const override {
        const std::lock_guard lock(mutex_);
        return families(figures_);
    }
    void set(const HealthFigures& figures) {
        const std::lock_guard lock(mutex_);
        figures_ = figures;
    }

  private:
    mutable std::mutex mutex_;
    HealthFigures figures_;
};

}  // namespace

struct HealthPage::Server {
    explicit Server(const std::string& address) : exposer(address) { exposer.RegisterCollectable(latest); }

    std::shared_ptr<LatestFigures> latest = std::make_shared<LatestFigures>();
    prometheus::Exposer exposer;
};

HealthPage::HealthPage(int port) {
    const std::string address = "127.0.0.1:" + std::to_string(port);
    try {
        server_ = std::make_unique<Server>(address);
    } catch (const std::exception&) {
        throw Error(
            ExitStatus::unavailable,
            "health.port: " + address + " cannot be served: another program has the port; choose another");
    }
}

HealthPage::~HealthPage() = default;

int HealthPage::port() const { return server_->exposer.GetListeningPorts().front(); }

void HealthPage::show(const HealthFigures& figures) { server_->latest->set(figures); }

}  // namespace touchstone
