#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "platform/output/touch_sink.hpp"

namespace touchstone {

enum class ContactStep { begin, move, end };

/// What one contact does in a report. Its number is no other contact's, even of the same finger.
struct ContactChange {
    ContactStep step = ContactStep::begin;
    std::int32_t contact = 0;
    ReportedFinger finger;  ///< of an end: without meaning
};

/// Turns reports into contacts that each begin once, move and end once, whatever a report leaves out: a touch
/// that is no longer reported has ended, one that moves without a beginning begins, one that goes down again
/// is a new contact.
class ContactFollower {
  public:
    /// Contacts are numbered from `first`, at least 1; after 2^31-1 comes 1.
    explicit ContactFollower(std::int32_t first) : next_(first) {}

    /// In the order of the report; the ends of what it leaves out come last.
    std::vector<ContactChange> take(const std::vector<ReportedFinger>& touches);
    std::vector<ContactChange> end_all();

  private:
    struct Contact {
        std::int32_t number = 0;
        bool seen = true;  ///< in the report at hand
    };

    std::map<int, Contact> contacts_;  ///< by the finger's id
    std::int32_t next_;
};

}  // namespace touchstone
