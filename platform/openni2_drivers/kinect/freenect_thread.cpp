#include "platform/openni2_drivers/kinect/freenect_thread.hpp"

#include <cstdio>
#include <sys/time.h>
#include <utility>

namespace touchstone {
namespace {

constexpr timeval longest_wait{0, 20'000};
// libusb's word for a signal that came in between.
constexpr int interrupted = -10;

/// Where the thread that libfreenect runs in counts: the library hands nothing of ours to its log.
std::atomic<std::uint64_t>*& count_of_this_thread() {
    thread_local std::atomic<std::uint64_t>* count = nullptr;
    return count;
}

/// Nothing is printed; lost packets are only told in the log.
void read_log(freenect_context*, freenect_loglevel, const char* message) {
    unsigned stream = 0, packets = 0;
    int end = 0;
    if (std::sscanf(message, "[Stream %x] Lost %u packets%n", &stream, &packets, &end) != 2 || end == 0)
        return;
    if (count_of_this_thread() != nullptr) *count_of_this_thread() += packets;
}

}  // namespace

FreenectThread::FreenectThread(std::function<void()> lost) : lost_(std::move(lost)) {
    const std::lock_guard lock(mutex_);  // the thread begins once its id is known here
    thread_ = std::thread([this] { loop(); });
}

FreenectThread::~FreenectThread() {
    post([this] { ending_ = true; });
    thread_.join();
}

void FreenectThread::post(std::function<void()> work) {
    {
        const std::lock_guard lock(mutex_);
        work_.push(std::move(work));
    }
    posted_.notify_one();
}

void FreenectThread::open_context() {
    if (freenect_init(&context_, nullptr) < 0) {
        context_ = nullptr;
        return;
    }
    freenect_set_log_callback(context_, read_log);
    freenect_set_log_level(context_, FREENECT_LOG_INFO);
    freenect_select_subdevices(
        context_, static_cast<freenect_device_flags>(FREENECT_DEVICE_CAMERA | FREENECT_DEVICE_MOTOR));
}

void FreenectThread::loop() {
    count_of_this_thread() = &lost_packets_;
    std::unique_lock lock(mutex_);
    while (!ending_) {
        if (streams_ == 0) posted_.wait(lock, [this] { return !work_.empty(); });
        if (context_ == nullptr) open_context();  // USB may come later
        while (!work_.empty()) {
            const auto work = std::move(work_.front());
            work_.pop();
            lock.unlock();
            work();
            lock.lock();
        }
        lock.unlock();
        if (streams_ > 0) take_pictures();
        lock.lock();
    }
    lock.unlock();
    if (context_ != nullptr) freenect_shutdown(context_);
}

void FreenectThread::take_pictures() {
    timeval wait = longest_wait;
    const int status = freenect_process_events_timeout(context_, &wait);
    if (status < 0 && status != interrupted) lost_();
}

}  // namespace touchstone
