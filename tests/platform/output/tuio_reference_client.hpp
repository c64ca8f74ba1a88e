#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "platform/output/tuio_session.hpp"

namespace touchstone {

/// What the reference clients (C++ and JavaScript) do with a bundle, written from their rules.
class TuioReferenceClient {
  public:
    void take(const TuioBundle& bundle) {
        if (is_late(bundle.fseq)) {
            ++dropped;
            return;
        }
        std::erase_if(cursors, [&](const auto& known) {
            const bool gone = std::count(bundle.alive.begin(), bundle.alive.end(), known.first) == 0;
            if (gone) events.push_back("remove " + std::to_string(known.first));
            return gone;
        });
        for (const TuioCursor& set : bundle.cursors) {
            if (std::count(bundle.alive.begin(), bundle.alive.end(), set.session) == 0) continue;
            if (!cursors.contains(set.session)) events.push_back("add " + std::to_string(set.session));
            cursors[set.session] = set;
        }
    }
    void take(const std::vector<TuioBundle>& bundles) {
        for (const TuioBundle& bundle : bundles) take(bundle);
    }

    std::map<std::int32_t, TuioCursor> cursors;
    std::vector<std::string> events;
    int dropped = 0;
    std::int32_t current_frame = 0;

  private:
    bool is_late(std::int32_t fseq) {
        if (fseq <= 0) return false;
        const bool late = fseq < current_frame && current_frame - fseq <= 100;
        if (!late) current_frame = fseq;
        return late;
    }
};

}  // namespace touchstone
