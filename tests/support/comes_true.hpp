#pragma once

#include <chrono>
#include <thread>

namespace touchstone::test {

/// Looks again and again for up to 20 s until something is so.
template <class Predicate>
bool comes_true(Predicate predicate) {
    for (int look = 0; look < 2000; ++look) {
        if (predicate()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
}

}  // namespace touchstone::test
