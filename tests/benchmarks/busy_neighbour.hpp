#pragma once

#include <atomic>
#include <thread>

namespace touchstone {

/// One core at full load, for as long as this lives.
class BusyNeighbour {
  public:
    BusyNeighbour()
        : thread_([this] {
              volatile double sum = 0.0;
              while (!ended_) sum = sum * 0.5 + 1.0;
          }) {}
    BusyNeighbour(const BusyNeighbour&) = delete;
    BusyNeighbour& operator=(const BusyNeighbour&) = delete;
    ~BusyNeighbour() {
        ended_ = true;
        thread_.join();
    }

  private:
    std::atomic<bool> ended_ = false;
    std::thread thread_;
};

}  // namespace touchstone
