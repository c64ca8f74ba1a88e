#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "platform/output/touch_screen_events.hpp"
#include "platform/output/touch_sink.hpp"

struct libevdev;
struct libevdev_uinput;

namespace touchstone {

inline constexpr const char* touch_screen_name = "Touchstone touch screen";
inline constexpr const char* uinput_node = "/dev/uinput";

struct EvdevDeleter {
    void operator()(libevdev* device) const;
};
using EvdevDevice = std::unique_ptr<libevdev, EvdevDeleter>;

/// The touch screen as the kernel is to know it.
EvdevDevice describe_touch_screen(const TouchScreenConfig& config);

/// What to do so that this user may make input devices through `node`.
std::string uinput_advice(const std::filesystem::path& node);

/// Touches as those of a touch screen of this machine, for every program on it: a virtual device of the
/// kernel.
class UinputSink : public TouchSink {
  public:
    /// Makes the device. Throws Error{unavailable} where the kernel or the rights of this user do not let it.
    explicit UinputSink(const TouchScreenConfig& config, const std::filesystem::path& node = uinput_node);
    /// Lifts all touches and takes the device away.
    ~UinputSink() override;
    /// Throws Error{io_error} where the kernel does not take an event.
    void publish(const TouchReport& report) override;
    void release_all() override;
    /// The device of these touches in /dev/input.
    std::string device_node() const;

  private:
    struct FileCloser {
        void operator()(std::FILE* file) const;
    };
    struct UinputDeleter {
        void operator()(libevdev_uinput* device) const;
    };
    void write(const TouchScreenEvents::Events& events);

    TouchScreenConfig config_;
    TouchScreenEvents events_;
    std::unique_ptr<std::FILE, FileCloser> file_;
    std::unique_ptr<libevdev_uinput, UinputDeleter> device_;
    bool said_left_out_ = false;
};

}  // namespace touchstone
