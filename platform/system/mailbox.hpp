#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <utility>

namespace touchstone {

/// Hands the latest value from one thread to another. The giver never waits: a value that was not taken yet
/// is merged with the newer one, by default replaced by it.
template <class T>
class Mailbox {
  public:
    /// Gives the one value that stands for an untaken value and the newer one.
    using Merge = std::function<T(T&& untaken, T&& newer)>;

    explicit Mailbox(Merge merge = [](T&&, T&& newer) { return std::move(newer); })
        : merge_(std::move(merge)) {}

    /// Without effect once closed.
    void put(T value) {
        {
            const std::lock_guard lock(mutex_);
            if (closed_) return;
            slot_ = slot_ ? merge_(std::move(*slot_), std::move(value)) : std::move(value);
        }
        filled_.notify_one();
    }

    /// Waits for a value. Nothing once it is closed and empty.
    std::optional<T> take() {
        std::unique_lock lock(mutex_);
        filled_.wait(lock, [&] { return slot_ || closed_; });
        return std::exchange(slot_, std::nullopt);
    }

    /// Waits at most so long. Nothing after that, or once it is closed and empty.
    std::optional<T> take_for(std::chrono::milliseconds longest) {
        std::unique_lock lock(mutex_);
        filled_.wait_for(lock, longest, [&] { return slot_ || closed_; });
        return std::exchange(slot_, std::nullopt);
    }

    /// What is there now, without waiting.
    std::optional<T> try_take() {
        const std::lock_guard lock(mutex_);
        return std::exchange(slot_, std::nullopt);
    }

    /// Ends the hand-over: a value inside can still be taken.
    void close() {
        {
            const std::lock_guard lock(mutex_);
            closed_ = true;
        }
        filled_.notify_all();
    }

    bool closed() const {
        const std::lock_guard lock(mutex_);
        return closed_;
    }

  private:
    Merge merge_;
    mutable std::mutex mutex_;
    std::condition_variable filled_;
    std::optional<T> slot_;
    bool closed_ = false;
};

}  // namespace touchstone
