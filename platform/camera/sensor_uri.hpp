#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace touchstone {

enum class SensorKind {
    device,     ///< a camera on USB
    recording,  ///< PATH.oni
    sequence,   ///< seq:DIR
    simulator,  ///< sim:SCENE?key=value&...
};

/// What a sensor URI names, from its text and the files there are. Throws Error{usage} for a folder without
/// "seq:".
SensorKind classify_sensor(const std::string& uri);

/// OpenNI2 takes URIs of at most 255 characters. Longer paths are handed to it as a file descriptor's path in
/// /proc, which stays valid as long as this lives.
class OpenniUri {
  public:
    /// Throws Error: usage where the URI is too long and names no file or folder.
    OpenniUri(const std::string& uri, SensorKind kind);
    ~OpenniUri();
    OpenniUri(const OpenniUri&) = delete;
    OpenniUri& operator=(const OpenniUri&) = delete;

    const std::string& text() const { return text_; }
    /// The same message with the path that the user gave.
    std::string in_user_terms(std::string message) const;

  private:
    std::string text_;
    std::string user_path_;  ///< empty where the URI is short enough
    std::string proc_path_;
    int descriptor_ = -1;
};

}  // namespace touchstone
