#pragma once

#include <cstring>
#include <optional>
#include <type_traits>

#include "platform/openni2_drivers/common/driver_api.hpp"

namespace touchstone {

/// Copies a property out to OpenNI; its size must be the value's.
template <class T>
OniStatus give_property(const T& value, void* data, const int* size) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (*size != static_cast<int>(sizeof(T))) return ONI_STATUS_BAD_PARAMETER;
    std::memcpy(data, &value, sizeof(T));
    return ONI_STATUS_OK;
}

/// The property OpenNI hands in, or nothing where its size is wrong.
template <class T>
std::optional<T> take_property(const void* data, int size) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (size != static_cast<int>(sizeof(T))) return std::nullopt;
    T value;
    std::memcpy(&value, data, sizeof(T));
    return value;
}

}  // namespace touchstone
