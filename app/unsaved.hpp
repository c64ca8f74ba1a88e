#pragma once

#include <map>
#include <string>

namespace touchstone {

/// What could not be written to the disk. A disk that is full or read-only is so for hours: it is said once.
class Unsaved {
  public:
    /// True where that is news: the first time, after it went well, or for another reason.
    bool failed(const std::string& what, const std::string& reason) {
        const auto [known, is_new] = reasons_.try_emplace(what, reason);
        if (!is_new && known->second == reason) return false;
        known->second = reason;
        return true;
    }
    /// True where it had failed.
    bool saved(const std::string& what) { return reasons_.erase(what) > 0; }

  private:
    std::map<std::string, std::string> reasons_;
};

}  // namespace touchstone
