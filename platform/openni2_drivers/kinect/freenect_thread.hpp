#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <future>
#include <mutex>
#include <queue>
#include <thread>

#include "platform/openni2_drivers/kinect/freenect_api.hpp"

namespace touchstone {

/// libfreenect and the only thread that calls it, which the library and its player of recordings need.
class FreenectThread {
  public:
    /// `lost` is called in that thread when libfreenect says that a camera which streams is gone.
    explicit FreenectThread(std::function<void()> lost);
    ~FreenectThread();
    FreenectThread(const FreenectThread&) = delete;
    FreenectThread& operator=(const FreenectThread&) = delete;

    /// Runs `task` in the thread, hands its result or exception over. The context is null where there is no
    /// USB. May be called from the thread itself.
    template <class Task>
    auto run(Task task) -> std::invoke_result_t<Task, freenect_context*> {
        if (std::this_thread::get_id() == thread_.get_id()) return task(context_);
        std::packaged_task<std::invoke_result_t<Task, freenect_context*>()> work(
            [&] { return task(context_); });
        auto result = work.get_future();
        post([&work] { work(); });
        return result.get();
    }

    /// Called in the thread: cameras send pictures only while somebody waits for them.
    void stream_started() { ++streams_; }
    void stream_stopped() { --streams_; }

    /// That libfreenect has told of. From any thread.
    std::uint64_t lost_packets() const { return lost_packets_; }

  private:
    void post(std::function<void()> work);
    void loop();
    void open_context();
    void take_pictures();

    std::function<void()> lost_;
    std::atomic<std::uint64_t> lost_packets_ = 0;
    freenect_context* context_ = nullptr;
    std::mutex mutex_;
    std::condition_variable posted_;
    std::queue<std::function<void()>> work_;
    int streams_ = 0;
    bool ending_ = false;
    std::thread thread_;
};

}  // namespace touchstone
